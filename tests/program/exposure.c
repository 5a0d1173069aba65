/* SPDX-License-Identifier: MIT */
/* Exposure shows what is lit in forty scenes, and overexposes nothing of it. */
#include "app/render/renderer/renderer.h"
#include "app/render/shadow/shadow.h"

#include "tests/oracle/check.h"
#include "tests/program/shapes.h"

#include <stdlib.h>

enum { WIDTH = 96, HEIGHT = 64, SHAPES = 5, LAMPS = 8 };

static void make_shape(shape *s, int kind) {
    shape_clear(s);
    if (kind == 0 || kind == 1) /* a box, also on a floor */
        shape_box(s, vec(-1, 0, -1), vec(1, 1.5f, 1), false, 0);
    if (kind == 1)
        shape_box(s, vec(-8, -0.1f, -8), vec(8, 0, 8), false, 0);
    if (kind == 2) /* a room, a wide plain, many small things */
        shape_box(s, vec(-3, 0, -4), vec(3, 3, 4), true, 0);
    if (kind == 3)
        shape_box(s, vec(-50, -1, -50), vec(50, 0, 50), false, 0);
    for (int i = 0; i < 25 && kind == 4; i++) {
        const float x = (float)(i % 5) - 2, z = (float)(i / 5) - 2;
        shape_box(s, vec(x - 0.2f, 0, z - 0.2f), vec(x + 0.2f, 0.4f, z + 0.2f), false, 0);
    }
    const lmp_vec3 front = { 0, 0, 1 };
    for (uint32_t i = 0; i < s->count; i += 3) { /* flat */
        const lmp_vec3 a = vec_load(s->vertices[i].position),
                       b = vec_load(s->vertices[i + 1].position),
                       c = vec_load(s->vertices[i + 2].position);
        const lmp_vec3 n = vec_normalize(vec_cross(vec_sub(b, a), vec_sub(c, a)), front),
                       t = vec_across(n);
        for (uint32_t k = 0; k < 3; k++) {
            vec_store(n, s->vertices[i + k].normal);
            vec_store(t, s->vertices[i + k].tangent);
            s->vertices[i + k].tangent[3] = 1;
        }
    }
}

/* Makes lamps from dim to bright, few to many, large to small, near to far. */
static size_t make_lamps(scene_light *lights, int kind, const scene *world) {
    const lmp_vec3 low = vec_load(world->minimum), high = vec_load(world->maximum),
                   size = vec_sub(high, low);
    const bool room = scene_is_inside(world);
    const size_t count = kind % 4 < 2 ? 3 : 12;
    const float radius = vec_length(size) * (kind % 2 ? 0.03f : 0.006f),
                radiance = kind < 4 ? 0.5f : 5000;
    for (size_t i = 0; i < count; i++) {
        const float x = (float)(i % 3) * 0.4f + 0.1f, z = (float)(i / 3 % 4) * 0.25f + 0.15f,
                    y = room ? 0.8f : 1.5f + 0.1f * (float)(i % 2);
        lights[i] = (scene_light) {
            .emitter = { .position = { low.x + x * size.x, low.y + y * size.y, low.z + z * size.z },
                         .radius = radius,
                         .radiance = { radiance, radiance * (i % 3 == 0 ? 0.5f : 1),
                                       radiance * (i % 3 == 1 ? 0.3f : 1) } }
        };
    }
    return count;
}

static int by_size(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Finds the exposed luminance of what is lit, in ascending order; returns how many pixels there
 * are. */
static size_t lit_of(const image *pixels, float exposure, float *lit) {
    size_t count = 0;
    for (size_t i = 0; i < (size_t)pixels->width * (size_t)pixels->height; i++) {
        const float *p = pixels->rgb + 3 * i;
        const float y = exposure * (0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2]);
        if (y > 0)
            lit[count++] = y;
    }
    qsort(lit, count, sizeof *lit, by_size);
    return count;
}

typedef struct subject {
    shape shape;
    scene world;
    scene_light lights[16];
    scene_material material;
    render_device device;
    any_renderer *renderer;
    render_frame frame;
} subject;

static subject *open_subject(int kind, int lamps) {
    subject *s = calloc(1, sizeof *s);
    base_error error = { "" };
    make_shape(&s->shape, kind);
    s->world = shape_scene(&s->shape);
    s->material = scene_material_plain();
    s->world.materials = &s->material;
    s->world.material_count = 1;
    s->world.lights = s->lights;
    s->world.light_count = make_lamps(s->lights, lamps, &s->world);
    if (!render_device_open(DEVICE_CPU, NULL, &s->world, &s->device, &error) ||
        !(s->renderer = renderer_create(&s->device, &error)))
        fail_msg("%s", error.text);
    s->frame = (render_frame) { .width = WIDTH,
                                .height = HEIGHT,
                                .camera = scene_default_camera(&s->world, 1.5f),
                                .method = METHOD_ZONAL,
                                .bands = 6,
                                .window = LMP_WINDOW_HANNING,
                                .lights = s->lights,
                                .light_count = s->world.light_count,
                                .samples = 1 };
    return s;
}

static void close_subject(subject *s) {
    renderer_destroy(s->renderer);
    render_device_close(&s->device);
    free(s);
}

static void forty_scenes_show_what_is_lit(void **state) {
    (void)state;
    static float lit[WIDTH * HEIGHT];
    double least = (double)INFINITY, most = 0, clipped = 0;
    for (int kind = 0; kind < SHAPES; kind++)
        for (int lamps = 0; lamps < LAMPS; lamps++) {
            subject *s = open_subject(kind, lamps);
            base_error error = { "" };
            image pixels;
            assert_true(renderer_meter(s->renderer, &s->frame, &pixels, &error));
            const size_t count = lit_of(&pixels, image_auto_exposure(&pixels), lit);
            size_t burnt = 0;
            for (size_t i = 0; i < count; i++)
                burnt += lit[i] > 2;
            const double median = count ? (double)lit[count / 2] : 0;
            if (!(count > 50 && median >= 0.025 && median <= 0.25 &&
                  (double)burnt <= 0.05 * (double)count))
                fail_msg("shape %d, lamps %d: %zu lit, median %.3f, %zu burnt out", kind, lamps,
                         count, median, burnt);
            least = fmin(least, median);
            most = fmax(most, median);
            clipped = fmax(clipped, (double)burnt / (double)count);
            image_free(&pixels);
            close_subject(s);
        }
    print_message("tried: 40 scenes: medians %.3f to %.3f, at most %.3f burnt out\n", least, most,
                  clipped);
}

/* Shadows, and lamps in the image, do not change the exposure. */
static void shadows_and_lamps_change_no_exposure(void **state) {
    (void)state;
    for (int kind = 0; kind < SHAPES; kind++) {
        subject *s = open_subject(kind, 5);
        const environment none = { .bands = 0 };
        base_error error = { "" };
        const shadow_settings settings = { .rays = 0 };
        shadow *cast =
            shadow_create(&s->world, render_device_bvh(&s->device), &none, &settings, &error);
        float exposures[4];
        assert_non_null(cast);
        for (int way = 0; way < 4; way++) {
            image pixels;
            for (size_t i = 0; i < s->world.light_count; i++)
                s->lights[i].hidden = way & 1;
            s->frame.shadow = way & 2 ? shadow_pass(cast) : (render_pass) { .user = NULL };
            assert_true(renderer_meter(s->renderer, &s->frame, &pixels, &error));
            exposures[way] = image_auto_exposure(&pixels);
            assert_true(exposures[way] == exposures[0]);
            image_free(&pixels);
        }
        shadow_destroy(cast);
        close_subject(s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forty_scenes_show_what_is_lit),
        cmocka_unit_test(shadows_and_lamps_change_no_exposure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
