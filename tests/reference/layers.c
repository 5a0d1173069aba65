/* SPDX-License-Identifier: MIT */
/* Layers over a material of glTF, and occlusion of its surroundings: occlusion maps,
 * KHR_materials_specular, _ior and _clearcoat. */
#include "tests/reference/sheet.h"

#include "tests/oracle/check.h"

#include <math.h>

/* Checks a surface so smooth that only F0 counts, at normal incidence under a white sky: each
 * device within what lobes leave of GGX, and the ground truth within its noise. */
static void check_reflected(const char *material, double expected[2][3]) {
    sheet s;
    image images[SHEET_IMAGES], noise;
    sheet_open(&s, material);
    s.world.light_count = 0; /* a glowing material counts as a light */
    sheet_draw(&s, true, 1, images, &noise);
    for (int half = 0; half < 2; half++)
        for (int c = 0; c < 3; c++) {
            const double truth = expected[half][c];
            CHECK_WITHIN(fabs(sheet_at(&images[SHEET_GPU], half, c) - truth), 0.03 * truth + 1e-4);
            CHECK_WITHIN(fabs(sheet_at(&images[SHEET_CPU], half, c) - truth), 0.03 * truth + 1e-4);
            CHECK_WITHIN(fabs(sheet_at(&images[SHEET_REFERENCE], half, c) - truth),
                         5 * sheet_at(&noise, half, c) + 1e-4);
        }
    sheet_free(images, &noise);
    sheet_close(&s);
}

/* Over a black base F0 of an index of 2 is 1/9, times color and weight; the map's alpha is 0.4 and
 * 1. */
static void a_dielectric_reflects_by_its_index_color_and_weight(void **state) {
    (void)state;
    const double f0 = 0.5 / 9;
    double expected[2][3] = { { 0.4 * f0, 0.2 * f0, 0 }, { f0, 0.5 * f0, 0 } };
    check_reflected("{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1],"
                    "\"metallicFactor\":0,\"roughnessFactor\":0.05},"
                    "\"extensions\":{\"KHR_materials_ior\":{\"ior\":2},\"KHR_materials_specular\":"
                    "{\"specularFactor\":0.5,\"specularColorFactor\":[1,0.5,0],"
                    "\"specularTexture\":{\"index\":0}}}}",
                    expected);
}

/* Without a layer a white base loses nothing, and a metal ignores the layer. */
static void what_a_layer_lacks_passes_to_the_base_and_metals_have_none(void **state) {
    (void)state;
    double white[2][3] = { { 1, 1, 1 }, { 1, 1, 1 } };
    check_reflected("{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0.05},"
                    "\"extensions\":{\"KHR_materials_specular\":{\"specularFactor\":0}}}",
                    white);
    check_reflected("{\"pbrMetallicRoughness\":{\"metallicFactor\":1,\"roughnessFactor\":0.05},"
                    "\"extensions\":{\"KHR_materials_specular\":{\"specularFactor\":0},"
                    "\"KHR_materials_ior\":{\"ior\":3}}}",
                    white);
}

/* The map's red is 0.2 and 1; a strength of 0.5 halves its effect. */
static void occlusion_keeps_off_the_light_of_the_environment(void **state) {
    (void)state;
    double expected[2][3] = { { 0.6, 0.6, 0.6 }, { 1, 1, 1 } };
    check_reflected("{\"pbrMetallicRoughness\":{\"metallicFactor\":1,\"roughnessFactor\":0.05},"
                    "\"occlusionTexture\":{\"index\":0,\"strength\":0.5}}",
                    expected);
}

static void occlusion_leaves_lights_alone(void **state) {
    (void)state;
    sheet s;
    image images[SHEET_IMAGES], noise;
    sheet_open(&s, "{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":1},"
                   "\"occlusionTexture\":{\"index\":0}}");
    s.world.lights[0] = (scene_light) { .emitter = { .kind = LMP_LIGHT_DIRECTIONAL,
                                                     .direction = { 0, 0, 1 },
                                                     .irradiance = { 1, 2, 3 } } };
    s.world.light_count = 1;
    sheet_draw(&s, false, 1, images, &noise);
    for (int i = 0; i < SHEET_IMAGES; i++)
        for (int c = 0; c < 3; c++) {
            assert_true(sheet_at(&images[i], 0, c) > 0.2);
            CHECK_WITHIN(fabs(sheet_at(&images[i], 0, c) - sheet_at(&images[i], 1, c)), 1e-6);
        }
    sheet_free(images, &noise);
    sheet_close(&s);
}

/* Four texels glow, by either set of coordinates. */
static void both_coordinates_of_both_sets_tell_where_a_texture_is_read(void **state) {
    (void)state;
    static const float texels[2][2][3] = { { { 1, 0, 0 }, { 0, 1, 0 } },
                                           { { 0, 0, 1 }, { 1, 1, 1 } } };
    for (int set = 0; set < 2; set++) {
        sheet s;
        image images[SHEET_IMAGES], noise;
        char material[256];
        snprintf(material, sizeof material,
                 "{\"pbrMetallicRoughness\":{\"metallicFactor\":0},\"emissiveFactor\":[1,1,1],"
                 "\"emissiveTexture\":{\"index\":1,\"texCoord\":%d}}",
                 set);
        sheet_open(&s, material);
        s.world.light_count = 0;
        sheet_draw(&s, false, 1, images, &noise);
        for (int i = 0; i < 3 * 4 * SHEET_IMAGES; i++) {
            const int c = i % 3, right = i / 3 % 2, below = i / 6 % 2;
            const int x = right ? SHEET_SIDE - 2 : 1, y = below ? SHEET_SIDE - 2 : 1;
            const float *texel = set ? texels[right][below] : texels[below][right];
            CHECK_WITHIN(fabsf(images[i / 12].rgb[3 * (y * SHEET_SIDE + x) + c] - texel[c]), 1e-3);
        }
        sheet_free(images, &noise);
        sheet_close(&s);
    }
}

/* Returns the blue of a column in the middle of a half. */
static double blue_of(const image *drawn, int half) {
    double sum = 0;
    for (int y = 0; y < SHEET_SIDE; y++)
        sum += (double)drawn->rgb[3 * (y * SHEET_SIDE + (half ? SHEET_SIDE - 2 : 1)) + 2];
    return sum / SHEET_SIDE;
}

/* Two squares of blue 1, one behind the other, show 0.4 of the first and 0.4 of 0.6 of the second.
 */
static void what_blends_shows_what_is_behind(void **state) {
    (void)state;
    sheet s;
    image images[SHEET_IMAGES], noise;
    const double expected[2] = { 0.4 + 0.6 * 0.4, 1 };
    sheet_open(&s, "{\"pbrMetallicRoughness\":{\"metallicFactor\":1,\"roughnessFactor\":0.05,"
                   "\"baseColorTexture\":{\"index\":0}},\"alphaMode\":\"BLEND\"}");
    assert_int_equal(s.world.unsupported_count, 0);
    sheet_draw(&s, true, 256, images, &noise);
    for (int half = 0; half < 2; half++) {
        const double bound = 5 * sheet_at(&noise, half, 2) + 1e-4;
        CHECK_WITHIN(fabs(blue_of(&images[SHEET_GPU], half) - expected[half]), 0.03);
        CHECK_WITHIN(fabs(sheet_at(&images[SHEET_CPU], half, 2) - expected[half]), 0.01);
        CHECK_WITHIN(fabs(sheet_at(&images[SHEET_REFERENCE], half, 2) - expected[half]), bound);
    }
    sheet_free(images, &noise);
    sheet_close(&s);
}

/* Over a black base an index of 2 reflects 1/9 of the map's color, which is sRGB. */
static void a_map_of_specular_colors_tints_the_dielectric(void **state) {
    (void)state;
    const double red = pow((0.2 + 0.055) / 1.055, 2.4), green = pow((0.4 + 0.055) / 1.055, 2.4);
    double expected[2][3] = { { red / 9, green / 9, 1 / 9.0 }, { 1 / 9.0, 1 / 9.0, 1 / 9.0 } };
    check_reflected("{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1],"
                    "\"metallicFactor\":0,\"roughnessFactor\":0.05},"
                    "\"extensions\":{\"KHR_materials_ior\":{\"ior\":2},"
                    "\"KHR_materials_specular\":{\"specularColorTexture\":{\"index\":0}}}}",
                    expected);
}

/* Under a coat over black GGX there is only the light that the surface emits. */
#define COATED(coat)                                                                               \
    "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1],\"metallicFactor\":0},"              \
    "\"emissiveFactor\":[1,0.5,0],\"extensions\":{\"KHR_materials_specular\":"                     \
    "{\"specularFactor\":0},\"KHR_materials_clearcoat\":{" coat "}}}"

static void fill_coated(double left, double right, double expected[2][3]) {
    const double emitted[3] = { 1, 0.5, 0 };
    for (int half = 0; half < 2; half++)
        for (int c = 0; c < 3; c++)
            expected[half][c] = emitted[c] + (half ? right : left) * (1 - emitted[c]);
}

/* The map's red is 0.2 and 1: that fraction of 0.04 is reflected along the normal. */
static void a_coat_reflects_by_its_weight_and_dims_what_is_under_it(void **state) {
    (void)state;
    double expected[2][3];
    fill_coated(0.04 * 0.9 * 0.2, 0.04 * 0.9, expected);
    check_reflected(COATED("\"clearcoatFactor\":0.9,\"clearcoatTexture\":{\"index\":0},"
                           "\"clearcoatRoughnessFactor\":0.05"),
                    expected);
}

/* Coats bent by the map are seen at other angles: (-0.6, -0.2, 1) and (1, 1, 1). */
static void a_coat_has_a_normal_of_its_own(void **state) {
    (void)state;
    double expected[2][3];
    fill_coated(0.04 + 0.96 * pow(1 - 1 / sqrt(1.4), 5), 0.04 + 0.96 * pow(1 - 1 / sqrt(3), 5),
                expected);
    check_reflected(COATED("\"clearcoatFactor\":1,\"clearcoatNormalTexture\":{\"index\":0},"
                           "\"clearcoatRoughnessFactor\":0.05"),
                    expected);
}

/* A light in the mirror direction is reflected less by a rough coat, whose roughness is scaled by
 * its map's green, 0.4 and 1, on both devices as in the ground truth. */
static void a_coat_has_a_roughness_of_its_own(void **state) {
    (void)state;
    sheet s;
    image images[SHEET_IMAGES], noise;
    sheet_open(&s, COATED("\"clearcoatFactor\":1,\"clearcoatRoughnessFactor\":1,"
                          "\"clearcoatRoughnessTexture\":{\"index\":0}"));
    s.world.lights[0] = (scene_light) { .emitter = { .kind = LMP_LIGHT_CAP,
                                                     .direction = { 0, 0, 1 },
                                                     .angle = 0.5f,
                                                     .radiance = { 30, 30, 30 } } };
    s.world.light_count = 1;
    sheet_draw(&s, false, 1, images, &noise);
    for (int half = 0; half < 2; half++) {
        const double truth = sheet_at(&images[SHEET_REFERENCE], half, 2);
        const double bound = 0.05 * truth + 5 * sheet_at(&noise, half, 2);
        CHECK_WITHIN(fabs(sheet_at(&images[SHEET_GPU], half, 2) - truth), bound);
        CHECK_WITHIN(fabs(sheet_at(&images[SHEET_CPU], half, 2) - truth), bound);
    }
    assert_true(sheet_at(&images[SHEET_REFERENCE], 0, 2) >
                1.5 * sheet_at(&images[SHEET_REFERENCE], 1, 2));
    sheet_free(images, &noise);
    sheet_close(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_dielectric_reflects_by_its_index_color_and_weight),
        cmocka_unit_test(what_a_layer_lacks_passes_to_the_base_and_metals_have_none),
        cmocka_unit_test(occlusion_keeps_off_the_light_of_the_environment),
        cmocka_unit_test(occlusion_leaves_lights_alone),
        cmocka_unit_test(both_coordinates_of_both_sets_tell_where_a_texture_is_read),
        cmocka_unit_test(what_blends_shows_what_is_behind),
        cmocka_unit_test(a_map_of_specular_colors_tints_the_dielectric),
        cmocka_unit_test(a_coat_reflects_by_its_weight_and_dims_what_is_under_it),
        cmocka_unit_test(a_coat_has_a_normal_of_its_own),
        cmocka_unit_test(a_coat_has_a_roughness_of_its_own),
    };
    return cmocka_run_group_tests(tests, sheet_folder, folder_remove);
}
