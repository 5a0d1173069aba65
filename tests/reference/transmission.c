/* SPDX-License-Identifier: MIT */
/* KHR_materials_diffuse_transmission of a glTF file, and leaves of files that say nothing of it, as
 * both devices and the ground truth draw them: of an irradiance E on the back, color T E / pi
 * passes through. */
#include "tests/reference/sheet.h"

#include "tests/oracle/check.h"

#include <math.h>

/* A square that reflects only by its base color. */
#define MATTE(base, more, extensions)                                                              \
    "{\"pbrMetallicRoughness\":{" base ",\"roughnessFactor\":0.5}" more                            \
    ",\"extensions\":{\"KHR_materials_specular\":{\"specularFactor\":0}" extensions "}}"
#define GRAY    "\"baseColorFactor\":[0.5,0.5,0.5,1],\"metallicFactor\":0"
#define THROUGH ",\"KHR_materials_diffuse_transmission\":"

/* Sunlight of irradiance 1, 2, 3 from behind, or from the front. */
static const scene_light behind = { .emitter = { .kind = LMP_LIGHT_DIRECTIONAL,
                                                 .direction = { 0, 0, -1 },
                                                 .irradiance = { 1, 2, 3 } } };
static const scene_light before = { .emitter = { .kind = LMP_LIGHT_DIRECTIONAL,
                                                 .direction = { 0, 0, 1 },
                                                 .irradiance = { 1, 2, 3 } } };

static double linear(double srgb) {
    return pow((srgb + 0.055) / 1.055, 2.4);
}

/* Checks that each half has the expected albedo for the light's irradiance: devices within the
 * bytes that the G-buffer keeps of it. */
static void check_albedo(const char *material, const scene_light *light, double albedo[2][3]) {
    static const double pi = 3.14159265358979323846;
    sheet s;
    image images[SHEET_IMAGES], noise;
    sheet_open(&s, material);
    assert_int_equal(s.world.unsupported_count, 0);
    s.world.lights[0] = *light;
    s.world.light_count = 1;
    sheet_draw(&s, false, 1, images, &noise);
    for (int i = 0; i < SHEET_IMAGES; i++)
        for (int half = 0; half < 2; half++)
            for (int c = 0; c < 3; c++) {
                const double truth = albedo[half][c] * (1 + c) / pi;
                CHECK_WITHIN(fabs(sheet_at(&images[i], half, c) - truth),
                             (i == SHEET_GPU ? 1.5 / 255 : 1e-4) * (1 + c) / pi);
            }
    sheet_free(images, &noise);
    sheet_close(&s);
}

/* The map's alpha is 0.4 and 1, its colors are sRGB. */
static const char mapped[] =
    MATTE(GRAY, "",
          THROUGH "{\"diffuseTransmissionFactor\":0.8,\"diffuseTransmissionTexture\":{\"index\":0},"
                  "\"diffuseTransmissionColorFactor\":[1,0.5,1],"
                  "\"diffuseTransmissionColorTexture\":{\"index\":0}}");

static void light_from_behind_comes_through_by_part_and_color(void **state) {
    (void)state;
    double through[2][3] = { { 0.32 * linear(0.2), 0.32 * 0.5 * linear(0.4), 0.32 },
                             { 0.8, 0.4, 0.8 } };
    check_albedo(mapped, &behind, through);
}

static void what_comes_through_is_not_reflected(void **state) {
    (void)state;
    double reflected[2][3] = { { 0.5 * 0.68, 0.5 * 0.68, 0.5 * 0.68 }, { 0.1, 0.1, 0.1 } };
    check_albedo(mapped, &before, reflected);
}

static void nothing_comes_through_metal_nor_through_what_does_not_say_so(void **state) {
    (void)state;
    double none[2][3] = { { 0 }, { 0 } };
    check_albedo(MATTE("\"metallicFactor\":1", "", THROUGH "{\"diffuseTransmissionFactor\":1}"),
                 &behind, none);
    check_albedo(MATTE(GRAY, ",\"doubleSided\":true", ""), &behind, none);
}

/* Along its normal a coat reflects 0.04, and the rest is seen through it. */
static void light_that_comes_through_is_seen_through_a_coat(void **state) {
    (void)state;
    double through[2][3] = { { 0.48, 0.48, 0.48 }, { 0.48, 0.48, 0.48 } };
    check_albedo(MATTE(GRAY, "",
                       THROUGH "{\"diffuseTransmissionFactor\":0.5},"
                               "\"KHR_materials_clearcoat\":{\"clearcoatFactor\":1}"),
                 &behind, through);
}

/* A sky of radiance 1 on both sides gives the sum of the reflected and the transmitted part. */
static void an_even_sky_is_reflected_and_transmitted(void **state) {
    (void)state;
    sheet s;
    image images[SHEET_IMAGES], noise;
    sheet_open(&s, MATTE(GRAY, "",
                         THROUGH "{\"diffuseTransmissionFactor\":0.5,"
                                 "\"diffuseTransmissionColorFactor\":[0.8,0.4,0]}"));
    s.world.light_count = 0;
    sheet_draw(&s, true, 1, images, &noise);
    for (int i = 0; i < SHEET_IMAGES; i++)
        for (int c = 0; c < 3; c++) {
            const double truth = 0.25 + 0.2 * (2 - c), noisy = 5 * sheet_at(&noise, 0, c);
            CHECK_WITHIN(fabs(sheet_at(&images[i], 0, c) - truth),
                         i == SHEET_REFERENCE ? noisy + 1e-4 : 1.5 / 255);
        }
    sheet_free(images, &noise);
    sheet_close(&s);
}

/* --- leaves of files that say nothing --------------------------------------------------------- */

#define LEAF(color, alpha, sides)                                                                  \
    MATTE("\"baseColorFactor\":" color ",\"metallicFactor\":0", alpha sides, "")
#define MASK  ",\"alphaMode\":\"MASK\""
#define SIDES ",\"doubleSided\":true"

static void a_masked_double_sided_green_surface_is_a_leaf(void **state) {
    (void)state;
    double through[2][3] = { { 0.1, 0.3, 0.05 }, { 0.1, 0.3, 0.05 } };
    double reflected[2][3] = { { 0.2, 0.6, 0.1 }, { 0.2, 0.6, 0.1 } };
    check_albedo(LEAF("[0.2,0.6,0.1,1]", MASK, SIDES), &behind, through);
    check_albedo(LEAF("[0.2,0.6,0.1,1]", MASK, SIDES), &before, reflected);
}

static void other_surfaces_are_no_leaves(void **state) {
    (void)state;
    double none[2][3] = { { 0 }, { 0 } };
    check_albedo(LEAF("[0.6,0.2,0.1,1]", MASK, SIDES), &behind, none);
    check_albedo(LEAF("[0.5,0.5,0.5,1]", MASK, SIDES), &behind, none);
    check_albedo(LEAF("[0.2,0.6,0.1,1]", MASK, ""), &behind, none);
    check_albedo(LEAF("[0.2,0.6,0.1,1]", "", SIDES), &behind, none);
    check_albedo(MATTE("\"baseColorFactor\":[0.2,0.6,0.1,1],\"metallicFactor\":1", MASK SIDES, ""),
                 &behind, none);
}

/* A file with the extension is taken at its word. */
static void leaves_may_be_opaque(void **state) {
    (void)state;
    static const char *const materials[] = {
        LEAF("[0.2,0.6,0.1,1]", MASK, SIDES),
        LEAF("[0.2,0.6,0.1,1]", MASK,
             SIDES) "," MATTE(GRAY, "", THROUGH "{\"diffuseTransmissionFactor\":0.5}"),
    };
    for (int i = 0; i < 2; i++) {
        base_error error = { "" };
        char text[4096];
        scene world;
        const scene_options options = { .no_cache = true,
                                        .leaves = i == 0 ? SCENE_LEAVES_OPAQUE
                                                         : SCENE_LEAVES_TRANSLUCENT };
        snprintf(text, sizeof text, sheet_gltf, materials[i]);
        folder_write_text("opaque.gltf", text);
        sheet_expect(scene_load(in_folder("opaque.gltf"), &options, &world, &error), &error);
        assert_false(scene_is_translucent(&world.materials[0]));
        scene_free(&world);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_from_behind_comes_through_by_part_and_color),
        cmocka_unit_test(what_comes_through_is_not_reflected),
        cmocka_unit_test(nothing_comes_through_metal_nor_through_what_does_not_say_so),
        cmocka_unit_test(light_that_comes_through_is_seen_through_a_coat),
        cmocka_unit_test(an_even_sky_is_reflected_and_transmitted),
        cmocka_unit_test(a_masked_double_sided_green_surface_is_a_leaf),
        cmocka_unit_test(other_surfaces_are_no_leaves),
        cmocka_unit_test(leaves_may_be_opaque),
    };
    return cmocka_run_group_tests(tests, sheet_folder, folder_remove);
}
