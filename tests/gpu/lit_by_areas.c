/* SPDX-License-Identifier: MIT */
/* The renderer under lights that are areas, against lmp_shade at the very same surface points. */
#include "tests/gpu/device.h"

#include <math.h>

enum { WIDTH = 48, HEIGHT = 27, PIXELS = WIDTH * HEIGHT, LIGHTS = 5 };

/* A lamp of each kind over the balls, and between them what the others stand for elsewhere. */
static const scene_light lamps[LIGHTS] = {
    { .emitter = { .kind = LMP_LIGHT_RECTANGLE,
                   .position = { -2, 3, 1 },
                   .half = { { 0.8f, 0, 0 }, { 0, 0.2f, 0.4f } },
                   .radiance = { 3, 2, 1 } } },
    { .emitter = { .position = { 0, 2.5f, 2 }, .radius = 0.3f, .radiance = { 5, 5, 9 } } },
    { .emitter = { .kind = LMP_LIGHT_DISK,
                   .position = { 2, 2, 2 },
                   .direction = { -0.6f, -0.8f, 0 },
                   .radius = 0.6f,
                   .radiance = { 1, 4, 2 } } },
    { .emitter = { .kind = LMP_LIGHT_TUBE,
                   .position = { 0, 1.2f, -2 },
                   .half = { { 2, 0.3f, 0 } },
                   .radius = 0.05f,
                   .radiance = { 9, 3, 3 } } },
    { .emitter = { .kind = LMP_LIGHT_POLYGON,
                   .position = { 1, 3, -1 },
                   .corner_count = 5,
                   .corner = { { 1, 0, 0 },
                               { 0.3f, 0, 0.9f },
                               { -0.8f, 0, 0.6f },
                               { -0.8f, 0, -0.6f },
                               { 0.3f, 0, -0.9f } },
                   .two_sided = true,
                   .radiance = { 1, 1, 3 } } },
};

static scene world;
static gpu_renderer *renderer;

static int open_balls(void **state) {
    base_error error = { "" };
    if (open_device(state))
        return 1;
    expect(scene_load("builtin:balls", &(scene_options) { .no_cache = true }, &world, &error),
           &error);
    renderer = open_renderer(&world);
    return 0;
}

static int close_balls(void **state) {
    gpu_renderer_destroy(renderer);
    scene_free(&world);
    return close_device(state);
}

static render_frame lit_frame(void) {
    render_frame frame = frame_of(&world, WIDTH, HEIGHT);
    frame.bands = 5;
    frame.window = LMP_WINDOW_HANNING;
    frame.lights = lamps;
    frame.light_count = LIGHTS;
    return frame;
}

/* Returns the largest difference of surfaces to lmp_shade by the zonal method or that of
 * coefficients, in parts of the brightest. */
static double difference(const render_frame *frame, lmp_shade_method method) {
    const lmp_shade_settings settings = { .method = method,
                                          .bands = frame->bands,
                                          .window = frame->window };
    lmp_light lights[LIGHTS];
    for (int i = 0; i < LIGHTS; i++)
        lights[i] = lamps[i].emitter;
    image drawn = render_image(renderer, frame);
    render_pixel *pixels = render_pixels(renderer, frame);
    double largest = 0, brightest = 0;
    for (int i = 0; i < PIXELS; i++) {
        const render_pixel *p = &pixels[i];
        if (p->kind != RENDER_SURFACE)
            continue;
        const lmp_rgb c = lmp_shade(&settings, &p->material, &p->surface, lights, LIGHTS);
        const float expected[3] = { c.r, c.g, c.b };
        for (int k = 0; k < 3; k++) {
            const double error = fabs((double)drawn.rgb[3 * i + k] - (double)expected[k]);
            largest = error <= largest ? largest : error;
            brightest = fmax(brightest, (double)expected[k]);
        }
    }
    image_free(&drawn);
    free(pixels);
    return largest / brightest;
}

static void surfaces_are_lit_as_lmp_shade_says(void **state) {
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        render_frame frame = lit_frame();
        frame.method = (method_kind)m;
        if (!draws_alone(m))
            continue;
        const double error = difference(&frame, method_table[m].method);
        print_message("%s: %.1e of the brightest surface\n", method_table[m].name, error);
        CHECK_WITHIN(error, 1e-4);
    }
}

static void preintegrated_lobes_stand_beside_areas(void **state) {
    (void)state;
    const lmp_preintegrated_lobe_desc desc = { .bands = 5, .window = LMP_WINDOW_HANNING };
    lmp_preintegrated_lobe *lobes;
    assert_int_equal(lmp_preintegrated_lobe_create(NULL, &desc, &lobes), LMP_OK);
    render_frame frame = lit_frame();
    frame.method = METHOD_PREINTEGRATED;
    frame.lobes = lobes;
    CHECK_WITHIN(difference(&frame, LMP_SHADE_ZONAL), 5e-3);
    lmp_preintegrated_lobe_destroy(lobes);
}

/* Lights between areas keep their numbers, and a frame without areas is what it was. */
static void a_frame_without_areas_follows(void **state) {
    (void)state;
    render_frame frame = lit_frame();
    frame.lights = &lamps[1];
    frame.light_count = 1;
    image before = render_image(renderer, &frame);
    render_frame lit = lit_frame();
    image among = render_image(renderer, &lit);
    image after = render_image(renderer, &frame);
    assert_memory_equal(before.rgb, after.rgb, (size_t)3 * PIXELS * sizeof *before.rgb);
    assert_memory_not_equal(before.rgb, among.rgb, (size_t)3 * PIXELS * sizeof *before.rgb);
    image_free(&before);
    image_free(&among);
    image_free(&after);
}

static void what_has_no_coefficients_is_refused(void **state) {
    (void)state;
    base_error error = { "" };
    render_frame frame = lit_frame();
    frame.method = METHOD_PAPER;
    assert_false(gpu_render(renderer, &frame, NULL, &error));
    assert_string_equal(error.text,
                        "the paper's shader: the GPU does not light it by areas (the CPU does)");
}

/* --- as they are seen ------------------------------------------------------------------------- */

/* Lights of 2 units from the eye, which they face, and their areas. */
typedef struct shown_light {
    lmp_light light;
    double area;
} shown_light;
static const shown_light shown[] = {
    { { .kind = LMP_LIGHT_RECTANGLE, .half = { { 0.5f, 0.1f, 0 }, { -0.1f, 0.3f, 0 } } }, 0.64 },
    { { .kind = LMP_LIGHT_DISK, .direction = { 0, 0, 1 }, .radius = 0.45f }, 0.6362 },
    { { .kind = LMP_LIGHT_TUBE, .half = { { 0.5f, 0.2f, 0 } }, .radius = 0.15f }, 0.3938 },
    { { .kind = LMP_LIGHT_TUBE, .half = { { 0, 0, 0.3f } }, .radius = 0.3f }, 0.4039 },
    { { .kind = LMP_LIGHT_POLYGON, /* not convex: a square without a quarter of it */
        .corner_count = 6,
        .corner = { { -0.5f, -0.5f, 0 },
                    { 0.5f, -0.5f, 0 },
                    { 0.5f, 0, 0 },
                    { 0, 0, 0 },
                    { 0, 0.5f, 0 },
                    { -0.5f, 0.5f, 0 } } },
      0.75 },
};
enum { SHOWN = sizeof shown / sizeof *shown };

/* Returns the area, at 2 units from the eye, of the pixels that show a light, second of two, all of
 * which must have its radiance. */
static double seen_area(const lmp_light *light, bool from_behind, bool hidden) {
    const scene_light pair[] = { lamps[0], { .emitter = *light, .hidden = hidden } };
    render_frame frame = frame_of(&world, WIDTH, HEIGHT);
    const float z = from_behind ? -4 : 0;
    frame.bands = 1;
    frame.lights = pair;
    frame.light_count = 2;
    frame.camera = (scene_camera) { .eye = { 0, 50, z }, .target = { 0, 50, -2 }, .fov = 0.6f };
    frame.camera.up[1] = 1;
    const double side = (double)scene_camera_height(&frame.camera, 2) / HEIGHT;
    image drawn = render_image(renderer, &frame);
    render_pixel *pixels = render_pixels(renderer, &frame);
    int count = 0;
    for (int i = 0; i < PIXELS; i++) {
        if (pixels[i].kind != RENDER_LIGHT)
            continue;
        assert_memory_equal(&drawn.rgb[3 * i], &light->radiance, sizeof light->radiance);
        count++;
    }
    image_free(&drawn);
    free(pixels);
    return count * side * side;
}

static void areas_glow_where_they_are(void **state) {
    (void)state;
    for (int i = 0; i < SHOWN; i++) {
        lmp_light light = shown[i].light;
        const bool tube = light.kind == LMP_LIGHT_TUBE;
        light.position = (lmp_vec3) { 0, 50, -2 };
        light.radiance = (lmp_rgb) { 3, 2, 1 };
        CHECK_WITHIN(fabs(seen_area(&light, false, false) / shown[i].area - 1), 0.06);
        if (!tube)
            CHECK_WITHIN(seen_area(&light, true, false), 0);
        light.two_sided = true;
        CHECK_WITHIN(fabs(seen_area(&light, true, false) / shown[i].area - 1), 0.06);
        CHECK_WITHIN(seen_area(&light, false, true), 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surfaces_are_lit_as_lmp_shade_says),
        cmocka_unit_test(preintegrated_lobes_stand_beside_areas),
        cmocka_unit_test(a_frame_without_areas_follows),
        cmocka_unit_test(what_has_no_coefficients_is_refused),
        cmocka_unit_test(areas_glow_where_they_are),
    };
    return cmocka_run_group_tests(tests, open_balls, close_balls);
}
