/* SPDX-License-Identifier: MIT */
/* The formulas of the scoreboard, each where its value is known, and by the ruler. */
#include "app/scoreboard/board.h"
#include "app/scoreboard/cosines.h"
#include "app/scoreboard/gltf.h"
#include "tests/ruler/formula.h"

#include <string.h>

static double value_of(const char *name, const formula_query *query) {
    lmp_shade_settings settings;
    lmp_preintegrated_lobe *lobe;
    cli_error error;
    int k = 0;
    while (strcmp(formula_table[k].name, name) != 0)
        assert_true(++k < formula_count);
    assert_true(formula_open(&formula_table[k], &settings, &lobe, &error));
    const float value = formula_table[k].radiance(query, &settings);
    lmp_preintegrated_lobe_destroy(lobe);
    return (double)value;
}

/* A sphere of r/d `sine` at `angle` degrees on the mirror's side, seen at 40. */
static formula_query query_of(ruler_material material, double sine, double angle) {
    const ruler_row row = { .light = RULER_SPHERE,
                            .material = material,
                            .size = sine,
                            .light_angle = angle,
                            .view_angle = 40,
                            .color = 0.8,
                            .roughness = 0.6,
                            .exponent = 20 };
    return formula_query_of(&row);
}

static void a_diffuse_surface_that_faces_the_light_has_its_sine_squared(void **state) {
    (void)state;
    static const struct {
        const char *name;
        double bound;
    } all[] = { { "point", 1e-6 },    { "representative", 1e-6 }, { "sphere", 1e-6 },
                { "gaussian", 0.02 }, { "cosines", 1e-6 },        { "lampion-100", 1e-3 } };
    const formula_query query = query_of(RULER_LAMBERT, 0.3, 0);
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        CHECK_WITHIN(fabs(value_of(all[k].name, &query) / (0.8 * 0.09) - 1), all[k].bound);
}

static void a_sphere_that_the_horizon_halves_has_its_closed_form(void **state) {
    (void)state;
    const double a = asin(0.5), half = (a - sin(a) * cos(a)) / acos(-1);
    const formula_query query = query_of(RULER_LAMBERT, 0.5, 90);
    CHECK_WITHIN(fabs(value_of("sphere", &query) / (0.8 * half) - 1), 1e-5);
}

static void a_small_sphere_is_a_point(void **state) {
    (void)state;
    static const char *const names[] = { "representative", "gaussian", "widened", "halved",
                                         "bevy",           "filament", "godot" };
    static const double bounds[] = { 0.005, 0.15, 0.02, 0.006, 0.006, 0.005, 1e-4 };
    for (int m = RULER_METAL; m <= RULER_DIELECTRIC; m++)
        for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
            const formula_query query = query_of((ruler_material)m, 1e-3, 43);
            const double point = value_of("point", &query);
            CHECK_WITHIN(fabs(value_of(names[k], &query) / point - 1), bounds[k]);
        }
}

static void cosines_of_the_identity_are_a_diffuse_sphere(void **state) {
    (void)state;
    cosines_vector rows[3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    for (double size = 0.001; size < 0.99; size *= 2.3)
        for (double angle = 0; angle < 120; angle += 7) {
            const double t = angle * RADIANS;
            const cosines_vector axis = { 0.6 * sin(t), 0.8 * sin(t), cos(t) };
            const double disk = (double)cosines_over_disk(rows, axis, size * size);
            const double sphere = (double)gltf_sphere((float)cos(t), (float)(size * size));
            CHECK_WITHIN(fabs(disk - sphere), 2e-5 * size * size);
        }
}

/* Of the cosine transformed by the inverse of `rows`, at w. */
static double transformed(cosines_vector rows[3], const double w[3]) {
    double v[3];
    for (int i = 0; i < 3; i++)
        v[i] = rows[i][0] * w[0] + rows[i][1] * w[1] + rows[i][2] * w[2];
    const double squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const double determinant = rows[1][1] * (rows[0][0] * rows[2][2] - rows[0][2] * rows[2][0]);
    return fmax(v[2], 0) / acos(-1) * fabs(determinant) / (squared * squared);
}

static void cosines_over_an_ellipse_are_their_integral(void **state) {
    (void)state;
    cosines_vector rows[3] = { { 1.4, 0, 0.3 }, { 0, 1, 0 }, { -0.2, 0, 0.7 } };
    enum { STEPS = 400 };
    const double sine = 0.4, t = 0.5, height = 1 - sqrt(1 - sine * sine),
                 step = 2 * acos(-1) / STEPS;
    const cosines_vector axis = { 0.6 * sin(t), 0.8 * sin(t), cos(t) };
    const double s[3] = { 0.8, -0.6, 0 }, u[3] = { 0.6 * cos(t), 0.8 * cos(t), -sin(t) };
    double sum = 0;
    for (int k = 0; k < STEPS * STEPS; k++) {
        const double z = 1 - height * (k % STEPS + 0.5) / STEPS, r = sqrt(1 - z * z);
        const double phi = step * (k / STEPS + 0.5);
        double w[3];
        for (int i = 0; i < 3; i++)
            w[i] = z * axis[i] + r * (cos(phi) * s[i] + sin(phi) * u[i]);
        sum += transformed(rows, w) * height * step / STEPS;
    }
    CHECK_WITHIN(fabs((double)cosines_over_disk(rows, axis, sine * sine) / sum - 1), 1e-4);
}

static void irradiance_volumes_are_three_bands_of_the_cosine(void **state) {
    (void)state;
    for (double angle = 0; angle < 180; angle += 11) {
        const formula_query query = query_of(RULER_LAMBERT, 0.6, angle);
        const lmp_light sphere = { .position = query.light,
                                   .radius = query.sine,
                                   .radiance = { 1, 1, 1 } };
        float lambda[3];
        lmp_lobe_diffuse(3, lambda);
        const lmp_vec3 point = { 0, 0, 0 };
        const lmp_rgb bands = lmp_lobe_response(3, lambda, query.normal, &sphere, 1, point);
        const double expected = 0.8 / acos(-1) * fmax((double)bands.r, 0);
        CHECK_WITHIN(fabs(value_of("irradiance", &query) - expected), 1e-5);
    }
}

/* Most of it is a bound that a mistake of a few per cent would break, for the rows are many. */
static void formulas_are_as_near_the_truth_as_the_page_says(void **state) {
    (void)state;
    static const struct {
        const char *name;
        double lambert, metal, dielectric; /* rms */
    } bounds[] = {
        { "black", 0.74, 0.65, 0.71 },
        { "point", 0.23, 39, 43 },
        { "representative", 5e-5, 2.7, 2.7 },
        { "halved", 5e-5, 1.34, 1.42 },
        { "widened", 5e-5, 0.45, 0.26 },
        { "bevy", 0, 1.6, 1.51 },
        { "filament", 0, 119, 101 },
        { "godot", 0, 124, 47 },
        { "sphere", 5e-5, 0, 0 },
        { "gaussian", 0.033, 0.46, 0.26 },
        { "anisotropic", 0.033, 0.42, 0.19 },
        { "cosines", 5e-5, 0.47, 0.115 },
        { "irradiance", 0.27, 0, 0 },
        { "lampion-3", 0.27, 2.2, 0.65 },
        { "lampion-5", 0.16, 2.4, 0.72 },
        { "lampion-10", 0.085, 1.4, 0.38 },
        { "lampion-20", 0.037, 0.97, 0.36 },
        { "lampion-100", 0.0055, 0.18, 0.085 },
        { "preintegrated", 0.006, 0.18, 0.085 },
    };
    const cli_list all = { .count = 0 };
    ruler_table table = open_table();
    board b;
    cli_error error;
    assert_true(board_create(&table, &all, &b, &error));
    assert_int_equal(b.count, sizeof bounds / sizeof *bounds);
    for (int k = 0; k < b.count; k++) {
        board_cell cell = board_all(&b.scores[k]);
        assert_string_equal(cell.by->name, bounds[k].name);
        const double of[RULER_MATERIALS] = { [RULER_LAMBERT] = bounds[k].lambert,
                                             [RULER_METAL] = bounds[k].metal,
                                             [RULER_DIELECTRIC] = bounds[k].dielectric };
        for (int m = 0; m < RULER_MATERIALS; m++) {
            cell.group[RULER_BY_MATERIAL] = m;
            assert_true((board_figures(&b, &b.scores[k], &cell).count > 0) == cell.by->applies[m]);
            if (of[m] > 0)
                CHECK_WITHIN(board_figures(&b, &b.scores[k], &cell).rms, of[m]);
        }
    }
    board_free(&b);
    ruler_table_free(&table);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_diffuse_surface_that_faces_the_light_has_its_sine_squared),
        cmocka_unit_test(a_sphere_that_the_horizon_halves_has_its_closed_form),
        cmocka_unit_test(a_small_sphere_is_a_point),
        cmocka_unit_test(cosines_of_the_identity_are_a_diffuse_sphere),
        cmocka_unit_test(cosines_over_an_ellipse_are_their_integral),
        cmocka_unit_test(irradiance_volumes_are_three_bands_of_the_cosine),
        cmocka_unit_test(formulas_are_as_near_the_truth_as_the_page_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
