/* SPDX-License-Identifier: MIT */
/* KHR_materials_sheen of a glTF file, as both devices and the ground truth draw it, against the
 * specification. */
#include "tests/reference/sheet.h"

#include "app/render/renderer/override.h"
#include "app/truth/reference_sheen.h"
#include "tests/oracle/check.h"
#include "tests/oracle/sheen.h"

#include <math.h>

/* A dark square without other layers: `sheen` on it, and under a coat. */
#define CLOTH(sheen)                                                                               \
    "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.5,0.5,1],\"metallicFactor\":0},"        \
    "\"extensions\":{\"KHR_materials_specular\":{\"specularFactor\":0},"                           \
    "\"KHR_materials_sheen\":{" sheen "}}}"

typedef struct cloth {
    sheet sheet;
    override_set tables;
    image images[SHEET_IMAGES], noise;
} cloth;

static void draw(cloth *c, const char *json, const scene_light *light) {
    base_error error = { "" };
    c->tables = (override_set) { .count = 0 };
    sheet_open(&c->sheet, json);
    scene *world = &c->sheet.world;
    assert_int_equal(world->unsupported_count, 0);
    sheet_expect(
        override_bake_sheen(&c->tables, world, LMP_SHADE_BANDS_DEFAULT, LMP_WINDOW_NONE, &error) &&
            override_apply(&c->tables, world, c->sheet.renderers[SHEET_GPU], &error) &&
            override_apply(&c->tables, world, c->sheet.renderers[SHEET_CPU], &error),
        &error);
    world->light_count = light != NULL;
    if (light)
        world->lights[0] = *light;
    sheet_draw(&c->sheet, !light, 1, c->images, &c->noise);
}

static void cloth_free(cloth *c) {
    sheet_free(c->images, &c->noise);
    sheet_close(&c->sheet);
    override_free(&c->tables);
}

static double linear(double srgb) {
    return pow((srgb + 0.055) / 1.055, 2.4);
}

/* The map's colors are sRGB, and its alpha is 0.4 and 1, under a white sky. */
static void sheen_reflects_by_its_maps_and_leaves_the_rest(void **state) {
    (void)state;
    const double color[2][3] = { { linear(0.2), linear(0.4), 0.5 }, { 1, 1, 0.5 } };
    const double roughness[2] = { 0.4 * 0.9, 0.9 };
    cloth c;
    draw(&c,
         CLOTH("\"sheenColorFactor\":[1,1,0.5],\"sheenColorTexture\":{\"index\":0},"
               "\"sheenRoughnessFactor\":0.9,\"sheenRoughnessTexture\":{\"index\":0}"),
         NULL);
    for (int half = 0; half < 2; half++) {
        const double e = oracle_sheen_albedo(roughness[half], 0);
        const double most = fmax(color[half][0], fmax(color[half][1], color[half][2]));
        for (int k = 0; k < 3; k++) {
            const double truth = 0.5 * (1 - most * e) + color[half][k] * e;
            CHECK_WITHIN(fabs(sheet_at(&c.images[SHEET_CPU], half, k) - truth), 0.01);
            CHECK_WITHIN(fabs(sheet_at(&c.images[SHEET_REFERENCE], half, k) - truth),
                         5 * sheet_at(&c.noise, half, k) + 1e-3);
            CHECK_WITHIN(fabs(sheet_at(&c.images[SHEET_GPU], half, k) - truth), 0.01);
        }
    }
    cloth_free(&c);
}

/* The view is oblique, where sheen is bright. */
static void sheen_under_a_light_is_the_ground_truth(void **state) {
    (void)state;
    const scene_light light = { .emitter = { .kind = LMP_LIGHT_CAP,
                                             .direction = { 0.8f, 0, 0.6f },
                                             .angle = 0.3f,
                                             .radiance = { 10, 10, 10 } } };
    cloth c;
    draw(&c,
         CLOTH("\"sheenColorFactor\":[1,0.5,0],\"sheenRoughnessFactor\":0.5},"
               "\"KHR_materials_clearcoat\":{\"clearcoatFactor\":1,"
               "\"clearcoatRoughnessFactor\":1"),
         &light);
    for (int k = 0; k < 3; k++) {
        const double truth = sheet_at(&c.images[SHEET_REFERENCE], 1, k);
        const double bound = 0.02 * truth + 5 * sheet_at(&c.noise, 1, k);
        CHECK_WITHIN(fabs(sheet_at(&c.images[SHEET_CPU], 1, k) - truth), bound);
        CHECK_WITHIN(fabs(sheet_at(&c.images[SHEET_GPU], 1, k) - truth), bound);
    }
    assert_true(sheet_at(&c.images[SHEET_REFERENCE], 1, 0) >
                1.05 * sheet_at(&c.images[SHEET_REFERENCE], 1, 2));
    cloth_free(&c);
}

static const reference_sheen_albedos *albedos(void) {
    static reference_sheen_albedos all;
    static bool filled;
    if (!filled)
        reference_sheen_albedos_fill(&all);
    filled = true;
    return &all;
}

/* Views are from above and oblique, on nodes of the table of albedos and between them. */
static void the_reference_leaves_what_sheen_does_not_reflect(void **state) {
    (void)state;
    const double white[3] = { 1, 1, 1 }, colors[3] = { 0.3, 0.8, 0.1 };
    const reference_vec up = { 0, 0, 1 };
    for (double roughness = 0.1; roughness <= 1; roughness += 0.15)
        for (double angle = 0; angle < 1.57; angle += 0.12) {
            const reference_vec view = { sin(angle), 0, cos(angle) };
            const double e = oracle_sheen_albedo(roughness, angle);
            reference_sheen sheen;
            reference_sheen_set(&sheen, albedos(), white, roughness, up, view);
            CHECK_WITHIN(fabs(1 - sheen.under - e), 0.01);
            reference_sheen_set(&sheen, albedos(), colors, roughness, up, view);
            CHECK_WITHIN(fabs(1 - sheen.under - 0.8 * e), 0.01);
        }
}

/* Integrates by midpoints in the cube root of the light's cosine and the square root of its
 * azimuth. */
static double reflected_of_a_sky(const reference_sheen *sheen) {
    enum { NODES = 80 };
    double sum = 0;
    for (int i = 0; i < NODES; i++)
        for (int k = 0; k < NODES; k++) {
            const double root = (i + 0.5) / NODES, z = root * root * root, s = sqrt(1 - z * z);
            const double across = (k + 0.5) / NODES, phi = REFERENCE_PI * across * across;
            double rgb[3];
            reference_sheen_at(sheen, (reference_vec) { s * cos(phi), s * sin(phi), z }, rgb);
            sum += 3 * root * root * 4 * REFERENCE_PI * across * rgb[0];
        }
    return sum / (NODES * NODES);
}

static void the_reference_reflects_no_more_than_arrives(void **state) {
    (void)state;
    static const double cosines[] = { 0.5,  0.1,   0.07,  0.05,  0.03, 0.02,
                                      0.01, 0.005, 0.002, 0.001, 1e-4, 1e-6 };
    const double white[3] = { 1, 1, 1 };
    const reference_vec up = { 0, 0, 1 };
    for (double roughness = 0.07; roughness < 0.35; roughness += 0.025)
        for (size_t k = 0; k < sizeof cosines / sizeof *cosines; k++) {
            const double z = cosines[k];
            const reference_vec view = { sqrt(1 - z * z), 0, z };
            reference_sheen sheen;
            reference_sheen_set(&sheen, albedos(), white, roughness, up, view);
            const double reflected = reflected_of_a_sky(&sheen);
            CHECK_WITHIN(reflected, 1);
            CHECK_WITHIN(fabs(reflected + sheen.under - 1), 0.015);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sheen_reflects_by_its_maps_and_leaves_the_rest),
        cmocka_unit_test(sheen_under_a_light_is_the_ground_truth),
        cmocka_unit_test(the_reference_leaves_what_sheen_does_not_reflect),
        cmocka_unit_test(the_reference_reflects_no_more_than_arrives),
    };
    return cmocka_run_group_tests(tests, sheet_folder, folder_remove);
}
