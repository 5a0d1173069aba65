/* SPDX-License-Identifier: MIT */
/* The method of fields draws the image of zonal sums, under many lights and under every kind. */
#include "tests/gpu/fields.h"

#include <stdio.h>
#include <string.h>

/* Compares the library's images by the field and by all lights, relative to the local peak. They
 * differ by the field's own error, and by what the bands of far lights lack of the diffuse lobe,
 * which sums treat exactly. */
static void differ_from_sums(gpu_renderer *renderer, render_frame *frame, shade_field *field,
                             double worst, double rms) {
    frame->cpu_shader = shade_frame;
    image by_field = render_by(renderer, frame, METHOD_FIELD, field);
    image by_sums = render_by(renderer, frame, METHOD_ZONAL, NULL);
    const difference d = differ(&by_field, &by_sums);
    image_free(&by_field);
    image_free(&by_sums);
    print_message("%d bands: at most %.4f of the local peak, %.5f in root mean square\n",
                  frame->bands, d.worst, d.rms);
    assert_true(!(d.worst > worst) && !(d.rms > rms));
}

static void a_thousand_lights_look_as_their_sums_do(void **state) {
    (void)state;
    static const int bands[] = { 5, 10 };
    open_world("builtin:atrium", 1000);
    gpu_renderer *renderer = open_renderer(&world);
    for (int i = 0; i < 2; i++) {
        render_frame frame = frame_of(&world, WIDTH, HEIGHT);
        shade_field *field = open_field(bands[i], false);
        frame.bands = bands[i];
        differ_from_sums(renderer, &frame, field, 0.012, 0.002);
        shade_field_destroy(field);
    }
    gpu_renderer_destroy(renderer);
    scene_free(&world);
}

static void every_kind_of_light_is_drawn(void **state) {
    (void)state;
    open_every_kind();
    gpu_renderer *renderer = open_renderer(&world);
    render_frame frame = frame_of(&world, WIDTH, HEIGHT);
    shade_field *field = open_field(frame.bands, false);
    differ_from_sums(renderer, &frame, field, 0.012, 0.002);
    shade_field_destroy(field);
    gpu_renderer_destroy(renderer);
    scene_free(&world);
}

/* The camera moves on too: its nodes are computed with the lights as they are then. */
static void lights_that_move_leave_the_image_of_where_they_are(void **state) {
    (void)state;
    open_world("builtin:atrium", 100);
    gpu_renderer *renderer = open_renderer(&world);
    render_frame frame = frame_of(&world, WIDTH, HEIGHT);
    shade_field *moving = open_field(5, true), *fresh = open_field(5, false);
    frame.bands = 5;
    frame.cpu_shader = shade_frame;
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

/* --- on the device ---------------------------------------------------------------------------- */

static void expect_same_image(const char *what, gpu_renderer *renderer, render_frame *frame) {
    shade_field *field = open_field_within(frame->bands, false, device.storage_max);
    expect_same(what, devices_differ(renderer, frame, field));
    shade_field_destroy(field);
}

static void expect_same_of_bands(int bands, lmp_window window) {
    char what[32];
    open_world("builtin:atrium", 300);
    gpu_renderer *renderer = open_renderer(&world);
    render_frame frame = frame_of(&world, WIDTH, HEIGHT);
    frame.bands = bands;
    frame.window = window;
    snprintf(what, sizeof what, "%d bands", bands);
    expect_same_image(what, renderer, &frame);
    gpu_renderer_destroy(renderer);
    scene_free(&world);
}

static void shaders_of_few_bands_draw_what_the_library_does(void **state) {
    (void)state;
    expect_same_of_bands(1, LMP_WINDOW_NONE);
    expect_same_of_bands(3, LMP_WINDOW_HANNING);
    expect_same_of_bands(5, LMP_WINDOW_NONE);
}

static void shaders_of_ten_bands_draw_what_the_library_does(void **state) {
    (void)state;
    expect_same_of_bands(10, LMP_WINDOW_LANCZOS);
}

static void shaders_draw_every_kind_of_light(void **state) {
    (void)state;
    open_every_kind();
    gpu_renderer *renderer = open_renderer(&world);
    render_frame frame = frame_of(&world, WIDTH, HEIGHT);
    frame.bands = usual_bands();
    expect_same_image("all kinds", renderer, &frame);
    gpu_renderer_destroy(renderer);
    scene_free(&world);
}

/* Many equal lights in one place act as one light of their sum. */
static void expect_all_count(gpu_renderer *renderer, render_frame *frame, const image *one,
                             const scene_light *light, size_t count) {
    for (size_t i = 0; i < count; i++) {
        lmp_rgb *radiance = &world.lights[i].emitter.radiance;
        world.lights[i] = *light;
        radiance->r /= (float)count;
        radiance->g /= (float)count;
        radiance->b /= (float)count;
    }
    frame->light_count = count;
    image all = render_by(renderer, frame, METHOD_ZONAL, NULL);
    double worst = 0, brightest = 0;
    for (size_t i = 0; i < 3 * (size_t)(frame->width * frame->height); i++) {
        worst = fmax(worst, fabs((double)all.rgb[i] - (double)one->rgb[i]));
        brightest = fmax(brightest, (double)one->rgb[i]);
    }
    print_message("%zu lights: off by %.1e of the brightest\n", count, worst / brightest);
    assert_true(brightest > 0 && !(worst > 4e-3 * brightest));
    image_free(&all);
}

/* The most lights of a frame are drawn, by the shader and by the library, and one more is refused.
 */
static void tens_of_thousands_of_lights_all_count(void **state) {
    (void)state;
    open_world("builtin:ball", 1);
    gpu_renderer *renderer = open_renderer(&world);
    render_frame frame = frame_of(&world, 16, 16);
    frame.bands = 3;
    image one = render_by(renderer, &frame, METHOD_ZONAL, NULL);
    const scene_light light = world.lights[0];
    for (int on_cpu = 0; on_cpu < 2; on_cpu++) {
        base_error error = { "" };
        frame.cpu_shader = on_cpu ? shade_frame : NULL;
        const size_t most = gpu_lights_max(&device, &frame);
        expect_all_count(renderer, &frame, &one, &light, most);
        frame.light_count = most + 1;
        assert_false(gpu_render(renderer, &frame, NULL, &error));
        assert_non_null(strstr(error.text, "lights"));
    }
    image_free(&one);
    gpu_renderer_destroy(renderer);
    scene_free(&world);
}

/* The grid ends within the scene: outside it every light is summed. */
static void shaders_sum_every_light_outside_the_grid(void **state) {
    (void)state;
    open_world("builtin:balls", 20);
    gpu_renderer *renderer = open_renderer(&world);
    render_frame frame = frame_of(&world, WIDTH, HEIGHT);
    frame.bands = usual_bands();
    for (int a = 0; a < 3; a++)
        world.maximum[a] = 0.5f * (world.minimum[a] + world.maximum[a]);
    expect_same_image("a small grid", renderer, &frame);
    gpu_renderer_destroy(renderer);
    scene_free(&world);
}

/* Nodes and lists are uploaded again for both ways in which lights move; removing a light is
 * another change. */
static void shaders_follow_lights_that_move(void **state) {
    (void)state;
    open_world("builtin:atrium", 100);
    gpu_renderer *renderer = open_renderer(&world);
    render_frame frame = frame_of(&world, WIDTH, HEIGHT);
    shade_field *moving = open_field(5, true), *fresh = open_field(5, false);
    frame.bands = 5;
    for (int step = 0; step < 4; step++) {
        for (int i = 0; i < 10 && step < 3; i++)
            world.lights[7 * i + step].emitter.position.y -= 0.7f;
        frame.light_count = step < 3 ? 100 : 99;
        image a = render_by(renderer, &frame, METHOD_FIELD, moving);
        image again = render_by(renderer, &frame, METHOD_FIELD, moving);
        frame.cpu_shader = shade_frame;
        image b = render_by(renderer, &frame, METHOD_FIELD, fresh);
        frame.cpu_shader = NULL;
        assert_memory_equal(a.rgb, again.rgb, 3 * WIDTH * HEIGHT * sizeof(float));
        expect_same("moved", differ(&a, &b));
        image_free(&a);
        image_free(&again);
        image_free(&b);
    }
    shade_field_destroy(moving);
    shade_field_destroy(fresh);
    gpu_renderer_destroy(renderer);
    scene_free(&world);
}

static void fields_larger_than_a_buffer_are_refused(void **state) {
    (void)state;
    base_error error = { "" };
    gpu_context small = device;
    small.storage_max = 1 << 20;
    open_world("builtin:balls", 2);
    gpu_renderer *renderer = gpu_renderer_create(&small, &world, &error);
    expect(renderer != NULL, &error);
    render_frame frame = frame_of(&world, WIDTH, HEIGHT);
    frame.bands = usual_bands();
    shade_field *large = open_field(frame.bands, false);
    shade_field *fits = open_field_within(frame.bands, false, small.storage_max);
    frame.method = METHOD_FIELD;
    shade_field_attach(large, &frame);
    assert_false(gpu_render(renderer, &frame, NULL, &error));
    assert_non_null(strstr(error.text, "--field-grid"));
    shade_field_attach(fits, &frame);
    expect(gpu_render(renderer, &frame, NULL, &error), &error);
    shade_field_destroy(large);
    shade_field_destroy(fits);
    gpu_renderer_destroy(renderer);
    scene_free(&world);
}

/* --- grids ------------------------------------------------------------------------------------ */

static void impossible_grids_are_refused_with_a_reason(void **state) {
    (void)state;
    base_error error = { "" };
    const shade_field_options options = { .grid = { 1024, 1024, 1024 },
                                          .grid_given = true,
                                          .error = 0.05f };
    open_world("builtin:balls", 2);
    assert_null(shade_field_create(&world, &options, 5, &error));
    assert_non_null(strstr(error.text, "1024x1024x1024"));
    scene_free(&world);
}

/* Whether the nodes are given or chosen, the first lies before the scene and the last past it, no
 * further than a cell. */
static void grids_cover_the_scene(void **state) {
    (void)state;
    base_error error = { "" };
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

int main(int count, char **arguments) {
    const struct CMUnitTest library[] = {
        cmocka_unit_test(a_thousand_lights_look_as_their_sums_do),
        cmocka_unit_test(every_kind_of_light_is_drawn),
        cmocka_unit_test(lights_that_move_leave_the_image_of_where_they_are),
        cmocka_unit_test(impossible_grids_are_refused_with_a_reason),
        cmocka_unit_test(grids_cover_the_scene),
    };
    const struct CMUnitTest few[] = {
        cmocka_unit_test(shaders_of_few_bands_draw_what_the_library_does),
    };
    const struct CMUnitTest ten[] = {
        cmocka_unit_test(shaders_of_ten_bands_draw_what_the_library_does),
    };
    const struct CMUnitTest kinds[] = {
        cmocka_unit_test(shaders_draw_every_kind_of_light),
    };
    const struct CMUnitTest lights[] = {
        cmocka_unit_test(tens_of_thousands_of_lights_all_count),
        cmocka_unit_test(shaders_sum_every_light_outside_the_grid),
        cmocka_unit_test(shaders_follow_lights_that_move),
        cmocka_unit_test(fields_larger_than_a_buffer_are_refused),
    };
    int ran = 0, failed = 0;
    RUN_GROUP(library);
    RUN_GROUP_AS(few, "shaders.few");
    RUN_GROUP_AS(ten, "shaders.ten");
    RUN_GROUP(kinds);
    RUN_GROUP(lights);
    return ran > 0 ? failed : 1;
}
