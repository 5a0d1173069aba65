/* SPDX-License-Identifier: MIT */
/* Copies of glTF files with other lights: what is written is read back, and what glTF cannot say is
 * told. */
#include "app/base/file.h"
#include "app/scene/scene.h"
#include "tests/program/folder.h"
#include "tests/program/gltf_document.h"

#include <math.h>

#define COLOR                                                                                      \
    { 3, 2, 0.7f }

static char lost[256];
static base_error error;

/* Writes the document as a GLB under this name. */
static void write_glb(const char *name, const char *json) {
    size_t size;
    unsigned char *glb = pack_glb(json, &size);
    folder_write(name, glb, size);
    free(glb);
}

static scene open_up(const char *name, int up) {
    static char path[512]; /* the scene keeps it */
    scene world;
    snprintf(path, sizeof path, "%s", in_folder(name));
    if (!scene_load(path, &(scene_options) { .no_cache = true, .up = up }, &world, &error))
        fail_msg("%s", error.text);
    return world;
}

static bool export_to(const char *from, int up, const scene_light *lights, size_t count,
                      const char *to) {
    scene world = open_up(from, up);
    error = (base_error) { "" };
    const bool ok =
        scene_export_gltf(&world, lights, count, in_folder(to), lost, sizeof lost, &error);
    scene_free(&world);
    return ok;
}

static const lmp_light known[] = {
    { .position = { 1, 2, 3 }, .radius = 0.3f, .radiance = COLOR },
    { .kind = LMP_LIGHT_POINT, .position = { -1, 0.1f, 3 }, .intensity = COLOR },
    { .kind = LMP_LIGHT_SPOT,
      .position = { 0, 2, 3 },
      .direction = { 0.6f, 0, -0.8f },
      .inner = 0.25f,
      .outer = 0.75f,
      .intensity = COLOR },
    { .kind = LMP_LIGHT_DIRECTIONAL, .direction = { 0, 0.8f, 0.6f }, .irradiance = COLOR },
    { .kind = LMP_LIGHT_RECTANGLE,
      .position = { 4, 5, 6 },
      .half = { { 0, 0.6f, 0.8f }, { 0, 1.6f, -1.2f } },
      .radiance = COLOR },
    { .kind = LMP_LIGHT_DISK,
      .position = { 4, 5, 7 },
      .direction = { -0.6f, 0.8f, 0 },
      .radius = 0.5f,
      .radiance = COLOR },
};
enum { KNOWN = sizeof known / sizeof *known };

static void assert_same(const lmp_light *a, const lmp_light *b) {
    assert_int_equal(a->kind, b->kind);
    for (const scene_light_member *m = scene_light_kinds[a->kind].members; m->name; m++) {
        lmp_light light[2] = { *a, *b };
        const float *x = scene_light_value(&light[0], m), *y = scene_light_value(&light[1], m);
        for (int k = 0; k < scene_light_count(a, m); k++)
            if (!(fabsf(x[k] - y[k]) <= 1e-6f * fmaxf(1, fabsf(x[k]))))
                fail_msg("%s[%d] of a %s is %g, not %g", m->name, k,
                         scene_light_kinds[a->kind].name, (double)y[k], (double)x[k]);
    }
}

/* Whether y or z points up in the file, and however far the scene lies from 0. */
static void lights_are_read_back(void **state) {
    (void)state;
    scene_light lights[KNOWN] = { { .hidden = 0 } };
    char *far = changed("\"translation\":[1,2,3]", "\"translation\":[8000000,2,3]");
    for (int i = 0; i < KNOWN; i++)
        lights[i].emitter = known[i];
    for (int way = 0; way < 3; way++) {
        const int up = way == 1 ? SCENE_UP_Z : SCENE_UP_Y;
        write_glb("from.glb", way == 2 ? far : document);
        if (!export_to("from.glb", up, lights, KNOWN, "copy.glb"))
            fail_msg("%s", error.text);
        assert_string_equal(lost, "");
        scene world = open_up("copy.glb", up);
        assert_int_equal(world.light_count, KNOWN);
        for (int i = 0; i < KNOWN; i++)
            assert_same(&known[i], &world.lights[i].emitter);
        scene_free(&world);
    }
    free(far);
}

static void an_area_of_two_sides_becomes_two(void **state) {
    (void)state;
    scene_light light = { .emitter = known[4] };
    light.emitter.two_sided = true;
    write_glb("from.glb", document);
    assert_true(export_to("from.glb", SCENE_UP_Y, &light, 1, "copy.glb"));
    assert_string_equal(lost, "");
    scene world = open_up("copy.glb", SCENE_UP_Y);
    assert_int_equal(world.light_count, 2);
    assert_same(&known[4], &world.lights[0].emitter);
    for (int i = 0; i < 2; i++) { /* one side is turned around, so that the normal is */
        const lmp_vec3 *half[2] = { known[4].half, world.lights[1].emitter.half };
        CHECK_WITHIN(fabsf(half[1][i].z - (i ? half[0][i].z : -half[0][i].z)), 1e-6);
    }
    scene_free(&world);
}

/* The lights of the file are gone, and those of a copy of a copy as well. */
static void lights_are_replaced(void **state) {
    (void)state;
    const scene_light light = { .emitter = known[0] };
    write_glb("from.glb", document);
    assert_true(export_to("from.glb", SCENE_UP_Y, &light, 1, "copy.glb"));
    assert_true(export_to("copy.glb", SCENE_UP_Y, &light, 1, "again.glb"));
    void *data[2];
    size_t size[2];
    assert_true(file_read(in_folder("copy.glb"), 1 << 20, &data[0], &size[0], &error));
    assert_true(file_read(in_folder("again.glb"), 1 << 20, &data[1], &size[1], &error));
    assert_int_equal(size[0], size[1]);
    for (int i = 0; i < 2; i++)
        free(data[i]);
    assert_true(export_to("again.glb", SCENE_UP_Y, NULL, 0, "none.glb"));
    scene world = open_up("none.glb", SCENE_UP_Y);
    assert_int_equal(world.light_count, 0);
    assert_int_equal(world.camera_count, 1);
    scene_free(&world);
}

static void what_gltf_cannot_say_is_told(void **state) {
    (void)state;
    scene_light lights[6] = { { .emitter = known[0], .hidden = 1 } };
    lights[1].emitter =
        (lmp_light) { .kind = LMP_LIGHT_TUBE, .half = { { 1, 0, 0 } }, .radius = 1 };
    lights[2].emitter = (lmp_light) {
        .kind = LMP_LIGHT_CAP, .direction = { 0, 1, 0 }, .angle = 0.5f, .radiance = COLOR
    };
    lights[3].emitter = known[2];
    lights[3].emitter.outer = 2;
    lights[4].emitter = known[4];
    lights[4].emitter.half[0].y = 0;
    lights[5].emitter = known[1];
    write_glb("from.glb", document);
    assert_true(export_to("from.glb", SCENE_UP_Y, lights, 6, "copy.glb"));
    assert_string_equal(
        lost, "without 1 spot, 1 rectangle, 1 tube; 1 cap as parallel light; 1 hidden to be seen");
    scene world = open_up("copy.glb", SCENE_UP_Y);
    assert_int_equal(world.light_count, 3);
    const lmp_light *sun = &world.lights[1].emitter;
    assert_int_equal(sun->kind, LMP_LIGHT_DIRECTIONAL);
    CHECK_WITHIN(fabs((double)sun->irradiance.r - 3 * M_PI * sin(0.5) * sin(0.5)), 1e-5);
    scene_free(&world);
}

/* Surfaces that glow give their light to the copy as to the file. */
static void what_glows_stays(void **state) {
    (void)state;
    char *glows = changed("\"emissiveFactor\":[0,0,0]", "\"emissiveFactor\":[1,1,1]");
    write_glb("from.glb", glows);
    scene world = open_up("from.glb", SCENE_UP_Y);
    const size_t count = world.light_count;
    assert_true(count > 1);
    scene_light *lights = calloc(count, sizeof *lights);
    memcpy(lights, world.lights, count * sizeof *lights);
    scene_free(&world);
    for (size_t i = 0; i < count; i++)
        lights[i].glow = i == 0 ? lights[i].glow : 0; /* as of lights that were saved */
    assert_true(export_to("from.glb", SCENE_UP_Y, lights, count, "copy.glb"));
    assert_string_equal(lost, "");
    world = open_up("copy.glb", SCENE_UP_Y);
    assert_int_equal(world.light_count, count);
    scene_free(&world);
    assert_true(export_to("from.glb", SCENE_UP_Y, NULL, 0, "copy.glb"));
    assert_string_equal(lost, "what glows lights as before");
    free(lights);
    free(glows);
}

static void expect_refusal(const char *from, const char *to, const char *why) {
    assert_false(export_to(from, SCENE_UP_Y, NULL, 0, to));
    if (!strstr(error.text, why))
        fail_msg("%s: %s", to, error.text);
}

static void other_names_are_refused(void **state) {
    (void)state;
    char *apart = changed("\"buffers\":[{\"byteLength\":320}]",
                          "\"buffers\":[{\"byteLength\":320,\"uri\":\"a.bin\"}]");
    write_glb("from.glb", document);
    expect_refusal("from.glb", "from.glb", "is the scene itself");
    expect_refusal("from.glb", "copy.gltf", "is the name of no GLB");
    folder_write_text("from.gltf", apart);
    folder_write("a.bin", bytes, sizeof bytes);
    expect_refusal("from.gltf", "copy.glb", "is the name of no glTF");
    expect_refusal("from.gltf", "../copy.gltf", "must lie beside");
    assert_true(export_to("from.gltf", SCENE_UP_Y, NULL, 0, "copy.gltf"));
    scene world = open_up("copy.gltf", SCENE_UP_Y);
    scene_free(&world);
    free(apart);
    folder_write_text("from.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expect_refusal("from.obj", "copy.gltf", "alone can carry lights");
}

static int begin(void **state) {
    fill_bytes();
    return folder_make(state);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_are_read_back), cmocka_unit_test(an_area_of_two_sides_becomes_two),
        cmocka_unit_test(lights_are_replaced),  cmocka_unit_test(what_gltf_cannot_say_is_told),
        cmocka_unit_test(what_glows_stays),     cmocka_unit_test(other_names_are_refused),
    };
    return cmocka_run_group_tests(tests, begin, folder_remove);
}
