/* SPDX-License-Identifier: MIT */
/* The CPU's device keeps what a resting camera sees: frames that were drawn before change nothing.
 */
#include "app/render/renderer.h"

#include "tests/oracle/check.h"

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
    cli_error error = { "" };
    if (!renderer_draw(renderer, frame, NULL, &error) ||
        !renderer_read_image(renderer, pixels, &error))
        fail_msg("%s", error.text);
}

/* What a renderer that has drawn nothing yet makes of the frame. */
static void draw_anew(const fixture *f, render_frame frame, image *pixels) {
    cli_error error = { "" };
    any_renderer *fresh = renderer_create(&f->device, &error);
    assert_non_null(fresh);
    frame.keep_geometry = false;
    draw(fresh, &frame, pixels);
    renderer_destroy(fresh);
}

static void expect_as_anew(const fixture *f, any_renderer *renderer, const render_frame *frame) {
    image again, anew;
    draw(renderer, frame, &again);
    draw_anew(f, *frame, &anew);
    assert_memory_equal(again.rgb, anew.rgb,
                        3 * (size_t)frame->width * (size_t)frame->height * sizeof *anew.rgb);
    image_free(&again);
    image_free(&anew);
}

/* In front of the middle of the view, where it hides surfaces, and then beside it. */
static void a_light_that_moves_uncovers_what_it_hid(void **state) {
    const fixture *f = *state;
    cli_error error = { "" };
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
        expect_as_anew(f, renderer, &frame);
    }
    frame.light_count = 0;
    expect_as_anew(f, renderer, &frame);
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
    cli_error error = { "" };
    any_renderer *renderer = renderer_create(&f->device, &error);
    assert_non_null(renderer);
    render_frame frame = frame_of(f, f->world.lights, f->world.light_count);
    expect_as_anew(f, renderer, &frame);
    frame.camera.eye[0] += 0.25f;
    expect_as_anew(f, renderer, &frame);
    frame.samples = 3; /* whose last one takes the planes */
    expect_as_anew(f, renderer, &frame);
    expect_as_anew(f, renderer, &frame);
    frame.samples = 1;
    expect_as_anew(f, renderer, &frame);
    frame.height = HEIGHT / 2;
    expect_as_anew(f, renderer, &frame);
    renderer_destroy(renderer);
}

static int open_scene(void **state) {
    static fixture f;
    cli_error error = { "" };
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
    };
    return cmocka_run_group_tests(tests, open_scene, close_scene);
}
