/* SPDX-License-Identifier: MIT */
/* Paths of lights: functions of time, closed, and as the files say. */
#include "app/scene/animation.h"

#include "tests/program/load.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define CHECK_NEAR(expected, actual, bound)                                                        \
    CHECK_WITHIN(fabs((double)(actual) - (double)(expected)), bound)

static animation *open_path(const char *name, const scene *s) {
    animation *path = NULL;
    base_error error = { 0 };
    if (!animation_open(name, s, &path, &error))
        fail_msg("%s", error.text);
    return path;
}

static scene_light at(const animation *path, const scene *s, size_t number, double seconds) {
    scene_light light = s->lights[number];
    animation_move(path, number, seconds, &light);
    return light;
}

static void check_position(const scene_light *light, double x, double y, double z) {
    CHECK_NEAR(x, light->emitter.position.x, 1e-5);
    CHECK_NEAR(y, light->emitter.position.y, 1e-5);
    CHECK_NEAR(z, light->emitter.position.z, 1e-5);
}

/* Writes a temporary file, which the caller unlinks. */
static const char *write_file(const char *suffix, const char *text) {
    static char path[64];
    snprintf(path, sizeof path, "/tmp/lampion-path-XXXXXX%s", suffix);
    const int descriptor = mkstemps(path, (int)strlen(suffix));
    assert_true(descriptor >= 0);
    assert_int_equal(write(descriptor, text, strlen(text)), strlen(text));
    close(descriptor);
    return path;
}

static void orbits_close_inside_the_scene(void **state) {
    (void)state;
    scene s = load("builtin:atrium");
    animation *path = open_path("orbit", &s);
    scene_light later[64];
    animation_move_all(path, &s, 1.25, later);
    double moved = 0.0;
    for (size_t i = 0; i < s.light_count; i++) {
        const scene_light start = at(path, &s, i, 0.0), closed = at(path, &s, i, 8.0);
        for (int k = 0; k < 3; k++) {
            CHECK_NEAR((&s.lights[i].emitter.position.x)[k], (&start.emitter.position.x)[k], 1e-6);
            CHECK_NEAR((&start.emitter.position.x)[k], (&closed.emitter.position.x)[k], 1e-4);
            assert_true((&later[i].emitter.position.x)[k] >= s.minimum[k] &&
                        (&later[i].emitter.position.x)[k] <= s.maximum[k]);
            moved += fabs((double)(&later[i].emitter.position.x)[k] -
                          (double)(&start.emitter.position.x)[k]);
        }
    }
    assert_true(moved > 1.0);
    animation_close(path);
    scene_free(&s);
}

static void bounces_touch_the_ground_and_come_back(void **state) {
    (void)state;
    scene s = load("builtin:atrium");
    animation *path = open_path("bounce", &s);
    for (size_t i = 0; i < s.light_count; i++) {
        double lowest = 1e9;
        for (int step = 0; step <= 8 * 960; step++) {
            const scene_light light = at(path, &s, i, step / 960.0);
            CHECK_NEAR(s.lights[i].emitter.position.x, light.emitter.position.x, 0.0);
            assert_true(light.emitter.position.y <= s.lights[i].emitter.position.y);
            lowest = fmin(lowest,
                          (double)(light.emitter.position.y - light.emitter.radius - s.minimum[1]));
        }
        CHECK_NEAR(0.0, lowest, 0.02);
        const scene_light closed = at(path, &s, i, 8.0);
        CHECK_NEAR(s.lights[i].emitter.position.y, closed.emitter.position.y, 1e-5);
    }
    animation_close(path);
    scene_free(&s);
}

static void files_say_how_lights_move(void **state) {
    (void)state;
    scene s = load("builtin:ball");
    s.lights[0].emitter.position.x = s.lights[0].emitter.position.y =
        s.lights[0].emitter.position.z = 1.0f;
    s.lights[2] = s.lights[0];
    s.lights[3] = s.lights[0];
    const char *file = write_file(
        ".json", "{\"paths\":[{\"light\":0,\"keys\":[[0,1,1,1],[2,3,1,1],[4,1,1,1]]},"
                 "{\"light\":1,\"smooth\":true,\"keys\":[[0,0,0,0],[1,1,0,0],[3,3,0,0]]},"
                 "{\"light\":2,\"bounce\":{\"bottom\":0,\"period\":2}},"
                 "{\"circle\":{\"center\":[0,5,0],\"period\":4}}]}");
    animation *path = open_path(file, &s);
    unlink(file);
    scene_light light = at(path, &s, 0, 1.5);
    check_position(&light, 2.5, 1, 1);
    light = at(path, &s, 0, 4e5 + 3.0); /* any number of rounds later */
    check_position(&light, 2, 1, 1);
    /* keys on a line at constant speed, so that a smooth path is that line */
    light = at(path, &s, 1, 2.25);
    check_position(&light, 2.25, 0, 0);
    light = at(path, &s, 2, 1.0);
    check_position(&light, 1, (double)light.emitter.radius, 1);
    light = at(path, &s, 3, 1.0); /* a quarter turn from x towards -z */
    check_position(&light, 1, 1, -1);
    light = at(path, &s, 3, 2.0);
    check_position(&light, -1, 1, -1);
    animation_close(path);
    scene_free(&s);
}

/* A lamp slides on an arm that rotates: translation in 2 s, rotation by 90 degrees in 4 s. */
static const char turning_arm[] =
    "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_lights_punctual\"],"
    "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"point\",\"extras\":{"
    "\"radius\":0.1}}]}},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":4}}]}],\"nodes\":[{\"mesh\":0,"
    "\"children\":[1]},{\"translation\":[0,0,0],\"extensions\":{"
    "\"KHR_lights_punctual\":{\"light\":0}}}],"
    "\"buffers\":[{\"byteLength\":108,\"uri\":\"data:application/octet-stream;base64,"
    "AAAAAAAAAEAAAAAAAACAQAAAAAAAAAAAAAAAAAAAAEAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAgD8A"
    "AAAA8wQ1PwAAAADzBDU/AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":108}],\"accessors\":["
    "{\"bufferView\":0,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"},"
    "{\"bufferView\":0,\"byteOffset\":8,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"},"
    "{\"bufferView\":0,\"byteOffset\":16,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"},"
    "{\"bufferView\":0,\"byteOffset\":40,\"componentType\":5126,\"count\":2,\"type\":\"VEC4\"},"
    "{\"bufferView\":0,\"byteOffset\":72,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
    "\"animations\":[{\"samplers\":[{\"input\":0,\"output\":2},{\"input\":1,\"output\":3}],"
    "\"channels\":[{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"translation\"}},"
    "{\"sampler\":1,\"target\":{\"node\":0,\"path\":\"rotation\"}}]}]}";

static void scenes_move_their_own_lights(void **state) {
    (void)state;
    const char *file = write_file(".gltf", turning_arm);
    scene s = load(file);
    unlink(file);
    assert_int_equal(s.motion_count, 1);
    animation *path = open_path(NULL, &s);
    scene_light light = at(path, &s, 0, 1.0);
    check_position(&light, cos(M_PI / 8), 0, -sin(M_PI / 8));
    light = at(path, &s, 0, 3.0); /* the slide has ended, the arm rotates on */
    check_position(&light, 2 * cos(3 * M_PI / 8), 0, -2 * sin(3 * M_PI / 8));
    animation_close(path);
    scene_clear_lights(&s);
    assert_int_equal(s.motion_count, 0);
    scene_free(&s);
}

static void bad_paths_are_refused_in_one_line(void **state) {
    (void)state;
    static const char two_of_all[] = "{\"paths\":[{\"bounce\":{\"bottom\":0,\"period\":1}},"
                                     "{\"circle\":{\"center\":[0,0,0],\"period\":1}}]}";
    static const char *const bad[] = {
        "",
        "{}",
        "[]",
        "{\"paths\":0}",
        "{\"paths\":[],\"more\":1}",
        "{\"paths\":[3]}",
        "{\"paths\":[{}]}",
        "{\"paths\":[[0]]}",
        "{\"paths\":[{\"circle\":[[0,0,0],1]}]}",
        "{\"paths\":[{\"bounce\":[0]}]}",
        "{\"paths\":[{\"bounce\":0}]}",
        "{\"paths\":[{\"circle\":null}]}",
        "{\"paths\":[{\"bounce\":{\"bottom\":0,\"period\":1,\"period\":2}}]}",
        "{\"paths\":[{\"light\":0,\"keys\":[[0,0,0,0],[1,0,0,0]],\"smooth\":[]}]}",
        "{\"paths\":[{\"light\":0}]}",
        "{\"paths\":[{\"light\":99,\"keys\":[[0,0,0,0],[1,0,0,0]]}]}",
        "{\"paths\":[{\"light\":0,\"keys\":[[0,0,0,0]]}]}",
        "{\"paths\":[{\"light\":0,\"keys\":[[0,0,0,0],[0,1,0,0]]}]}",
        "{\"paths\":[{\"light\":0,\"keys\":[[1,0,0,0],[2,1,0,0]]}]}",
        "{\"paths\":[{\"light\":0,\"keys\":[[0,0,0,0],[1,1e300,0,0]]}]}",
        "{\"paths\":[{\"keys\":[[0,0,0,0],[1,1,0,0]]}]}",
        "{\"paths\":[{\"circle\":{\"center\":[0,0,0],\"period\":0}}]}",
        "{\"paths\":[{\"circle\":{\"center\":[0,0,0],\"axis\":[0,0,0],\"period\":1}}]}",
        "{\"paths\":[{\"bounce\":{\"period\":1}}]}",
        "{\"paths\":[{\"bounce\":{\"bottom\":0,\"period\":1,\"speed\":1}}]}",
        two_of_all,
    };
    scene s = load("builtin:ball");
    animation *path = NULL;
    base_error error;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        const char *file = write_file(".json", bad[i]);
        error.text[0] = '\0';
        if (animation_open(file, &s, &path, &error) || path)
            fail_msg("taken: %s", bad[i]);
        unlink(file);
        assert_non_null(strstr(error.text, file));
    }
    scene_clear_lights(&s);
    const char *file = write_file(".json", "{\"paths\":[{\"light\":0,\"keys\":[]}]}");
    assert_false(animation_open(file, &s, &path, &error));
    unlink(file);
    assert_non_null(strstr(error.text, "none of the 0 lights"));
    assert_false(animation_open("obrit", &s, &path, &error));
    assert_non_null(strstr(error.text, "did you mean orbit"));
    assert_false(animation_open("scene", &s, &path, &error));
    scene_free(&s);
}

/* Circles far away and splines of steep keys would lead beyond the library's lengths. */
static void no_path_leads_out_of_reach(void **state) {
    (void)state;
    static const char *const far[] = {
        "{\"paths\":[{\"light\":0,\"circle\":{\"center\":[9e16,-9e16,9e16],\"period\":1}}]}",
        "{\"paths\":[{\"light\":0,\"smooth\":true,"
        "\"keys\":[[0,0,0,0],[1,9e16,-9e16,0],[1.001,-9e16,9e16,9e16],[2,0,0,0]]}]}",
        "{\"paths\":[{\"light\":0,\"smooth\":true,"
        "\"keys\":[[0,0,0,0],[1e-320,9e16,-9e16,0],[2e-320,0,0,0],[1,0,0,0]]}]}",
    };
    scene s = load("builtin:ball");
    for (size_t i = 0; i < sizeof far / sizeof *far; i++) {
        const char *file = write_file(".json", far[i]);
        animation *path = open_path(file, &s);
        unlink(file);
        for (int step = 0; step < 200; step++) {
            scene_light_error wrong;
            const scene_light light = at(path, &s, 0, 0.01 * step);
            if (!scene_light_check(&light, &wrong))
                fail_msg("%s at %g s: %s", far[i], 0.01 * step, wrong.text);
        }
        animation_close(path);
    }
    scene_free(&s);
}

/* A sun follows the axis of a circle and stays a unit vector; a spot rotates on its way; what has
 * no position neither bounces nor orbits. */
static void circles_rotate_directions(void **state) {
    (void)state;
    scene s = load("builtin:ball");
    const lmp_vec3 east = { 0.6f, 0.8f, 0 };
    s.lights[0].emitter = (lmp_light) { .kind = LMP_LIGHT_CAP, .direction = east, .angle = 0.1f };
    s.lights[1].emitter = (lmp_light) {
        .kind = LMP_LIGHT_SPOT, .position = { 2, 1, 0 }, .direction = { -1, 0, 0 }, .outer = 1
    };
    const char *file =
        write_file(".json", "{\"paths\":[{\"circle\":{\"center\":[0,5,0],\"period\":4}}]}");
    animation *path = open_path(file, &s);
    unlink(file);
    const scene_light sun = at(path, &s, 0, 1.0), spot = at(path, &s, 1, 1.0);
    CHECK_NEAR(0.8, sun.emitter.direction.y, 1e-6);
    CHECK_NEAR(-0.6, sun.emitter.direction.z, 1e-6);
    check_position(&spot, 0, 1, -2);
    CHECK_NEAR(1, spot.emitter.direction.z, 1e-6);
    animation_close(path);
    path = open_path("bounce", &s);
    const scene_light still = at(path, &s, 0, 1.0);
    assert_memory_equal(&still, &s.lights[0], sizeof still);
    animation_close(path);
    file = write_file(".json", "{\"paths\":[{\"light\":0,\"keys\":[[0,0,0,0],[1,1,1,1]]}]}");
    base_error error;
    assert_false(animation_open(file, &s, &path, &error));
    assert_non_null(strstr(error.text, "paths[0] moves a cap light, which has no position"));
    unlink(file);
    scene_free(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orbits_close_inside_the_scene),
        cmocka_unit_test(bounces_touch_the_ground_and_come_back),
        cmocka_unit_test(files_say_how_lights_move),
        cmocka_unit_test(circles_rotate_directions),
        cmocka_unit_test(scenes_move_their_own_lights),
        cmocka_unit_test(bad_paths_are_refused_in_one_line),
        cmocka_unit_test(no_path_leads_out_of_reach),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
