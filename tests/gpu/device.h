/* SPDX-License-Identifier: MIT */
/* device.h - a context whose every complaint is fatal, and small images, for the tests. */
#ifndef LAMPION_TESTS_GPU_DEVICE_H
#define LAMPION_TESTS_GPU_DEVICE_H

#include "app/render/gl/gpu.h"
#include "tests/oracle/check.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
/* after the headers it needs */
#include <cmocka.h>

static gpu_context device;

/* Whether the device draws by method m given only a scene and lights. */
static inline bool draws_alone(int m) {
    return method_table[m].bands_max[DEVICE_GPU] > 0 && method_table[m].reads == 0;
}

static int open_device(void **state) {
    (void)state;
    base_error error = { "" };
    setenv("LAMPION_GL_DEBUG", "fatal", 1);
    if (!gpu_context_create(getenv("LAMPION_TEST_GL_DEVICE"), &device, &error)) {
        print_error("%s\n", error.text);
        return 1;
    }
    print_message("device: %s, %s\n", device.device, device.driver);
    return 0;
}

static int close_device(void **state) {
    (void)state;
    gpu_context_destroy(&device);
    return 0;
}

/* For main(count, arguments): runs an array of tests if ctest asks for it, by its name or by a
 * word, or asks for no group, and counts the tests that ran and their failures. Groups are separate
 * because a driver with an empty cache takes long to compile the shaders of each. */
#define RUN_GROUP(name) RUN_GROUP_AS(name, #name)
#define RUN_GROUP_AS(group, word)                                                                  \
    do {                                                                                           \
        if (count < 2 || strcmp(arguments[1], word) == 0) {                                        \
            failed += cmocka_run_group_tests_name(word, group, open_device, close_device);         \
            ran++;                                                                                 \
        }                                                                                          \
    } while (0)

/* Fails the test with the error's text. */
static inline void expect(bool ok, const base_error *error) {
    if (!ok)
        fail_msg("%s", error->text);
}

static inline gpu_renderer *open_renderer(const scene *world) {
    base_error error = { "" };
    gpu_renderer *renderer = gpu_renderer_create(&device, world, &error);
    expect(renderer != NULL, &error);
    return renderer;
}

/* Returns the usual bands of a frame, or in a test's short form fewer: llvmpipe takes 9 s to
 * compile the field's shader for 10 bands. */
static inline int usual_bands(void) {
    return check_count(8, LMP_SHADE_BANDS_DEFAULT);
}

static inline render_frame frame_of(const scene *world, int width, int height) {
    return (render_frame) { .width = width,
                            .height = height,
                            .camera = scene_default_camera(world, (float)width / (float)height),
                            .bands = LMP_SHADE_BANDS_DEFAULT,
                            .lights = world->lights,
                            .light_count = world->light_count };
}

/* Moves lights from number `first` on to positions within the scene's bounds, where they are among
 * what they light, whatever `--random-lights` does. */
static inline void stand_within(scene *world, size_t first) {
    uint32_t random = 7;
    for (size_t i = first; i < world->light_count; i++) {
        float at[3];
        for (int k = 0; k < 3; k++) {
            random = random * 1664525u + 1013904223u;
            const float part = 0.1f + 0.8f * (float)(random >> 8) / (float)(1 << 24);
            at[k] = world->minimum[k] + part * (world->maximum[k] - world->minimum[k]);
        }
        world->lights[i].emitter.position = (lmp_vec3) { at[0], at[1], at[2] };
    }
}

static inline image render_image(gpu_renderer *renderer, const render_frame *frame) {
    base_error error = { "" };
    image pixels;
    expect(gpu_render(renderer, frame, NULL, &error), &error);
    expect(gpu_read_image(renderer, &pixels, &error), &error);
    return pixels;
}

static inline render_pixel *render_pixels(gpu_renderer *renderer, const render_frame *frame) {
    base_error error = { "" };
    render_pixel *pixels;
    expect(gpu_render(renderer, frame, NULL, &error), &error);
    expect(gpu_read_pixels(renderer, &pixels, &error), &error);
    return pixels;
}

#endif
