/* SPDX-License-Identifier: MIT */
/* Sheen over materials against KHR_materials_sheen: what it reflects of caps, and what it leaves of
 * what is under it. */
#include "tests/oracle/sheen.h"
#include "tests/oracle/check.h"
#include "tests/oracle/crowd.h"
#include "tests/oracle/oracle.h"

#include <lampion/shade.h>

#include <math.h>

static lmp_brdf_table *white[LMP_SHEEN_TABLES];

static float roughness_of(double table) {
    const double least = (double)LMP_SHEEN_ROUGHNESS_MIN;
    return (float)(least + (1 - least) * table / (LMP_SHEEN_TABLES - 1));
}

static int make_tables(void **state) {
    (void)state;
    const lmp_brdf_table_desc desc = { .bands = 20 };
    for (int i = 0; i < LMP_SHEEN_TABLES; i++) {
        const lmp_sheen sheen = { .roughness = roughness_of(i), .color = { 1, 1, 1 } };
        lmp_brdf *brdf;
        assert_int_equal(lmp_brdf_create_sheen(NULL, &sheen, &brdf), LMP_OK);
        assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &white[i]), LMP_OK);
        lmp_brdf_destroy(brdf);
    }
    return 0;
}

static int free_tables(void **state) {
    (void)state;
    for (int i = 0; i < LMP_SHEEN_TABLES; i++)
        lmp_brdf_table_destroy(white[i]);
    return 0;
}

static lmp_sheen_layer sheen_of(float roughness, lmp_rgb color) {
    return (lmp_sheen_layer) { color, roughness, (const lmp_brdf_table *const *)white };
}

static lmp_surface seen_from(double angle) {
    return (lmp_surface) { .normal = { 0, 0, 1 },
                           .view = { (float)sin(angle), 0, (float)cos(angle) } };
}

/* Returns the largest error of caps of half angle 0.3 through the zenith, relative to the largest.
 */
static double error_of(float roughness) {
    const double half_angle = 0.3;
    const lmp_material cloth = { .sheen = sheen_of(roughness, (lmp_rgb) { 1, 0.5f, 0 }) };
    check_errors errors = { 0 };
    double peak = 0;
    for (int v = 0; v < 4; v++)
        for (int i = -12; i <= 12; i++) {
            const double angle = 25 * v * ORACLE_PI / 180, to = 0.1 * i;
            const lmp_surface surface = seen_from(angle);
            const lmp_light cap = { .kind = LMP_LIGHT_CAP,
                                    .direction = { (float)sin(to), 0, (float)cos(to) },
                                    .angle = (float)half_angle,
                                    .radiance = { 1, 1, 1 } };
            const double expected = oracle_sheen_cap((double)roughness, to, half_angle, angle);
            const lmp_rgb color = lmp_shade(NULL, &cloth, &surface, &cap, 1);
            check_errors_add(&errors, fabs((double)color.r - expected));
            CHECK_WITHIN(fabs((double)color.g - (double)color.r / 2), 1e-6);
            CHECK_WITHIN((double)color.b, 0);
            peak = fmax(peak, expected);
        }
    return errors.largest / peak;
}

/* Roughnesses include those between the tables', where two are mixed. */
static void sheen_of_any_roughness_is_that_of_the_specification(void **state) {
    (void)state;
    for (double table = 1; table < LMP_SHEEN_TABLES; table += 1.75) {
        const double error = error_of(roughness_of(table));
        print_message("roughness %.2f: %.4f of the peak\n", (double)roughness_of(table), error);
        CHECK_WITHIN(error, 0.02);
    }
}

static void what_is_under_sheen_has_the_rest(void **state) {
    (void)state;
    const lmp_light sky = { .kind = LMP_LIGHT_HEMISPHERE,
                            .direction = { 0, 0, 1 },
                            .radiance = { 1, 1, 1 } };
    const lmp_rgb color = { 0.25f, 0.75f, 0 };
    for (int t = 2; t < LMP_SHEEN_TABLES; t += 3)
        for (int degrees = 0; degrees < 80; degrees += 15) {
            const double angle = degrees * ORACLE_PI / 180, rough = (double)roughness_of(t + 0.5);
            const lmp_surface surface = seen_from(angle);
            const lmp_material cloth = { .diffuse = { 0.5f, 0.5f, 0.5f },
                                         .sheen = sheen_of((float)rough, color) };
            const double e = oracle_sheen_albedo(rough, angle);
            const lmp_rgb actual = lmp_shade(NULL, &cloth, &surface, &sky, 1);
            const double under = 0.5 * (1 - 0.75 * e);
            CHECK_WITHIN(fabs((double)actual.r - (under + 0.25 * e)), 0.01);
            CHECK_WITHIN(fabs((double)actual.g - (under + 0.75 * e)), 0.01);
            CHECK_WITHIN(fabs((double)actual.b - under), 0.01);
        }
}

/* The surroundings have radiance 1; roughnesses are those of a table, or between two. */
static void sheen_reflects_no_more_than_arrives(void **state) {
    (void)state;
    static const double cosines[] = { 0.1, 0.05, 0.03, 0.02, 0.01, 0.005, 0.002, 0.001, 1e-4 };
    const lmp_light everywhere = { .kind = LMP_LIGHT_CAP,
                                   .direction = { 0, 0, 1 },
                                   .angle = (float)ORACLE_PI,
                                   .radiance = { 1, 1, 1 } };
    for (double table = 0; table < 5; table += 0.25) {
        const float rough = roughness_of(table);
        const lmp_material sheen = { .sheen = sheen_of(rough, (lmp_rgb) { 1, 0.6f, 1 }) };
        const lmp_material cloth = { .diffuse = { 1, 1, 1 },
                                     .sheen = sheen_of(rough, (lmp_rgb) { 1, 0.6f, 1 }) };
        for (size_t k = 0; k < sizeof cosines / sizeof *cosines; k++) {
            const lmp_surface surface = seen_from(acos(cosines[k]));
            const lmp_rgb over = lmp_shade(NULL, &sheen, &surface, &everywhere, 1);
            const lmp_rgb all = lmp_shade(NULL, &cloth, &surface, &everywhere, 1);
            CHECK_WITHIN((double)over.r, 1);
            CHECK_WITHIN((double)over.g, 0.6);
            CHECK_WITHIN((double)all.r, 1 + 1e-6);
            CHECK_WITHIN((double)all.g, 1 + 1e-6);
        }
    }
}

/* --- many ------------------------------------------------------------------------------------- */

/* Makes surfaces of which every third is without sheen, and every fifth under a coat. */
static void make_cloths(crowd *c) {
    crowd_make(c);
    for (int i = 0; i < CROWD_COUNT; i++) {
        const float rough = c->material[i].roughness;
        if (i % 3)
            c->material[i].sheen = sheen_of(1 - rough, (lmp_rgb) { 0.2f, rough, 0.9f });
        if (i % 5 == 0)
            c->material[i].coat = (lmp_coat) { 0.7f, rough };
    }
}

static void many_cloths_are_shaded_as_each_of_them(void **state) {
    (void)state;
    crowd cloths;
    make_cloths(&cloths);
    crowd_check_many(&cloths);
}

static void all_methods_shade_sheen_alike(void **state) {
    (void)state;
    crowd cloths;
    make_cloths(&cloths);
    crowd_check_methods(&cloths, 6e-3);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sheen_of_any_roughness_is_that_of_the_specification),
        cmocka_unit_test(what_is_under_sheen_has_the_rest),
        cmocka_unit_test(sheen_reflects_no_more_than_arrives),
        cmocka_unit_test(many_cloths_are_shaded_as_each_of_them),
        cmocka_unit_test(all_methods_shade_sheen_alike),
    };
    return cmocka_run_group_tests(tests, make_tables, free_tables);
}
