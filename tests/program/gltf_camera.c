/* SPDX-License-Identifier: MIT */
/* Cameras of glTF. */
#include "tests/program/gltf_document.h"

#include <math.h>

#define PERSPECTIVE                                                                                \
    "{\"type\":\"perspective\",\"perspective\":{\"aspectRatio\":1.5,\"yfov\":0.6,"                 \
    "\"zfar\":10,\"znear\":0.1}}"
#define PARALLEL(lens)                                                                             \
    "{\"type\":\"orthographic\",\"orthographic\":{" lens ",\"zfar\":10,\"znear\":0.1}}"

static scene_camera read_camera(const char *lens) {
    scene_builder builder;
    base_error error;
    char *text = changed(PERSPECTIVE, lens);
    if (!reads(text, &builder, &error))
        fail_msg("%s", error.text);
    assert_int_equal(builder_count(&builder, BLOB_CAMERAS), 1);
    const scene_camera camera = *(const scene_camera *)builder_items(&builder, BLOB_CAMERAS);
    builder_free(&builder);
    free(text);
    return camera;
}

static void perspective_has_an_angle_and_no_height(void **state) {
    (void)state;
    const scene_camera camera = read_camera(PERSPECTIVE);
    CHECK_WITHIN(fabs((double)camera.fov - 0.6), 1e-7);
    assert_true(camera.height == 0 && camera.eye[2] == 9);
    CHECK_WITHIN(fabs((double)scene_camera_height(&camera, 3) - 6 * tan(0.3)), 1e-6);
}

/* xmag and ymag are half of what is seen; their signs do not count. */
static void parallel_rays_have_a_height_at_any_distance(void **state) {
    (void)state;
    const scene_camera camera = read_camera(PARALLEL("\"xmag\":3,\"ymag\":-2"));
    assert_true(camera.height == 4 && camera.aspect == 1.5f);
    assert_true(scene_camera_height(&camera, 1) == 4 && scene_camera_height(&camera, 1e6f) == 4);
}

static void a_scene_goes_without_cameras_that_see_nothing(void **state) {
    (void)state;
    static const char *const lenses[] = {
        PARALLEL("\"xmag\":1,\"ymag\":0"),
        PARALLEL("\"xmag\":0,\"ymag\":1"),
        PARALLEL("\"xmag\":1,\"ymag\":1e300"),
        "{\"type\":\"perspective\",\"perspective\":{\"yfov\":0,\"znear\":0.1}}",
        "{\"type\":\"perspective\",\"perspective\":{\"yfov\":4,\"znear\":0.1}}",
        "{\"type\":\"fisheye\"}",
    };
    for (size_t i = 0; i < sizeof lenses / sizeof *lenses; i++) {
        char *text = changed(PERSPECTIVE, lenses[i]);
        scene_builder builder;
        base_error error;
        bool said = false;
        if (!reads(text, &builder, &error))
            fail_msg("%s: %s", lenses[i], error.text);
        const scene_unsupported *items = builder_items(&builder, BLOB_UNSUPPORTED);
        for (size_t k = 0; k < builder_count(&builder, BLOB_UNSUPPORTED); k++)
            said = said || strcmp(items[k].noun, "camera") == 0;
        assert_true(said);
        assert_int_equal(builder_count(&builder, BLOB_CAMERAS), 0);
        builder_free(&builder);
        free(text);
    }
}

/* What is nearer or farther is not seen; impossible planes are ignored. */
static void a_camera_keeps_its_clip_planes(void **state) {
    (void)state;
    static const struct {
        const char *planes;
        float near, far;
    } cases[] = { { "\"zfar\":10,\"znear\":0.125", 0.125f, 10 },
                  { "\"znear\":0.125", 0.125f, 0 },
                  { "\"zfar\":0.0625,\"znear\":0.125", 0.125f, 0 },
                  { "\"zfar\":0,\"znear\":0", 0, 0 },
                  { "\"zfar\":1e30,\"znear\":-1", 0, 0 } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int flat = 0; flat < 2; flat++) {
            char lens[256];
            snprintf(lens, sizeof lens,
                     flat ? "{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":3,"
                            "\"ymag\":2,%s%s}}"
                          : "{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.6,%s%s}}",
                     cases[i].planes, flat && i == 1 ? ",\"zfar\":0" : "");
            const scene_camera camera = read_camera(lens);
            assert_true(camera.near == cases[i].near && camera.far == cases[i].far);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(perspective_has_an_angle_and_no_height),
        cmocka_unit_test(parallel_rays_have_a_height_at_any_distance),
        cmocka_unit_test(a_scene_goes_without_cameras_that_see_nothing),
        cmocka_unit_test(a_camera_keeps_its_clip_planes),
    };
    fill_bytes();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
