/* SPDX-License-Identifier: MIT */
/* Fibers over materials against KHR_materials_sheen: what they reflect of caps, and what they leave
 * of what is under them. */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"
#include "tests/oracle/sheen.h"

#include <lampion/shade.h>

#include <math.h>
#include <string.h>

static lmp_brdf_table *white[LMP_FIBER_TABLES];

static float roughness_of(double table) {
    const double least = (double)LMP_FIBER_ROUGHNESS_MIN;
    return (float)(least + (1 - least) * table / (LMP_FIBER_TABLES - 1));
}

static int make_tables(void **state) {
    (void)state;
    const lmp_brdf_table_desc desc = { .bands = 20 };
    for (int i = 0; i < LMP_FIBER_TABLES; i++) {
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
    for (int i = 0; i < LMP_FIBER_TABLES; i++)
        lmp_brdf_table_destroy(white[i]);
    return 0;
}

static lmp_fibers fibers_of(float roughness, lmp_rgb color) {
    return (lmp_fibers) { color, roughness, (const lmp_brdf_table *const *)white };
}

static lmp_surface seen_from(double angle) {
    return (lmp_surface) { .normal = { 0, 0, 1 },
                           .view = { (float)sin(angle), 0, (float)cos(angle) } };
}

/* The largest error of caps of half angle 0.3 through the zenith, in parts of the largest. */
static double error_of(float roughness) {
    const double half = 0.3;
    const lmp_material cloth = { .fibers = fibers_of(roughness, (lmp_rgb) { 1, 0.5f, 0 }) };
    check_errors errors = { 0 };
    double peak = 0;
    for (int v = 0; v < 4; v++)
        for (int i = -12; i <= 12; i++) {
            const double angle = 25 * v * ORACLE_PI / 180, to = 0.1 * i;
            const lmp_surface surface = seen_from(angle);
            const lmp_light cap = { .kind = LMP_LIGHT_CAP,
                                    .direction = { (float)sin(to), 0, (float)cos(to) },
                                    .angle = (float)half,
                                    .radiance = { 1, 1, 1 } };
            const double expected = oracle_sheen_cap((double)roughness, to, half, angle);
            const lmp_rgb color = lmp_shade(NULL, &cloth, &surface, &cap, 1);
            check_errors_add(&errors, fabs((double)color.r - expected));
            CHECK_WITHIN(fabs((double)color.g - (double)color.r / 2), 1e-6);
            CHECK_WITHIN((double)color.b, 0);
            peak = fmax(peak, expected);
        }
    return errors.largest / peak;
}

/* Also between the tables' roughnesses, where two are mixed. */
static void fibers_of_any_roughness_are_those_of_the_specification(void **state) {
    (void)state;
    for (double table = 1; table < LMP_FIBER_TABLES; table += 1.75) {
        const double error = error_of(roughness_of(table));
        print_message("roughness %.2f: %.4f of the peak\n", (double)roughness_of(table), error);
        CHECK_WITHIN(error, 0.02);
    }
}

static void what_is_under_fibers_has_the_rest(void **state) {
    (void)state;
    const lmp_light sky = { .kind = LMP_LIGHT_HEMISPHERE,
                            .direction = { 0, 0, 1 },
                            .radiance = { 1, 1, 1 } };
    const lmp_rgb color = { 0.25f, 0.75f, 0 };
    for (int t = 2; t < LMP_FIBER_TABLES; t += 3)
        for (int degrees = 0; degrees < 80; degrees += 15) {
            const double angle = degrees * ORACLE_PI / 180, rough = (double)roughness_of(t + 0.5);
            const lmp_surface surface = seen_from(angle);
            const lmp_material cloth = { .diffuse = { 0.5f, 0.5f, 0.5f },
                                         .fibers = fibers_of((float)rough, color) };
            const double e = oracle_sheen_albedo(rough, angle);
            const lmp_rgb actual = lmp_shade(NULL, &cloth, &surface, &sky, 1);
            const double under = 0.5 * (1 - 0.75 * e);
            CHECK_WITHIN(fabs((double)actual.r - (under + 0.25 * e)), 0.01);
            CHECK_WITHIN(fabs((double)actual.g - (under + 0.75 * e)), 0.01);
            CHECK_WITHIN(fabs((double)actual.b - under), 0.01);
        }
}

/* --- many ------------------------------------------------------------------------------------- */

enum { COUNT = 41, LIGHTS = 5 };

typedef struct cloths {
    lmp_surface at[COUNT];
    lmp_material material[COUNT];
    lmp_light lights[LIGHTS];
    float sh[3 * 36];
} cloths;

/* Every third without fibers, every fifth under a coat. */
static void make_cloths(cloths *s) {
    memset(s, 0, sizeof *s);
    for (int i = 0; i < COUNT; i++) {
        const float rough = (float)check_random();
        s->at[i] =
            (lmp_surface) { .normal = check_random_direction(), .view = check_random_direction() };
        s->material[i] = (lmp_material) { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                                          .base_color = { 0.5f, 0.3f, 0.1f },
                                          .roughness = rough };
        if (i % 3)
            s->material[i].fibers = fibers_of(1 - rough, (lmp_rgb) { 0.2f, rough, 0.9f });
        if (i % 5 == 0)
            s->material[i].coat = (lmp_coat) { 0.7f, rough };
    }
    for (int i = 0; i < LIGHTS; i++) {
        const lmp_vec3 to = check_random_direction();
        s->lights[i] = (lmp_light) { .position = { 3 * to.x, 3 * to.y, 3 * to.z },
                                     .radius = 0.5f,
                                     .radiance = { 1, 0.5f, 0.25f } };
    }
    s->sh[0] = s->sh[36] = s->sh[72] = 1;
    s->sh[2] = s->sh[40] = 0.2f;
}

static void many_cloths_are_shaded_as_each_of_them(void **state) {
    (void)state;
    cloths s;
    make_cloths(&s);
    const size_t stride = sizeof *s.at;
    const lmp_surfaces all = {
        .position = { &s.at->position.x, &s.at->position.y, &s.at->position.z, stride },
        .normal = { &s.at->normal.x, &s.at->normal.y, &s.at->normal.z, stride },
        .view = { &s.at->view.x, &s.at->view.y, &s.at->view.z, stride },
        .material = s.material,
        .material_stride = sizeof *s.material,
    };
    const lmp_environment around = { s.sh, 6 };
    for (int environment = 0; environment < 2; environment++) {
        lmp_rgb many[COUNT];
        if (environment)
            lmp_shade_environment_n(NULL, &all, COUNT, &around, 0, &many->r);
        else
            lmp_shade_n(NULL, &all, COUNT, s.lights, LIGHTS, 0, &many->r);
        for (int i = 0; i < COUNT; i++) {
            const lmp_rgb one = environment
                                    ? lmp_shade_environment(NULL, &s.material[i], &s.at[i], &around)
                                    : lmp_shade(NULL, &s.material[i], &s.at[i], s.lights, LIGHTS);
            CHECK_WITHIN(fabs((double)many[i].r - (double)one.r), 3e-5);
            CHECK_WITHIN(fabs((double)many[i].g - (double)one.g), 3e-5);
            CHECK_WITHIN(fabs((double)many[i].b - (double)one.b), 3e-5);
        }
    }
}

static void all_methods_shade_fibers_alike(void **state) {
    (void)state;
    lmp_preintegrated_lobe *lobe;
    assert_int_equal(lmp_preintegrated_lobe_create(NULL, NULL, &lobe), LMP_OK);
    cloths s;
    make_cloths(&s);
    for (int i = 0; i < COUNT; i++) {
        lmp_rgb by[LMP_SHADE_METHODS];
        for (int method = 0; method < LMP_SHADE_METHODS; method++) {
            const lmp_shade_settings settings = { .method = (lmp_shade_method)method,
                                                  .lobe = lobe };
            by[method] = lmp_shade(&settings, &s.material[i], &s.at[i], s.lights, LIGHTS);
        }
        CHECK_WITHIN(fabs((double)by[LMP_SHADE_COEFFICIENTS].r - (double)by[0].r), 1e-5);
        CHECK_WITHIN(fabs((double)by[LMP_SHADE_PREINTEGRATED].r - (double)by[0].r), 6e-3);
    }
    lmp_preintegrated_lobe_destroy(lobe);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fibers_of_any_roughness_are_those_of_the_specification),
        cmocka_unit_test(what_is_under_fibers_has_the_rest),
        cmocka_unit_test(many_cloths_are_shaded_as_each_of_them),
        cmocka_unit_test(all_methods_shade_fibers_alike),
    };
    return cmocka_run_group_tests(tests, make_tables, free_tables);
}
