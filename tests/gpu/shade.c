/* SPDX-License-Identifier: MIT */
/* Every method of the renderer against lmp_shade at the very same surface points. */
#include "tests/gpu/device.h"
#include "tests/oracle/kinds.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 72, HEIGHT = 40, PIXELS = WIDTH * HEIGHT };

/* The largest difference to lmp_shade that a channel may have, relative to the sum of the lobes'
 * magnitudes at that pixel, to which rounding is proportional because the lobes' series cancel. */
static const double bound = 5e-6;

/* The largest difference to lmp_shade, relative to the largest radiance in the image. */
static const double peak_bound = 5e-5;

static const int band_counts[] = { 1, 3, 5, 8, 10, 20 };
enum { BAND_COUNTS = sizeof band_counts / sizeof band_counts[0] };

typedef struct worst {
    double relative; /* relative to the magnitude at the pixel */
    double peak;     /* relative to the largest radiance of the image */
    int surfaces;
} worst;

static double largest(lmp_rgb c) {
    return (double)fmaxf(fabsf(c.r), fmaxf(fabsf(c.g), fabsf(c.b)));
}

static double scale_of(int bands, const float *lambda) {
    double sum = 0;
    for (int l = 0; l < bands; l++)
        sum += (2 * l + 1) * 0.25 * fabs((double)lambda[l]);
    return sum;
}

/* Returns what each light alone would reflect if every term of its series were positive, the scale
 * of rounding. |R_l| <= 1 and |P_l| <= 1 make it sum_l (2l+1)/4 |lambda_l| of all lobes, times the
 * strength of the light's cap over pi, plus four times the ambient light. */
static double magnitude(const render_pixel *p, const render_frame *frame) {
    float lambda[LMP_BANDS_MAX];
    lmp_ggx_lobes ggx;
    const lmp_rgb base = p->material.base_color;
    const float metal = p->material.metallic, brightest = fmaxf(base.r, fmaxf(base.g, base.b));
    lmp_lobe_find_ggx(p->surface.normal, p->surface.view, p->material.roughness, &ggx);
    lmp_lobe_make_diffuse(frame->bands, lambda);
    double lobes = (double)(brightest * (1 - metal)) / 3.14159265 * scale_of(frame->bands, lambda);
    double sum = 0;
    for (int k = 0; k < LMP_GGX_LOBES; k++) {
        const lmp_ggx_lobe *lobe = &ggx.lobe[k];
        const float f0 = 0.04f + (brightest - 0.04f) * metal;
        lmp_lobe_make_phong(frame->bands, lobe->exponent, lambda);
        lobes += (double)(f0 * fabsf(lobe->f0) + lobe->f90) * scale_of(frame->bands, lambda);
    }
    for (size_t i = 0; i < frame->light_count; i++) {
        lmp_cap cap;
        lmp_light light = frame->lights[i].emitter;
        if (light.kind ==
            LMP_LIGHT_SPOT) /* rounding of the falloff is that of the whole intensity */
            light.kind = LMP_LIGHT_POINT;
        lmp_light_find_cap(&light, p->surface.position, &cap);
        sum += 2 / 3.14159265 * largest(cap.strength) + 4 * largest(cap.ambient);
    }
    return lobes * sum;
}

static worst compare(gpu_renderer *renderer, const render_frame *frame) {
    const lmp_shade_settings settings = { .method = method_table[frame->method].method,
                                          .bands = frame->bands,
                                          .window = frame->window };
    static lmp_light lights[SCENE_LIGHTS_MAX];
    for (size_t i = 0; i < frame->light_count; i++)
        lights[i] = frame->lights[i].emitter;
    image drawn = render_image(renderer, frame);
    render_pixel *pixels = render_pixels(renderer, frame);
    worst w = { 0 };
    double peak = 0, difference = 0;
    for (size_t i = 0; i < (size_t)frame->width * (size_t)frame->height; i++) {
        const render_pixel *p = &pixels[i];
        lmp_rgb c = { 0, 0, 0 };
        double scale = 1;
        if (p->kind == RENDER_SURFACE) {
            c = lmp_shade(&settings, &p->material, &p->surface, lights, frame->light_count);
            scale = magnitude(p, frame);
            w.surfaces++;
        }
        const float expected[3] = { c.r + p->emission.r, c.g + p->emission.g, c.b + p->emission.b };
        for (int k = 0; k < 3; k++) {
            const double error = fabs((double)drawn.rgb[3 * i + (size_t)k] - (double)expected[k]);
            assert_true(isfinite(error));
            if (p->kind != RENDER_SURFACE) {
                assert_true(error == 0);
                continue;
            }
            const double relative = error == 0 ? 0 : error / scale;
            w.relative = fmax(w.relative, relative);
            difference = fmax(difference, error);
            peak = fmax(peak, (double)expected[k]);
        }
    }
    w.peak = difference / fmax(peak, 1e-30);
    image_free(&drawn);
    free(pixels);
    return w;
}

static void expect_agreement(const char *name, gpu_renderer *renderer, const render_frame *frame) {
    const worst w = compare(renderer, frame);
    print_message("%-14s %-12s %2d bands %4zu lights: %.1e of the lobes, %.1e of the peak\n", name,
                  method_table[frame->method].name, frame->bands, frame->light_count, w.relative,
                  w.peak);
    assert_true(w.surfaces > 0);
    if (!(w.relative <= bound))
        fail_msg("%s: %g above %g", name, w.relative, bound);
    if (!(w.peak <= peak_bound))
        fail_msg("%s: %g of the peak, above %g", name, w.peak, peak_bound);
}

/* Whether this group runs the method of zonal sums, or the other methods. */
static bool by_zonal_sums;

static void methods_agree_on(const char *name, int random_lights, bool keep) {
    base_error error = { "" };
    scene world;
    expect(scene_load(name, &(scene_options) { .no_cache = true }, &world, &error), &error);
    const scene_lights_options lights = { .random_count = random_lights, .seed = 7, .keep = keep };
    expect(scene_apply_lights(&world, &lights, &error), &error);
    gpu_renderer *renderer = open_renderer(&world);
    for (int m = 0; m < METHODS; m++)
        for (int b = 0; b < BAND_COUNTS && draws_alone(m) && (m == METHOD_ZONAL) == by_zonal_sums;
             b++) {
            render_frame frame = frame_of(&world, WIDTH, HEIGHT);
            frame.method = (method_kind)m;
            frame.bands = band_counts[b];
            expect_agreement(name, renderer, &frame);
        }
    gpu_renderer_destroy(renderer);
    scene_free(&world);
}

static void methods_agree_with_lmp_shade_in_the_atrium(void **state) {
    (void)state;
    methods_agree_on("builtin:atrium", 0, true);
}

static void methods_agree_with_lmp_shade_on_balls(void **state) {
    (void)state;
    methods_agree_on("builtin:balls", 0, true);
}

static void methods_agree_with_lmp_shade_on_a_ball_with_random_lights(void **state) {
    (void)state;
    methods_agree_on("builtin:ball", 12, false);
}

static void methods_agree_with_lmp_shade_on_balls_among_random_lights(void **state) {
    (void)state;
    methods_agree_on("builtin:balls", 30, true);
}

/* --- lights at odd positions
 * -----------------------------------------------------------------------
 */

static void with_balls(void (*check)(scene *world, gpu_renderer *renderer)) {
    base_error error = { "" };
    scene world;
    expect(scene_load("builtin:balls", &(scene_options) { .no_cache = true }, &world, &error),
           &error);
    gpu_renderer *renderer = open_renderer(&world);
    check(&world, renderer);
    gpu_renderer_destroy(renderer);
    scene_free(&world);
}

static void check_with(const char *name, gpu_renderer *renderer, render_frame frame) {
    for (int m = 0; m < METHODS; m++) {
        frame.method = (method_kind)m;
        if (draws_alone(m))
            expect_agreement(name, renderer, &frame);
    }
}

static void check_buried(scene *world, gpu_renderer *renderer) {
    render_frame frame = frame_of(world, WIDTH, HEIGHT);
    render_pixel *pixels = render_pixels(renderer, &frame);
    /* Centers exactly on surfaces, spheres that cut them, and one that contains the whole scene.
     * They are hidden, because their own discs would cover the surfaces. */
    size_t count = 0;
    for (size_t i = 0; i < PIXELS && count < 8; i += PIXELS / 16)
        if (pixels[i].kind == RENDER_SURFACE) {
            const lmp_vec3 at = pixels[i].surface.position;
            world->lights[count] = (scene_light) { .emitter = { .position = { at.x, at.y, at.z },
                                                                .radius = count % 2 ? 0.7f : 0.001f,
                                                                .radiance = { 3, 2, 1 } },
                                                   .hidden = 1 };
            count++;
        }
    assert_true(count >= 4);
    world->lights[count++] = (scene_light) {
        .emitter = { .position = { 0, 1, 0 }, .radius = 100, .radiance = { 0.5f, 1, 2 } },
        .hidden = 1
    };
    world->lights[count++] = (scene_light) {
        .emitter = { .position = { 0, 1, 0 }, .radius = 0, .radiance = { 1, 1, 1 } }, .hidden = 1
    };
    free(pixels);
    frame.light_count = count;
    check_with("buried", renderer, frame);
}

static void lights_that_hold_or_touch_surfaces_agree_with_lmp_shade(void **state) {
    (void)state;
    with_balls(check_buried);
}

static void check_far(scene *world, gpu_renderer *renderer) {
    /* r/d = 1e-6, yet as bright on the balls as a near lamp */
    world->lights[0] = (scene_light) { .emitter = { .position = { 6e3f, 8e3f, 0 },
                                                    .radius = 1e-2f,
                                                    .radiance = { 1e12f, 2e12f, 3e12f } } };
    render_frame frame = frame_of(world, WIDTH, HEIGHT);
    frame.light_count = 1;
    check_with("far", renderer, frame);
    image drawn = render_image(renderer, &frame);
    double sum = 0;
    for (size_t i = 0; i < 3 * PIXELS; i++)
        sum += (double)drawn.rgb[i];
    image_free(&drawn);
    assert_true(sum > 0.01 * PIXELS);
}

static void a_light_a_million_radii_away_agrees_with_lmp_shade(void **state) {
    (void)state;
    with_balls(check_far);
}

static void check_kinds(scene *world, gpu_renderer *renderer) {
    render_frame frame = frame_of(world, WIDTH, HEIGHT);
    for (int i = 0; i < KINDS; i++) {
        world->lights[0] = (scene_light) { .emitter = one_of_each_kind[i] };
        frame.light_count = 1;
        check_with(scene_light_kinds[one_of_each_kind[i].kind].name, renderer, frame);
    }
    for (int i = 0; i < KINDS; i++)
        world->lights[i] = (scene_light) { .emitter = one_of_each_kind[i] };
    frame.light_count = KINDS;
    check_with("all kinds", renderer, frame);
}

static void every_kind_of_light_agrees_with_lmp_shade(void **state) {
    (void)state;
    with_balls(check_kinds);
}

/* Checks points so close to surfaces that a sphere in their place would be seen as one. */
static void check_close_points(scene *world, gpu_renderer *renderer) {
    render_frame frame = frame_of(world, WIDTH, HEIGHT);
    frame.bands = 20;
    render_pixel *pixels = render_pixels(renderer, &frame);
    size_t count = 0;
    for (size_t i = 0; i < PIXELS && count < 8; i += PIXELS / 16)
        if (pixels[i].kind == RENDER_SURFACE) {
            const lmp_vec3 at = pixels[i].surface.position, n = pixels[i].surface.normal;
            const lmp_vec3 near = { at.x + 3e-5f * n.x, at.y + 3e-5f * n.y, at.z + 3e-5f * n.z };
            world->lights[count] =
                (scene_light) { .emitter = { .kind = count % 2 ? LMP_LIGHT_SPOT : LMP_LIGHT_POINT,
                                             .position = near,
                                             .direction = { -n.x, -n.y, -n.z },
                                             .inner = 1,
                                             .outer = 1.5f,
                                             .intensity = { 3e-5f, 2e-5f, 1e-5f } } };
            count++;
        }
    assert_true(count >= 4);
    free(pixels);
    frame.light_count = count;
    check_with("close points", renderer, frame);
}

static void points_close_to_surfaces_agree_with_lmp_shade(void **state) {
    (void)state;
    with_balls(check_close_points);
}

/* More lights than a uniform block of 64 KB holds. */
enum { CROWD = 1500 };

static void check_counts(scene *world, gpu_renderer *renderer) {
    base_error error = { "" };
    const scene_lights_options most = { .random_count = CROWD, .seed = 1 };
    render_frame frame = frame_of(world, WIDTH, HEIGHT);
    frame.light_count = 0;
    check_with("dark", renderer, frame);
    expect(scene_apply_lights(world, &most, &error), &error);
    frame = frame_of(world, WIDTH, HEIGHT);
    assert_int_equal(frame.light_count, CROWD);
    check_with("crowded", renderer, frame);
}

static void no_lights_and_a_crowd_agree_with_lmp_shade(void **state) {
    (void)state;
    with_balls(check_counts);
}

static void check_windows(scene *world, gpu_renderer *renderer) {
    render_frame frame = frame_of(world, WIDTH, HEIGHT);
    frame.bands = 8;
    frame.window = LMP_WINDOW_HANNING;
    check_with("hanning", renderer, frame);
    frame.window = LMP_WINDOW_LANCZOS;
    check_with("lanczos", renderer, frame);
}

static void windows_agree_with_lmp_shade(void **state) {
    (void)state;
    with_balls(check_windows);
}

/* Metals only, because coefficients truncate the diffuse lobe. */
static void check_bytes(scene *world) {
    static scene_material metals[64];
    static unsigned char first[3 * PIXELS], bytes[3 * PIXELS];
    base_error error = { "" };
    assert_true(world->material_count <= 64);
    memcpy(metals, world->materials, world->material_count * sizeof *metals);
    for (size_t i = 0; i < world->material_count; i++)
        metals[i].metallic = 1;
    world->materials = metals;
    gpu_renderer *renderer = open_renderer(world);
    render_frame frame = frame_of(world, WIDTH, HEIGHT);
    image drawn = render_image(renderer, &frame);
    const float exposure = image_auto_exposure(&drawn);
    image_free(&drawn);
    int worst_difference = 0;
    for (int m = 0; m < METHODS; m++) {
        if (!draws_alone(m))
            continue;
        frame.method = (method_kind)m;
        expect(gpu_render(renderer, &frame, NULL, &error), &error);
        expect(gpu_read_rgb8(renderer, &(image_display) { .exposure = exposure },
                             m == METHOD_ZONAL ? first : bytes, NULL, &error),
               &error);
        for (size_t i = 0; m != METHOD_ZONAL && i < sizeof bytes; i++) {
            const int difference = abs(bytes[i] - first[i]);
            worst_difference = difference > worst_difference ? difference : worst_difference;
        }
    }
    print_message("largest difference of a byte: %d\n", worst_difference);
    assert_true(worst_difference <= 1);
    gpu_renderer_destroy(renderer);
}

static void methods_give_the_same_bytes_to_one_level(void **state) {
    (void)state;
    base_error error = { "" };
    scene world;
    expect(scene_load("builtin:balls", &(scene_options) { .no_cache = true }, &world, &error),
           &error);
    check_bytes(&world);
    scene_free(&world);
}

int main(int count, char **arguments) {
    const struct CMUnitTest methods[] = {
        cmocka_unit_test(methods_agree_with_lmp_shade_in_the_atrium),
        cmocka_unit_test(methods_agree_with_lmp_shade_on_balls),
        cmocka_unit_test(methods_agree_with_lmp_shade_on_a_ball_with_random_lights),
        cmocka_unit_test(methods_agree_with_lmp_shade_on_balls_among_random_lights),
    };
    const struct CMUnitTest lights[] = {
        cmocka_unit_test(lights_that_hold_or_touch_surfaces_agree_with_lmp_shade),
        cmocka_unit_test(a_light_a_million_radii_away_agrees_with_lmp_shade),
        cmocka_unit_test(every_kind_of_light_agrees_with_lmp_shade),
        cmocka_unit_test(points_close_to_surfaces_agree_with_lmp_shade),
        cmocka_unit_test(no_lights_and_a_crowd_agree_with_lmp_shade),
        cmocka_unit_test(windows_agree_with_lmp_shade),
        cmocka_unit_test(methods_give_the_same_bytes_to_one_level),
    };
    int ran = 0, failed = 0;
    by_zonal_sums = true;
    RUN_GROUP_AS(methods, "zonal");
    by_zonal_sums = false;
    RUN_GROUP_AS(methods, "coefficients");
    RUN_GROUP(lights);
    return ran > 0 ? failed : 1;
}
