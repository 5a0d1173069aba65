/* SPDX-License-Identifier: MIT */
/* Coordinates of the world, in double, and those of a scene, relative to its origin. */
#include "app/scene/world.h"

#include "app/base/error.h"
#include "app/base/file_json.h"
#include "app/scene/animation.h"
#include "app/scene/instance.h"
#include "app/view/settings.h"
#include "tests/program/folder.h"
#include "tests/program/load.h"

#include <jansson.h>
#include <math.h>

static const double far[3] = { 5e6, 100, -5e6 };

/* --- conversions ------------------------------------------------------------------------------ */

static void the_world_s_coordinates_are_rounded_relative_to_the_origin(void **state) {
    (void)state;
    const double world[3] = { 5000000.1, 100.2, -4999999.7 };
    float point[3];
    double back[3];
    scene_point_from_world(far, world, point);
    scene_point_to_world(far, point, back);
    for (int k = 0; k < 3; k++) {
        CHECK_WITHIN(fabs((double)point[k] - (world[k] - far[k])), 2e-8);
        CHECK_WITHIN(fabs(back[k] - world[k]), 2e-8);
    }
}

static void a_point_stays_where_it_is_by_another_origin(void **state) {
    (void)state;
    const double other[3] = { 4999990, 0, -5000100 };
    float point[3] = { 0.5f, -0.25f, 3 };
    scene_point_rebase(far, other, point);
    assert_true(point[0] == 10.5f && point[1] == 99.75f && point[2] == 103);
    float beyond[3] = { 9e16f, -9e16f, 3 };
    scene_point_rebase((double[]) { 9e16, -9e16, 0 }, (double[]) { 0, 0, 0 }, beyond);
    assert_true(beyond[0] == LMP_LENGTH_MAX && beyond[1] == -LMP_LENGTH_MAX && beyond[2] == 3);
    scene_point_rebase(other, far, point);
    assert_true(point[0] == 0.5f && point[1] == -0.25f && point[2] == 3);
}

/* Without an origin any float survives as by %.9g, and with one to the bit as far as a double can
 * tell. */
static void text_brings_coordinates_back(void **state) {
    (void)state;
    for (int i = 0; i < 20000; i++) {
        const float x = (float)ldexp(check_random_between(-1, 1), i % 40 - 20);
        scene_world_text text, plain;
        snprintf(plain, sizeof plain, "%.9g", (double)x);
        scene_print_world(0, x, 9, text);
        assert_string_equal(text, plain);
        scene_print_world(far[i % 3], x, 9, text);
        const double ulp = nextafter(fabs(far[i % 3]), HUGE_VAL) - fabs(far[i % 3]);
        const double error =
            fabs((double)scene_from_world(far[i % 3], strtod(text, NULL)) - (double)x);
        if (fabs((double)x) > 0x1p24 * ulp)
            assert_true(error == 0);
        CHECK_WITHIN(error, ulp);
    }
    scene_world_text text;
    scene_print_world(5e6, 3.1f, 9, text);
    assert_string_equal(text, "5000003.1");
}

/* --- origins ---------------------------------------------------------------------------------- */

static void expect_origin(const char *name, double x, double y, double z) {
    scene s = load(name);
    if (s.origin[0] != x || s.origin[1] != y || s.origin[2] != z)
        fail_msg("%s: %g %g %g", name, s.origin[0], s.origin[1], s.origin[2]);
    scene_free(&s);
}

static void ordinary_scenes_have_the_origin_0(void **state) {
    (void)state;
    static const char *const scenes[] = {
        "v 0 0 0\nv 1 0 0\nv 0 5 0\nf 1 2 3\n",
        "v 60 0 0\nv 61 0 0\nv 60 1 0\nf 1 2 3\n",
        ("v -1e7 0 -1e7\nv 1e7 0 -1e7\nv 0 0 1e7\nv 5e6 1 5e6\nv 5000001 1 5e6\nv 5e6 2 5e6\n"
         "f 1 2 3\nf 4 5 6\n"),
        "v 1e17 0 0\nv -1e17 0 0\nv 0 1e17 0\nf 1 2 3\n",
    };
    static const char *const names[] = { "builtin:atrium", "builtin:balls", "builtin:ball" };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        expect_origin(names[i], 0, 0, 0);
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        folder_write_text("near.obj", scenes[i]);
        expect_origin(in_folder("near.obj"), 0, 0, 0);
    }
}

static void assert_corner(const scene *s, size_t vertex, float x, float y, float z) {
    const float *p = s->vertices[vertex].position;
    if (p[0] != x || p[1] != y || p[2] != z)
        fail_msg("%g %g %g", (double)p[0], (double)p[1], (double)p[2]);
}

/* Numbers as text have more digits than float32: none is lost to the scene's position. */
static void an_obj_far_away_keeps_its_digits(void **state) {
    (void)state;
    folder_write_text("far.obj", "v 5000000.125 100 -5000000\nv 5000001.0625 100 -5000000\n"
                                 "v 5000000.125 100.75 -5000000\nf 1 2 3\n");
    expect_origin(in_folder("far.obj"), 5000000.5, 100.375, -5000000);
    scene s = load(in_folder("far.obj"));
    assert_corner(&s, 0, -0.375f, -0.375f, 0);
    assert_corner(&s, 1, 0.5625f, -0.375f, 0);
    assert_corner(&s, 2, -0.375f, 0.375f, 0);
    scene_free(&s);
}

/* The model is smaller than the distance between two floats there, so the first reading sees a
 * point. */
static void a_tiny_model_far_away_has_a_size(void **state) {
    (void)state;
    folder_write_text("tiny.obj", "v 1e9 0 0\nv 1000000000.5 0 0\nv 1e9 0.25 0\nf 1 2 3\n");
    scene s = load(in_folder("tiny.obj"));
    assert_true(s.maximum[0] - s.minimum[0] == 0.5f && s.maximum[1] - s.minimum[1] == 0.25f);
    CHECK_WITHIN(fabs(scene_area(&s) - 0.0625), 1e-9);
    scene_free(&s);
}

/* z becomes y and y becomes -z, of the origin too. */
static void a_scene_far_away_stands_up(void **state) {
    (void)state;
    scene s;
    base_error error;
    folder_write_text("up.obj", "v 0 4096 1024\nv 4 4096 1024\nv 0 4096 1028\nf 1 2 3\n");
    assert_true(scene_load(in_folder("up.obj"),
                           &(scene_options) { .up = SCENE_UP_Z, .no_cache = true }, &s, &error));
    double low[3], high[3];
    scene_point_to_world(s.origin, s.minimum, low);
    scene_point_to_world(s.origin, s.maximum, high);
    assert_true(s.origin[2] < -4000);
    assert_true(low[0] == 0 && low[1] == 1024 && low[2] == -4096);
    assert_true(high[0] == 4 && high[1] == 1028 && high[2] == -4096);
    scene_free(&s);
}

/* A node of a node, read by Assimp: 5e6 and 0.0625, which float32 could not add. */
static void nodes_that_assimp_reads_are_added_in_double(void **state) {
    (void)state;
    folder_write_text(
        "far.dae",
        "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
        "version='1.4.1'><asset><up_axis>Y_UP</up_axis></asset>"
        "<library_geometries><geometry id='g'><mesh><source id='p'><float_array id='a' count='9'>"
        "0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source='#a' count='3' "
        "stride='3'><param name='X' type='float'/><param name='Y' type='float'/><param name='Z' "
        "type='float'/></accessor></technique_common></source><vertices id='v'><input "
        "semantic='POSITION' source='#p'/></vertices><triangles count='1'><input "
        "semantic='VERTEX' source='#v' offset='0'/><p>0 1 2</p></triangles></mesh></geometry>"
        "</library_geometries><library_visual_scenes><visual_scene id='s'><node id='n'><translate>"
        "5000000 0 0</translate><node id='m'><translate>0.0625 0 0</translate><instance_geometry "
        "url='#g'/></node></node></visual_scene></library_visual_scenes><scene>"
        "<instance_visual_scene url='#s'/></scene></COLLADA>");
    scene s = load(in_folder("far.dae"));
    assert_true(scene_to_world(s.origin[0], s.minimum[0]) == 5000000.0625);
    assert_true(scene_to_world(s.origin[0], s.maximum[0]) == 5000001.0625);
    scene_free(&s);
}

/* The file's own float32 are far away, and two nodes show them: the mesh is moved to 0, its
 * instances back. */
static void vertices_far_away_are_near_0_in_their_mesh(void **state) {
    (void)state;
    static const float corners[3][3] = { { 5e6f, 100, -5e6f },
                                         { 5000001.5f, 100, -5e6f },
                                         { 5e6f, 102.25f, -5e6f } };
    folder_write("far.bin", corners, sizeof corners);
    folder_write_text("far.gltf",
                      "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{"
                      "\"mesh\":0},{\"mesh\":0,\"translation\":[0.125,0,0]}],\"meshes\":[{"
                      "\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{"
                      "\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
                      "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{"
                      "\"byteLength\":36,\"uri\":\"far.bin\"}]}");
    scene s = load(in_folder("far.gltf"));
    assert_true(s.mesh_count == 1 && s.instance_count == 2);
    for (int k = 0; k < 3; k++)
        assert_true(fabsf(s.meshes[0].minimum[k]) < 4 && fabsf(s.meshes[0].maximum[k]) < 4);
    for (size_t i = 0; i < 2; i++) {
        float at[3][3];
        scene_triangle_positions(&s, i, 0, at);
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                assert_true(scene_to_world(s.origin[k], at[c][k]) ==
                            (double)corners[c][k] + (k == 0 ? 0.125 * (double)i : 0));
    }
    scene_free(&s);
}

/* --- what comes from outside ------------------------------------------------------------------ */

static void lights_are_read_and_written_in_the_world(void **state) {
    (void)state;
    static const char text[] =
        "{\"lights\":[{\"position\":[5000000.1,100.3,-5000000.7],\"radius\":0.1,\"radiance\":1},"
        "{\"kind\":\"directional\",\"direction\":[0,1,0],\"irradiance\":1}]}";
    scene_light lights[2], again[2];
    size_t count;
    base_error error;
    folder_write_text("lights.json", text);
    assert_true(scene_read_lights(in_folder("lights.json"), far, 2, lights, &count, &error));
    const lmp_vec3 p = lights[0].emitter.position;
    assert_true(p.x == (float)(5000000.1 - 5e6) && p.y == (float)(100.3 - 100) &&
                p.z == (float)(-5000000.7 + 5e6));
    assert_true(lights[1].emitter.direction.y == 1);
    assert_true(scene_write_lights(in_folder("again.json"), far, lights, 2, &error));
    assert_true(scene_read_lights(in_folder("again.json"), far, 2, again, &count, &error));
    assert_memory_equal(lights, again, sizeof lights);
}

static void paths_are_in_the_world(void **state) {
    (void)state;
    scene_light light = { .emitter = { .position = { 1, 2, 0 }, .radius = 0.1f } }, moved;
    scene s = { .lights = &light, .light_count = 1, .origin = { 5e6, 100, -5e6 } };
    animation *all;
    base_error error;
    folder_write_text("keys.json", "{\"paths\":[{\"light\":0,\"keys\":[[0,5000001,102,-5000000],"
                                   "[2,5000003.5,103,-5000001]]}]}");
    assert_true(animation_open(in_folder("keys.json"), &s, &all, &error));
    animation_move_all(all, &s, 1, &moved);
    animation_close(all);
    const lmp_vec3 key = moved.emitter.position;
    assert_true(key.x == 2.25f && key.y == 2.5f && key.z == -0.5f);
    folder_write_text("circle.json", "{\"paths\":[{\"circle\":{\"center\":[5000000,0,-5000000],"
                                     "\"period\":2}}]}");
    assert_true(animation_open(in_folder("circle.json"), &s, &all, &error));
    animation_move_all(all, &s, 1, &moved);
    animation_close(all);
    CHECK_WITHIN(fabsf(moved.emitter.position.x + 1), 1e-6);
    CHECK_WITHIN(fabsf(moved.emitter.position.z), 1e-6);
    folder_write_text("bounce.json", "{\"paths\":[{\"bounce\":{\"bottom\":101,\"period\":2}}]}");
    assert_true(animation_open(in_folder("bounce.json"), &s, &all, &error));
    animation_move_all(all, &s, 1, &moved);
    animation_close(all);
    CHECK_WITHIN(fabsf(moved.emitter.position.y - 1.1f), 1e-6);
}

/* The settings of a screenshot are the same to the bit, and denote the same position after its
 * scene has another origin. */
static void settings_are_written_in_the_world(void **state) {
    (void)state;
    static view_settings made, read;
    base_error error;
    made = (view_settings) { .scene = "far.gltf",
                             .up = SCENE_UP_Y,
                             .width = 16,
                             .height = 9,
                             .samples = 1,
                             .exposure = 1,
                             .environment.name = "none",
                             .origin = { 5e6, 100, -5e6 },
                             .camera = { .eye = { 0.1f, 0.2f, 0.3f },
                                         .target = { 0, 0, -1 },
                                         .up = { 0, 1, 0 },
                                         .fov = 1 },
                             .light_count = 1 };
    made.shading[0].bands = made.shading[1].bands = 3;
    made.lights[0].emitter = (lmp_light) { .position = { 0.7f, 1, 2 }, .radius = 0.1f };
    json_t *root = view_settings_to_json(&made);
    json_t *const eye = json_object_get(json_object_get(root, "camera"), "eye");
    char *text = file_json_text(json_incref(eye), false, "made", &error);
    assert_string_equal(text, "[5000000.1,100.2,-4999999.7]");
    free(text);
    text = file_json_text(root, false, "made", &error);
    root = file_parse_json("made", text, strlen(text), &error);
    assert_true(view_settings_from_json(root, "made", &read, &error));
    assert_memory_equal(&made, &read, sizeof made);
    json_decref(root);
    free(text);
    view_settings_rebase(&read, (double[]) { 5000008, 96, -5e6 });
    assert_true(read.origin[0] == 5000008);
    CHECK_WITHIN(fabsf(read.camera.eye[0] + 7.9f), 1e-6);
    CHECK_WITHIN(fabsf(read.camera.eye[1] - 4.2f), 1e-6);
    CHECK_WITHIN(fabsf(read.lights[0].emitter.position.x + 7.3f), 1e-6);
}

static void the_camera_s_options_are_in_the_world(void **state) {
    (void)state;
    scene s = load("builtin:ball");
    scene_camera_options options = { .eye = { 5000001.25, 101, -4999998 },
                                     .target = { 5e6, 100.5, -5e6 },
                                     .eye_given = true,
                                     .target_given = true };
    const int size[2] = { 16, 9 };
    scene_camera camera;
    base_error error;
    memcpy(s.origin, far, sizeof s.origin);
    assert_true(scene_place_camera(&s, &options, size, &camera, &error));
    assert_true(camera.eye[0] == 1.25f && camera.eye[1] == 1 && camera.eye[2] == 2);
    assert_true(camera.target[0] == 0 && camera.target[1] == 0.5f && camera.target[2] == 0);
    scene_free(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_world_s_coordinates_are_rounded_relative_to_the_origin),
        cmocka_unit_test(a_point_stays_where_it_is_by_another_origin),
        cmocka_unit_test(text_brings_coordinates_back),
        cmocka_unit_test(ordinary_scenes_have_the_origin_0),
        cmocka_unit_test(an_obj_far_away_keeps_its_digits),
        cmocka_unit_test(a_tiny_model_far_away_has_a_size),
        cmocka_unit_test(a_scene_far_away_stands_up),
        cmocka_unit_test(nodes_that_assimp_reads_are_added_in_double),
        cmocka_unit_test(vertices_far_away_are_near_0_in_their_mesh),
        cmocka_unit_test(lights_are_read_and_written_in_the_world),
        cmocka_unit_test(paths_are_in_the_world),
        cmocka_unit_test(settings_are_written_in_the_world),
        cmocka_unit_test(the_camera_s_options_are_in_the_world),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
