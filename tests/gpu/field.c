/* SPDX-License-Identifier: MIT */
/* The method of fields draws the image of zonal sums, under many lights and under every kind. */
#include "app/shade/field.h"
#include "app/shade/shade.h"
#include "tests/gpu/device.h"
#include "tests/oracle/kinds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 240, HEIGHT = 136, NEIGHBORS = 8 };

static scene world;

static void open_world(const char *name, int lights) {
    cli_error error = { "" };
    expect(scene_load(name, &(scene_options) { .no_cache = true }, &world, &error), &error);
    expect(scene_apply_lights(
               &world, &(scene_lights_options) { .random_count = lights, .seed = 7, .hide = true },
               &error),
           &error);
}

static shade_field *open_field(int bands, bool moves) {
    cli_error error = { "" };
    const shade_field_options options = { .error = SHADE_FIELD_ERROR, .moves = moves };
    shade_field *field = shade_field_create(&world, &options, bands, &error);
    expect(field != NULL, &error);
    return field;
}

static image render_by(gpu_renderer *renderer, gpu_frame *frame, method_kind method,
                       shade_field *field) {
    frame->method = method;
    frame->field = field;
    return render_image(renderer, frame);
}

/* The brightest value around a pixel. */
static float local_peak(const image *pixels, int x, int y) {
    float peak = 0;
    for (int j = y - NEIGHBORS; j <= y + NEIGHBORS; j++)
        for (int i = x - NEIGHBORS; i <= x + NEIGHBORS; i++)
            if (i >= 0 && j >= 0 && i < WIDTH && j < HEIGHT)
                for (int c = 0; c < 3; c++)
                    peak = fmaxf(peak, pixels->rgb[3 * (WIDTH * j + i) + c]);
    return peak;
}

typedef struct difference {
    double worst, rms; /* in parts of the local peak */
} difference;

static difference differ(const image *a, const image *b) {
    difference d = { 0, 0 };
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const float peak = local_peak(b, x, y);
            for (int c = 0; c < 3; c++) {
                const int i = 3 * (WIDTH * y + x) + c;
                const double off =
                    fabs((double)a->rgb[i] - (double)b->rgb[i]) / ((double)peak + 1e-9);
                d.worst = off > d.worst ? off : d.worst;
                d.rms += off * off;
            }
        }
    d.rms = sqrt(d.rms / (3.0 * WIDTH * HEIGHT));
    return d;
}

static void a_thousand_lights_look_as_their_sums_do(void **state) {
    (void)state;
    static const int bands[] = { 5, 10 };
    open_world("builtin:atrium", 1000);
    gpu_renderer *renderer = open_renderer(&world);
    for (int i = 0; i < 2; i++) {
        gpu_frame frame = frame_of(&world, WIDTH, HEIGHT);
        shade_field *field = open_field(bands[i], false);
        frame.bands = bands[i];
        frame.host = shade_frame;
        image by_field = render_by(renderer, &frame, METHOD_FIELD, field);
        image by_sums = render_by(renderer, &frame, METHOD_ZONAL, NULL);
        const difference d = differ(&by_field, &by_sums);
        print_message("%d bands: at most %.4f of the local peak, %.5f in root mean square\n",
                      bands[i], d.worst, d.rms);
        assert_true(!(d.worst > 0.01) && !(d.rms > 0.001));
        image_free(&by_field);
        image_free(&by_sums);
        shade_field_destroy(field);
    }
    gpu_renderer_destroy(renderer);
    scene_free(&world);
}

static void every_kind_of_light_is_drawn(void **state) {
    (void)state;
    open_world("builtin:balls", 20);
    for (int i = 0; i < KINDS; i++)
        world.lights[world.light_count++].emitter = one_of_each_kind[i];
    gpu_renderer *renderer = open_renderer(&world);
    gpu_frame frame = frame_of(&world, WIDTH, HEIGHT);
    shade_field *field = open_field(frame.bands, false);
    frame.host = shade_frame;
    image by_field = render_by(renderer, &frame, METHOD_FIELD, field);
    image by_sums = render_by(renderer, &frame, METHOD_ZONAL, NULL);
    const difference d = differ(&by_field, &by_sums);
    assert_true(!(d.worst > 0.01) && !(d.rms > 0.001));
    image_free(&by_field);
    image_free(&by_sums);
    shade_field_destroy(field);
    gpu_renderer_destroy(renderer);
    scene_free(&world);
}

/* The camera moves on, too: its nodes are computed with the lights as they are then. */
static void lights_that_move_leave_the_image_of_where_they_are(void **state) {
    (void)state;
    open_world("builtin:atrium", 100);
    gpu_renderer *renderer = open_renderer(&world);
    gpu_frame frame = frame_of(&world, WIDTH, HEIGHT);
    shade_field *moving = open_field(5, true), *fresh = open_field(5, false);
    frame.bands = 5;
    frame.host = shade_frame;
    for (int step = 0; step < 3; step++) {
        for (int i = 0; i < 10; i++)
            world.lights[7 * i + step].emitter.position.y -= 0.7f;
        frame.camera.target[0] += 0.8f;
        image a = render_by(renderer, &frame, METHOD_FIELD, moving);
        image b = render_by(renderer, &frame, METHOD_FIELD, fresh);
        assert_true(!(differ(&a, &b).worst > 1e-5));
        image_free(&a);
        image_free(&b);
    }
    shade_field_destroy(moving);
    shade_field_destroy(fresh);
    gpu_renderer_destroy(renderer);
    scene_free(&world);
}

static void impossible_grids_are_refused_with_a_reason(void **state) {
    (void)state;
    cli_error error = { "" };
    const shade_field_options options = { { 1024, 1024, 1024 }, true, 0.05f, false };
    open_world("builtin:balls", 2);
    assert_null(shade_field_create(&world, &options, 5, &error));
    assert_non_null(strstr(error.text, "1024x1024x1024"));
    scene_free(&world);
}

/* Of the nodes asked for, or of as many as are chosen, the first lies before the scene and the last
 * past it, no further than a cell. */
static void grids_cover_the_scene(void **state) {
    (void)state;
    cli_error error = { "" };
    open_world("builtin:atrium", 3);
    for (int given = 0; given < 2; given++) {
        const shade_field_options options = { .grid = { 9, 5, 12 },
                                              .grid_given = given,
                                              .error = SHADE_FIELD_ERROR };
        shade_field *field = shade_field_create(&world, &options, 3, &error);
        expect(field != NULL, &error);
        const lmp_field_desc desc = shade_field_describe(field).info.desc;
        for (int a = 0; a < 3; a++) {
            const float first = (&desc.origin.x)[a], cell = (&desc.cell.x)[a];
            const float last = first + cell * (float)(desc.nodes[a] - 1);
            if (given)
                assert_int_equal(desc.nodes[a], options.grid[a]);
            assert_true(first <= world.minimum[a] && first > world.minimum[a] - cell);
            assert_true(last >= world.maximum[a] && last < world.maximum[a] + cell);
        }
        shade_field_destroy(field);
    }
    scene_free(&world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_thousand_lights_look_as_their_sums_do),
        cmocka_unit_test(every_kind_of_light_is_drawn),
        cmocka_unit_test(lights_that_move_leave_the_image_of_where_they_are),
        cmocka_unit_test(impossible_grids_are_refused_with_a_reason),
        cmocka_unit_test(grids_cover_the_scene),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
