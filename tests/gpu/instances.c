/* SPDX-License-Identifier: MIT */
/* Instances are drawn as meshes that stand in the world, mirrored and stretched ones too. */
#include "tests/gpu/device.h"
#include "tests/oracle/throng.h"

#include <math.h>

enum { SIDE = 96, COUNT = 60 };

static image draw(const scene *world, int view) {
    static const float eyes[3][3] = { { 0, 2, 12 }, { -9, 4, -3 }, { 1, 0.5f, 1 } };
    render_frame frame = { .width = SIDE,
                           .height = SIDE,
                           .camera = { .up = { 0, 1, 0 }, .fov = 0.9f },
                           .bands = 4,
                           .lights = world->lights,
                           .light_count = world->light_count };
    memcpy(frame.camera.eye, eyes[view], sizeof frame.camera.eye);
    gpu_renderer *renderer = open_renderer(world);
    image pixels = render_image(renderer, &frame);
    gpu_renderer_destroy(renderer);
    return pixels;
}

static void instances_look_like_their_meshes_in_the_world(void **state) {
    (void)state;
    check_seed(7);
    scene placed = throng_open(COUNT, false);
    check_seed(7);
    scene flat = throng_open(COUNT, true);
    for (int view = 0; view < 3; view++) {
        image a = draw(&placed, view), b = draw(&flat, view);
        int shown = 0, off = 0;
        for (int i = 0; i < 3 * SIDE * SIDE; i++) {
            shown += b.rgb[i] > 0;
            off += !(fabsf(a.rgb[i] - b.rgb[i]) <= 0.01f * fabsf(b.rgb[i]) + 1e-4f);
        }
        assert_true(shown > SIDE * SIDE);
        /* Rounding decides a few pixels on silhouettes. */
        assert_in_range(off, 0, 3 * SIDE * SIDE / 500);
        image_free(&a);
        image_free(&b);
    }
    scene_free(&placed);
    scene_free(&flat);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(instances_look_like_their_meshes_in_the_world),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
