/* SPDX-License-Identifier: MIT */
/* The camera comes from the scene, from the command line, or frames a scene that has none. */
#include "app/scene/scene.h"

#include "tests/program/folder.h"
#include "tests/program/load.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define CHECK_NEAR(expected, actual, bound)                                                        \
    CHECK_WITHIN(fabs((double)(actual) - (double)(expected)), bound)

static void cameras_out_of_reach_are_refused(void **state) {
    (void)state;
    scene s = load("builtin:ball");
    const scene_camera_options options = { .eye = { 1e30, 0, 0 }, .eye_given = true };
    const int size[2] = { 16, 9 };
    scene_camera camera;
    base_error error = { 0 };
    assert_false(scene_place_camera(&s, &options, size, &camera, &error));
    assert_non_null(strstr(error.text, "has a camera beyond 1e17"));
    scene_free(&s);
}

/* Measures how far the scene reaches to the right, left, top and bottom, 1 at the image's edges. */
static void measure(const scene *s, const scene_camera *camera, double aspect, double sides[4]) {
    double f[3], r[3], u[3], length = 0;
    for (int i = 0; i < 4; i++)
        sides[i] = -(double)INFINITY;
    for (int k = 0; k < 3; k++)
        f[k] = (double)camera->target[k] - (double)camera->eye[k];
    for (int k = 0; k < 3; k++)
        length += f[k] * f[k];
    for (int k = 0; k < 3; k++)
        f[k] /= sqrt(length);
    const double across = sqrt(f[0] * f[0] + f[2] * f[2]);
    r[0] = -f[2] / across, r[1] = 0, r[2] = f[0] / across;
    for (int k = 0; k < 3; k++)
        u[k] = r[(k + 1) % 3] * f[(k + 2) % 3] - r[(k + 2) % 3] * f[(k + 1) % 3];
    for (size_t i = 0; i < s->vertex_count; i++) {
        double x = 0, y = 0, z = 0;
        for (int k = 0; k < 3; k++) {
            const double p = (double)s->vertices[i].position[k] - (double)camera->eye[k];
            x += r[k] * p;
            y += u[k] * p;
            z += f[k] * p;
        }
        assert_true(z > 0);
        const double slope = z * tan(0.5 * (double)camera->fov);
        const double here[2] = { x / (slope * aspect), y / slope };
        for (int k = 0; k < 4; k++)
            sides[k] = fmax(sides[k], k % 2 ? -here[k / 2] : here[k / 2]);
    }
}

static void a_scene_without_cameras_fills_nine_tenths_of_the_image_in_its_middle(void **state) {
    (void)state;
    static const char *const shapes[] = {
        "v 0 0 0\nv 1 0 0\nv 0 5 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 3 2 4\n",
        "v -100 7 0\nv 100 7 0\nv 0 7 3\nf 1 2 3\n",
        "v 1e-3 0 0\nv 0 1e-3 0\nv 0 0 0\nf 1 2 3\n",
    };
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        folder_write_text("framed.obj", shapes[i]);
        scene s = load(in_folder("framed.obj"));
        for (float aspect = 0.5f; aspect < 3.0f; aspect *= 2.0f) {
            const scene_camera camera = scene_default_camera(&s, aspect);
            double sides[4];
            measure(&s, &camera, (double)aspect, sides);
            const int across = sides[0] > sides[2];
            CHECK_NEAR(0.9, sides[across ? 0 : 2], 1e-3);
            CHECK_NEAR(0.9, sides[across ? 1 : 3], 1e-3);
            CHECK_NEAR(sides[across ? 2 : 0], sides[across ? 3 : 1], 1e-2);
        }
        scene_free(&s);
    }
}

static void a_narrow_image_widens_the_camera_s_view(void **state) {
    (void)state;
    scene s = load("builtin:balls");
    const float aspect = s.cameras[0].aspect, wide = s.cameras[0].fov;
    CHECK_NEAR(wide, scene_default_camera(&s, 2.0f * aspect).fov, 0.0);
    const double half_fov = 0.5 * (double)scene_default_camera(&s, 0.5f * aspect).fov;
    CHECK_NEAR(2.0 * tan(0.5 * (double)wide), tan(half_fov), 1e-5);
    scene_free(&s);
}

static void the_command_line_chooses_an_angle_or_a_height(void **state) {
    (void)state;
    scene s = load("builtin:ball");
    const int size[2] = { 16, 9 };
    scene_camera_options options = { .height = 3, .height_given = true };
    scene_camera camera;
    base_error error = { 0 };
    assert_true(scene_place_camera(&s, &options, size, &camera, &error));
    assert_true(scene_camera_height(&camera, 7) == 3);
    options = (scene_camera_options) { .fov = 60, .fov_given = true };
    assert_true(scene_place_camera(&s, &options, size, &camera, &error));
    CHECK_NEAR(2 * 7 / sqrt(3), scene_camera_height(&camera, 7), 1e-5);
    options.height_given = true;
    assert_false(scene_place_camera(&s, &options, size, &camera, &error));
    assert_non_null(strstr(error.text, "--fov and --orthographic exclude each other"));
    scene_free(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cameras_out_of_reach_are_refused),
        cmocka_unit_test(the_command_line_chooses_an_angle_or_a_height),
        cmocka_unit_test(a_scene_without_cameras_fills_nine_tenths_of_the_image_in_its_middle),
        cmocka_unit_test(a_narrow_image_widens_the_camera_s_view),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
