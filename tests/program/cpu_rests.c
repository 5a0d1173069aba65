/* SPDX-License-Identifier: MIT */
/* The CPU's device keeps what a resting camera sees: frames drawn before must not change the image.
 */
#include "app/render/renderer/renderer.h"
#include "app/render/shade_field.h"

#include "tests/oracle/check.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 64, HEIGHT = 36 };

typedef struct fixture {
    scene world;
    render_device device;
} fixture;

static render_frame frame_of(const fixture *f, const scene_light *lights, size_t count) {
    return (render_frame) { .width = WIDTH,
                            .height = HEIGHT,
                            .camera = scene_default_camera(&f->world, (float)WIDTH / HEIGHT),
                            .bands = 5,
                            .lights = lights,
                            .light_count = count,
                            .samples = 1,
                            .keep_geometry = true };
}

static void draw(any_renderer *renderer, const render_frame *frame, image *pixels) {
    base_error error = { "" };
    if (!renderer_draw(renderer, frame, NULL, &error) ||
        !renderer_read_image(renderer, pixels, &error))
        fail_msg("%s", error.text);
}

/* Draws the frame by a renderer that has drawn nothing yet. */
static void draw_recomputed(const fixture *f, render_frame frame, image *pixels) {
    base_error error = { "" };
    any_renderer *fresh = renderer_create(&f->device, &error);
    assert_non_null(fresh);
    frame.keep_geometry = false;
    draw(fresh, &frame, pixels);
    renderer_destroy(fresh);
}

static void expect_as_recomputed(const fixture *f, any_renderer *renderer,
                                 const render_frame *frame) {
    image again, recomputed;
    draw(renderer, frame, &again);
    draw_recomputed(f, *frame, &recomputed);
    assert_memory_equal(again.rgb, recomputed.rgb,
                        3 * (size_t)frame->width * (size_t)frame->height * sizeof *recomputed.rgb);
    image_free(&again);
    image_free(&recomputed);
}

/* The light stands in front of the middle of the view, where it hides surfaces, and then beside it.
 */
static void a_light_that_moves_uncovers_what_it_hid(void **state) {
    const fixture *f = *state;
    base_error error = { "" };
    any_renderer *renderer = renderer_create(&f->device, &error);
    assert_non_null(renderer);
    scene_light light = f->world.lights[0];
    render_frame frame = frame_of(f, &light, 1);
    const float *eye = frame.camera.eye, *target = frame.camera.target;
    image hidden, free_view;
    light.emitter.radius = 0.2f;
    light.emitter.position = (lmp_vec3) { 0.5f * (eye[0] + target[0]), 0.5f * (eye[1] + target[1]),
                                          0.5f * (eye[2] + target[2]) };
    draw(renderer, &frame, &hidden);
    for (int i = 0; i < 3; i++) {
        light.emitter.position.y += 0.3f;
        expect_as_recomputed(f, renderer, &frame);
    }
    frame.light_count = 0;
    expect_as_recomputed(f, renderer, &frame);
    draw(renderer, &frame, &free_view);
    const size_t middle = 3 * (size_t)(HEIGHT / 2 * WIDTH + WIDTH / 2);
    assert_true(hidden.rgb[middle] == light.emitter.radiance.r);
    assert_true(free_view.rgb[middle] != light.emitter.radiance.r);
    image_free(&hidden);
    image_free(&free_view);
    renderer_destroy(renderer);
}

static void another_view_is_traced(void **state) {
    const fixture *f = *state;
    base_error error = { "" };
    any_renderer *renderer = renderer_create(&f->device, &error);
    assert_non_null(renderer);
    render_frame frame = frame_of(f, f->world.lights, f->world.light_count);
    expect_as_recomputed(f, renderer, &frame);
    frame.camera.eye[0] += 0.25f;
    expect_as_recomputed(f, renderer, &frame);
    frame.samples = 3; /* the last sample takes the planes */
    expect_as_recomputed(f, renderer, &frame);
    expect_as_recomputed(f, renderer, &frame);
    frame.samples = 1;
    expect_as_recomputed(f, renderer, &frame);
    frame.height = HEIGHT / 2;
    expect_as_recomputed(f, renderer, &frame);
    renderer_destroy(renderer);
}

/* Draws by a field of its own, whose nodes are those that this frame requests. */
static void draw_by_field(const fixture *f, render_frame frame, image *pixels) {
    base_error error = { "" };
    const shade_field_options options = SHADE_FIELD_DEFAULTS;
    shade_field *field = shade_field_create(&f->world, &options, frame.bands, &error);
    any_renderer *renderer = renderer_create(&f->device, &error);
    assert_true(field && renderer);
    frame.method = METHOD_FIELD;
    shade_field_attach(field, &frame);
    draw(renderer, &frame, pixels);
    renderer_destroy(renderer);
    shade_field_destroy(field);
}

/* Kept or not, what is seen has the same nodes and the same shades: tiles that are not kept request
 * nodes by what their rays hit, and the kept image by its planes. */
static void a_field_shades_what_is_kept_and_what_is_not(void **state) {
    const fixture *f = *state;
    render_frame frame = frame_of(f, f->world.lights, f->world.light_count);
    image kept, found;
    draw_by_field(f, frame, &kept);
    frame.keep_geometry = false;
    draw_by_field(f, frame, &found);
    assert_memory_equal(kept.rgb, found.rgb, 3 * sizeof *kept.rgb * WIDTH * HEIGHT);
    image_free(&kept);
    image_free(&found);
}

/* Glowing balls under coats, which keep part of the glow until a table replaces both: planes that
 * were kept hold the glow. */
static void other_materials_are_looked_at_again(void **state) {
    const fixture *f = *state;
    base_error error = { "" };
    scene world = f->world;
    scene_material *materials = malloc(world.material_count * sizeof *materials);
    int *uses = calloc(world.material_count, sizeof *uses);
    assert_true(materials && uses);
    for (size_t i = 0; i < world.material_count; i++) {
        materials[i] = world.materials[i];
        materials[i].coat = 1;
        materials[i].emission[0] = 0.5f;
    }
    world.materials = materials;
    fixture coated = { .world = world };
    assert_true(render_device_open(DEVICE_CPU, NULL, &coated.world, &coated.device, &error));
    any_renderer *renderer = renderer_create(&coated.device, &error);
    any_renderer *fresh = renderer_create(&coated.device, &error);
    assert_true(renderer && fresh);
    const render_frame frame = frame_of(&coated, world.lights, world.light_count);
    const lmp_brdf_table_desc desc = { .bands = frame.bands, .rings_max = 16 };
    lmp_sgd sgd;
    lmp_brdf *brdf;
    lmp_brdf_table *table;
    assert_int_equal(lmp_brdf_find_sgd("red-fabric", &sgd), LMP_OK);
    assert_int_equal(lmp_brdf_create_sgd(NULL, &sgd, &brdf), LMP_OK);
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table), LMP_OK);
    lmp_brdf_destroy(brdf);
    image before, again, recomputed;
    draw(renderer, &frame, &before);
    const lmp_brdf_table *const tables[] = { table };
    assert_true(renderer_set_tables(renderer, tables, 1, uses, &error));
    assert_true(renderer_set_tables(fresh, tables, 1, uses, &error));
    draw(renderer, &frame, &again);
    draw(fresh, &frame, &recomputed);
    const size_t bytes = 3 * (size_t)WIDTH * HEIGHT * sizeof *recomputed.rgb;
    assert_memory_equal(again.rgb, recomputed.rgb, bytes);
    assert_memory_not_equal(again.rgb, before.rgb, bytes);
    image_free(&before);
    image_free(&again);
    image_free(&recomputed);
    renderer_destroy(fresh);
    renderer_destroy(renderer);
    render_device_close(&coated.device);
    lmp_brdf_table_destroy(table);
    free(uses);
    free(materials);
}

/* --- the meter -------------------------------------------------------------------------------- */

typedef struct metered {
    image pixels; /* what the meter saw */
    int runs;
} metered;

static float meter(void *user, const image *pixels) {
    metered *m = user;
    const size_t count = 3 * (size_t)pixels->width * (size_t)pixels->height;
    base_error error = { "" };
    assert_true(image_create(&m->pixels, pixels->width, pixels->height, &error));
    memcpy(m->pixels.rgb, pixels->rgb, count * sizeof *pixels->rgb);
    m->runs++;
    return 3;
}

/* The meter reports the mean of the exposure, once. */
static void expect_metered(const fixture *f, render_frame frame, metered *m) {
    base_error error = { "" };
    any_renderer *renderer = renderer_create(&f->device, &error);
    assert_non_null(renderer);
    const size_t bytes = 3 * (size_t)frame.width * (size_t)frame.height * sizeof(float);
    image drawn, again, exposed;
    renderer_set_meter(renderer, (render_meter) { meter, m });
    draw(renderer, &frame, &drawn);
    assert_int_equal(m->runs, 1);
    assert_true(renderer_meter(renderer, &frame, &again, &error));
    assert_int_equal(m->runs, 1);
    assert_memory_equal(m->pixels.rgb, again.rgb,
                        3 * (size_t)again.width * (size_t)again.height * sizeof(float));
    frame.samples_exposure = 3;
    draw_recomputed(f, frame, &exposed);
    assert_memory_equal(drawn.rgb, exposed.rgb, bytes);
    image_free(&drawn);
    image_free(&again);
    image_free(&exposed);
    renderer_destroy(renderer);
}

/* The meter returns the same for any samples and background, with lights visible or not: pixels
 * without a surface are black. */
static void the_meter_sees_lit_surface_alone(void **state) {
    const fixture *f = *state;
    metered first = { .runs = 0 };
    scene_light *hidden = calloc(f->world.light_count, sizeof *hidden);
    for (size_t i = 0; i < f->world.light_count; i++) {
        hidden[i] = f->world.lights[i];
        hidden[i].hidden = 1;
    }
    for (int kind = 0; kind < 8; kind++) {
        render_frame frame = frame_of(f, kind & 1 ? hidden : f->world.lights, f->world.light_count);
        metered m = { .runs = 0 };
        frame.camera.target[1] += 10; /* leaves nothing in the upper left corner */
        frame.background[0] = 0.5f;
        frame.samples = kind & 2 ? 4 : 1;
        frame.keep_geometry = kind & 4;
        expect_metered(f, frame, &m);
        assert_true(m.pixels.rgb[0] == 0);
        if (kind == 0)
            first = m;
        else
            assert_memory_equal(m.pixels.rgb, first.pixels.rgb,
                                3 * (size_t)m.pixels.width * (size_t)m.pixels.height *
                                    sizeof(float));
        if (kind > 0)
            image_free(&m.pixels);
    }
    image_free(&first.pixels);
    free(hidden);
}

static int open_scene(void **state) {
    static fixture f;
    base_error error = { "" };
    *state = &f;
    return !scene_load("builtin:balls", &(scene_options) { .no_cache = true }, &f.world, &error) ||
           !render_device_open(DEVICE_CPU, NULL, &f.world, &f.device, &error);
}

static int close_scene(void **state) {
    fixture *f = *state;
    render_device_close(&f->device);
    scene_free(&f->world);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_light_that_moves_uncovers_what_it_hid),
        cmocka_unit_test(another_view_is_traced),
        cmocka_unit_test(a_field_shades_what_is_kept_and_what_is_not),
        cmocka_unit_test(other_materials_are_looked_at_again),
        cmocka_unit_test(the_meter_sees_lit_surface_alone),
    };
    return cmocka_run_group_tests(tests, open_scene, close_scene);
}
