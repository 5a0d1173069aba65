/* SPDX-License-Identifier: MIT */
/* KHR_lights_punctual: each light becomes one of the library's kinds at its node, and a point or
 * parallel light takes the size that the command line gives it. */
#include "tests/program/gltf_document.h"

#include <math.h>

#define SPOT                                                                                       \
    "\"spot\",\"color\":[1,0.5,0],\"intensity\":4,\"range\":9,\"spot\":"                           \
    "{\"innerConeAngle\":0.1,\"outerConeAngle\":0.5}"
#define NODE "{\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}"

/* Returns the document's only light. */
static lmp_light read_light(const char *from, const char *to) {
    scene_builder builder;
    base_error error;
    char *text = changed(from, to);
    if (!reads(text, &builder, &error))
        fail_msg("%s: %s", to, error.text);
    assert_int_equal(builder_count(&builder, BLOB_LIGHTS), 1);
    const scene_light light = *(const scene_light *)builder_items(&builder, BLOB_LIGHTS);
    assert_int_equal(light.hidden, 0);
    builder_free(&builder);
    free(text);
    return light.emitter;
}

static void assert_vector(lmp_vec3 v, double x, double y, double z) {
    CHECK_WITHIN(fabs((double)v.x - x), 1e-6);
    CHECK_WITHIN(fabs((double)v.y - y), 1e-6);
    CHECK_WITHIN(fabs((double)v.z - z), 1e-6);
}

static void a_spot_keeps_its_cones_and_shines_along_minus_z(void **state) {
    (void)state;
    /* After a quarter turn around y the node's -z is the world's -x. */
    const lmp_light light = read_light(NODE, "{\"rotation\":[0,0.70710678,0,0.70710678],"
                                             "\"translation\":[1,2,3],\"scale\":[2,2,2],"
                                             "\"extensions\":{\"KHR_lights_punctual\":"
                                             "{\"light\":0}}}");
    assert_int_equal(light.kind, LMP_LIGHT_SPOT);
    assert_vector(light.position, 1, 2, 3);
    assert_vector(light.direction, -1, 0, 0);
    CHECK_WITHIN(fabs((double)light.inner - 0.1), 1e-7);
    CHECK_WITHIN(fabs((double)light.outer - 0.5), 1e-7);
    assert_vector((lmp_vec3) { light.intensity.r, light.intensity.g, light.intensity.b }, 4, 2, 0);
}

static void a_cone_that_is_not_given_is_an_eighth_of_a_circle(void **state) {
    (void)state;
    const lmp_light light = read_light("\"innerConeAngle\":0.1,\"outerConeAngle\":0.5", "");
    CHECK_WITHIN(fabs((double)light.inner), 0);
    CHECK_WITHIN(fabs((double)light.outer - M_PI / 4), 1e-6);
}

/* The light's rays go along -z, so that it is seen toward +z; its position does not count. */
static void parallel_light_is_directional(void **state) {
    (void)state;
    const lmp_light light = read_light(SPOT, "\"directional\",\"intensity\":3,\"color\":[0,1,0.5]");
    assert_int_equal(light.kind, LMP_LIGHT_DIRECTIONAL);
    assert_vector(light.direction, 0, 0, 1);
    assert_vector((lmp_vec3) { light.irradiance.r, light.irradiance.g, light.irradiance.b }, 0, 3,
                  1.5);
}

static void a_point_is_a_point_and_with_a_radius_a_sphere(void **state) {
    (void)state;
    lmp_light light = read_light(SPOT, "\"point\",\"intensity\":3");
    assert_int_equal(light.kind, LMP_LIGHT_POINT);
    assert_true(light.intensity.g == 3 && light.radius == 0);
    light = read_light(SPOT, "\"point\",\"intensity\":3,\"extras\":{\"radius\":0.5}");
    assert_int_equal(light.kind, LMP_LIGHT_SPHERE);
    assert_true(light.radius == 0.5f);
    CHECK_WITHIN(fabs(M_PI * 0.25 * (double)light.radiance.b - 3), 1e-6);
}

#define PUNCTUAL                                                                                   \
    "\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\",\"color\":[1,0.5,0],"                 \
    "\"intensity\":4,\"range\":9,\"spot\":{\"innerConeAngle\":0.1,\"outerConeAngle\":0.5}}]}"

/* Returns the only light of the document with an area light of these members at its node. */
static lmp_light read_area(const char *members, const char *transform) {
    char lights[256], node[256];
    snprintf(lights, sizeof lights, "\"EXT_lights_area\":{\"lights\":[{%s}]}", members);
    snprintf(node, sizeof node, "{%s\"extensions\":{\"EXT_lights_area\":{\"light\":0}}}",
             transform);
    char *text = changed(NODE, node), *whole = replaced(text, PUNCTUAL, lights);
    scene_builder builder;
    base_error error;
    if (!reads(whole, &builder, &error))
        fail_msg("%s: %s", members, error.text);
    assert_int_equal(builder_count(&builder, BLOB_LIGHTS), 1);
    const scene_light light = *(const scene_light *)builder_items(&builder, BLOB_LIGHTS);
    builder_free(&builder);
    free(whole);
    free(text);
    return light.emitter;
}

static lmp_vec3 cross(lmp_vec3 a, lmp_vec3 b) {
    return (lmp_vec3) { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/* EXT_lights_area: the size is along y, the width that times the aspect, both times the node's
 * largest scale; light leaves along -z, even of a mirrored node. */
static void area_lights_have_the_size_of_their_node_and_shine_along_minus_z(void **state) {
    (void)state;
    lmp_light light = read_area("\"type\":\"rect\",\"intensity\":500,\"color\":[1,0.5,0],"
                                "\"size\":2,\"rect\":{\"aspect\":3}",
                                "\"translation\":[1,2,3],\"scale\":[1,-4,1],");
    assert_int_equal(light.kind, LMP_LIGHT_RECTANGLE);
    assert_int_equal(light.two_sided, 0);
    assert_vector(light.position, 1, 2, 3);
    assert_vector(light.half[0], 12, 0, 0);
    assert_vector(cross(light.half[0], light.half[1]), 0, 0, -48);
    assert_vector((lmp_vec3) { light.radiance.r, light.radiance.g, light.radiance.b }, 500, 250, 0);
    light = read_area("\"type\":\"disk\"", "\"rotation\":[0,0.70710678,0,0.70710678],");
    assert_int_equal(light.kind, LMP_LIGHT_DISK);
    assert_vector(light.direction, -1, 0, 0);
    assert_true(light.radius == 0.5f && light.radiance.b == 1000);
}

/* The position of an animated node moves the light, and its rotation is named. */
static void a_direction_that_is_animated_is_unsupported(void **state) {
    (void)state;
    char *values = changed("\"count\":4,\"type\":\"VEC4\"}]",
                           "\"count\":4,\"type\":\"VEC4\"},{\"bufferView\":8,"
                           "\"componentType\":5126,\"count\":2,\"type\":\"VEC4\"}]");
    char *output = replaced(values, "\"output\":6", "\"output\":9");
    char *rotated = replaced(output, "\"path\":\"translation\"", "\"path\":\"rotation\"");
    const char *const texts[] = { document, rotated };
    for (size_t turns = 0; turns < 2; turns++) {
        scene_builder builder;
        base_error error;
        bool named = false;
        if (!reads(texts[turns], &builder, &error))
            fail_msg("%s", error.text);
        const scene_unsupported *items = builder_items(&builder, BLOB_UNSUPPORTED);
        for (size_t i = 0; i < builder_count(&builder, BLOB_UNSUPPORTED); i++)
            named = named || strcmp(items[i].what, "animated direction") == 0;
        assert_int_equal(named, turns);
        assert_int_equal(builder_count(&builder, BLOB_MOTIONS), 1);
        builder_free(&builder);
    }
    free(values);
    free(output);
    free(rotated);
}

static void a_scene_goes_without_lights_that_cannot_be(void **state) {
    (void)state;
    static const char *const cases[][2] = {
        { "\"point\",\"extras\":{\"radius\":-1}", "impossible value (1 light)" },
        { "\"point\",\"intensity\":1e300", "impossible value (1 light)" },
        { "\"directional\",\"intensity\":1e39", "impossible value (1 light)" },
        { "\"area\",\"intensity\":1", "unknown type (1 light)" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *text = changed(SPOT, cases[i][0]), said[256];
        scene_builder builder;
        base_error error;
        bool found = false;
        if (!reads(text, &builder, &error))
            fail_msg("%s: %s", cases[i][0], error.text);
        const scene_unsupported *items = builder_items(&builder, BLOB_UNSUPPORTED);
        for (size_t k = 0; k < builder_count(&builder, BLOB_UNSUPPORTED); k++) {
            scene_unsupported_text(&items[k], said, sizeof said);
            found = found || strcmp(said, cases[i][1]) == 0;
        }
        if (!found)
            fail_msg("%s is not said to be an %s", cases[i][0], cases[i][1]);
        assert_int_equal(builder_count(&builder, BLOB_LIGHTS), 0);
        assert_int_equal(builder_count(&builder, BLOB_MESHES), 1);
        builder_free(&builder);
        free(text);
    }
}

/* The right angle as a float32 is a little more than a right angle. An inner cone as wide as the
 * outer one has a sharp edge. */
static void cones_up_to_a_right_angle_are_taken(void **state) {
    (void)state;
    static const struct {
        const char *cone;
        double inner, outer;
    } cases[] = {
        { "\"innerConeAngle\":0,\"outerConeAngle\":1.5707963705062866", 0, M_PI / 2 },
        { "\"innerConeAngle\":0.5,\"outerConeAngle\":0.5", 0.5, 0.5 },
        { "\"innerConeAngle\":0.7,\"outerConeAngle\":0.5", 0.5, 0.5 },
        { "\"innerConeAngle\":0.7,\"outerConeAngle\":2", 0.7, M_PI / 2 },
        { "\"innerConeAngle\":-1e-9,\"outerConeAngle\":0.5", 0, 0.5 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const lmp_light light =
            read_light("\"innerConeAngle\":0.1,\"outerConeAngle\":0.5", cases[i].cone);
        CHECK_WITHIN(fabs((double)light.inner - cases[i].inner), 1e-6);
        CHECK_WITHIN(fabs((double)light.outer - cases[i].outer), 1e-6);
        assert_true(light.outer <= (float)M_PI);
    }
}

static void the_command_line_gives_points_and_parallel_light_a_size(void **state) {
    (void)state;
    scene_light lights[] = {
        { .emitter = { .kind = LMP_LIGHT_POINT, .intensity = { 1, 2, 3 } } },
        { .emitter = { .kind = LMP_LIGHT_DIRECTIONAL,
                       .direction = { 0, 1, 0 },
                       .irradiance = { 1, 2, 3 } } },
        { .emitter = { .kind = LMP_LIGHT_SPOT, .direction = { 0, 1, 0 }, .outer = 1 } },
    };
    const scene_light before = lights[2];
    scene s = { .lights = lights, .light_count = 3 };
    base_error error;
    assert_true(scene_apply_lights(
        &s, &(scene_lights_options) { .point_radius = 2, .sun_angle = 30 }, &error));
    assert_int_equal(lights[0].emitter.kind, LMP_LIGHT_SPHERE);
    CHECK_WITHIN(fabs(4 * M_PI * (double)lights[0].emitter.radiance.g - 2), 1e-6);
    /* The irradiance of a cap that one faces is pi sin²a L. */
    assert_int_equal(lights[1].emitter.kind, LMP_LIGHT_CAP);
    CHECK_WITHIN(fabs((double)lights[1].emitter.angle - M_PI / 6), 1e-6);
    CHECK_WITHIN(fabs(M_PI * 0.25 * (double)lights[1].emitter.radiance.b - 3), 1e-6);
    assert_memory_equal(&lights[2], &before, sizeof before);
}

/* The radiance of a point as a sphere of 1e-20 m overflows. */
static void a_size_that_no_light_can_have_is_refused(void **state) {
    (void)state;
    const scene_light given[] = {
        { .emitter = { .kind = LMP_LIGHT_POINT, .intensity = { 1, 2, 3 } } },
        { .emitter = { .kind = LMP_LIGHT_DIRECTIONAL,
                       .direction = { 0, 1, 0 },
                       .irradiance = { 1, 2, 3 } } },
    };
    static const char *const expected[] = { "--point-radius", "--sun-angle" };
    for (size_t i = 0; i < 2; i++) {
        scene_light light = given[i];
        scene s = { .lights = &light, .light_count = 1, .name = "file.gltf" };
        base_error error;
        assert_false(scene_apply_lights(
            &s, &(scene_lights_options) { .point_radius = 1e-20f, .sun_angle = 1e-20f }, &error));
        assert_non_null(strstr(error.text, "file.gltf: lights[0].radiance"));
        assert_non_null(strstr(error.text, expected[i]));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_spot_keeps_its_cones_and_shines_along_minus_z),
        cmocka_unit_test(a_cone_that_is_not_given_is_an_eighth_of_a_circle),
        cmocka_unit_test(parallel_light_is_directional),
        cmocka_unit_test(a_point_is_a_point_and_with_a_radius_a_sphere),
        cmocka_unit_test(area_lights_have_the_size_of_their_node_and_shine_along_minus_z),
        cmocka_unit_test(a_direction_that_is_animated_is_unsupported),
        cmocka_unit_test(a_scene_goes_without_lights_that_cannot_be),
        cmocka_unit_test(cones_up_to_a_right_angle_are_taken),
        cmocka_unit_test(the_command_line_gives_points_and_parallel_light_a_size),
        cmocka_unit_test(a_size_that_no_light_can_have_is_refused),
    };
    fill_bytes();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
