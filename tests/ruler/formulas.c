/* SPDX-License-Identifier: MIT */
/* The formulas of the scoreboard, where their values are known, and against the ruler. */
#include "app/base/cli.h"
#include "app/truth/board.h"
#include "app/truth/scoreboard_cosines.h"
#include "app/truth/scoreboard_gltf.h"
#include "tests/ruler/formula.h"

#include <stdlib.h>
#include <string.h>

static double value_of(const char *name, const formula_query *query) {
    formula_reads reads;
    base_error error;
    int k = 0;
    while (strcmp(formula_table[k].name, name) != 0)
        assert_true(++k < formula_count);
    assert_true(formula_open(&formula_table[k], NULL, &reads, &error));
    const float value = formula_table[k].radiance(query, &reads);
    formula_close(&reads);
    return (double)value;
}

/* Returns a query for a sphere of r/d `sine` at `angle` degrees on the mirror's side, seen at 40.
 */
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
    const double a = asin(0.5), fraction = (a - sin(a) * cos(a)) / acos(-1);
    const formula_query query = query_of(RULER_LAMBERT, 0.5, 90);
    CHECK_WITHIN(fabs(value_of("sphere", &query) / (0.8 * fraction) - 1), 1e-5);
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

/* Returns our own fit in the form in which others publish theirs: the roughness varies fastest, and
 * b and c are exchanged. The caller may change both strings. */
static char *published_text(const char *begin, const char *between) {
    const size_t room = (size_t)COSINES_SIZE * COSINES_SIZE * 160;
    char *const text = malloc(room);
    size_t used = (size_t)snprintf(text, room, "%s", begin);
    assert_non_null(text);
    for (int list = 0; list < 2; list++) {
        for (int k = 0; k < COSINES_SIZE * COSINES_SIZE; k++) {
            const float *n = cosines_nodes[k % COSINES_SIZE * COSINES_SIZE + k / COSINES_SIZE];
            used += (size_t)snprintf(text + used, room - used, "%.9g, %.9g, %.9g, %.9g, \n",
                                     (double)n[list ? 4 : 0], (double)n[list ? 5 : 2],
                                     list ? 0 : (double)n[1], list ? 0 : (double)n[3]);
        }
        used += (size_t)snprintf(text + used, room - used, "%s", list ? "];\n" : between);
    }
    return text;
}

static void a_published_table_is_read_as_it_stands(void **state) {
    (void)state;
    char *const text = published_text("/* float[4] [a] */ var g_ltc_1 = [", "];\nvar g_ltc_2 = [");
    cosines_table table;
    base_error error;
    assert_true(cosines_parse("ltc.js", text, strlen(text), &table, &error));
    assert_int_equal(table.size, COSINES_SIZE);
    assert_memory_equal(table.nodes, cosines_nodes, sizeof cosines_nodes);
    const formula_reads ours = { .cosines = &cosines_fitted }, theirs = { .cosines = &table };
    for (double angle = 0; angle < 90; angle += 7) {
        const formula_query query = query_of(RULER_DIELECTRIC, 0.3, angle);
        assert_true(formula_cosines(&query, &ours) == formula_cosines(&query, &theirs));
    }
    cosines_free(&table);
    free(text);
}

static void what_is_no_table_of_cosines_is_refused(void **state) {
    (void)state;
    static const struct {
        const char *begin, *between;
    } wrong[] = {
        { "var g_ltc_1 = [ 1, 2, 3, 4, ", "]; g_ltc_2 = [" }, /* too few numbers */
        { "var g_ltc_1 = [ nan, ", "]; g_ltc_2 = [" },
        { "var g_ltc_1 = [", ", 1e39]; g_ltc_2 = [" },
        { "var g_ltc_1 = [", "" }, /* only one list */
        { "var g_ltc_1 = ", "" },
        { "var g_ltc_2 = [1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 1, 1, 1, ];\nvar g_ltc_1 = "
          "[1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 1, 1, 1]; x = [",
          "]" }
    }; /* not invertible */
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        char *const text = published_text(wrong[k].begin, wrong[k].between);
        cosines_table table;
        base_error error = { "" };
        assert_false(cosines_parse("ltc.js", text, strlen(text), &table, &error));
        assert_non_null(strstr(error.text, "ltc.js: is no table of linearly transformed cosines"));
        assert_null(table.own);
        free(text);
    }
}

/* Returns the cosine transformed by the inverse of `rows`, at w. */
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
        lmp_lobe_make_diffuse(3, lambda);
        const lmp_vec3 point = { 0, 0, 0 };
        const lmp_rgb bands = lmp_lobe_response(3, lambda, query.normal, &sphere, 1, point);
        const double expected = 0.8 / acos(-1) * fmax((double)bands.r, 0);
        CHECK_WITHIN(fabs(value_of("irradiance", &query) - expected), 1e-5);
    }
}

/* --- what a table of cosines is worth --------------------------------------------------------- */

static bool is_metal(const ruler_row *row, const void *user) {
    (void)user;
    static const formula metal = { .applies = { [RULER_METAL] = true } };
    return formula_applies(&metal, row);
}

/* Sums what a table's lobe reflects of the row's light above the horizon, over equal solid angles:
 * for a metal, the lobe relative to what it makes of even light. */
static double summed(const cosines_table *table, const ruler_row *row) {
    const formula_query q = formula_query_of(row);
    const formula_reads reads = { .cosines = table };
    const double tilt = acos(fmin((double)q.light.z, 1)), sine = (double)q.sine;
    const double azimuth = atan2((double)q.light.y, (double)q.light.x);
    enum { STEPS = 64 }; /* with more steps, 0.146 and 0.101 */
    const double height = sine * sine / (1 + sqrt(1 - sine * sine)), step = 2 * acos(-1) / STEPS;
    formula_query small = q;
    double sum = 0;
    small.sine = 1e-4f;
    for (int k = 0; k < STEPS * STEPS; k++) {
        const double z = 1 - height * (k % STEPS + 0.5) / STEPS, r = sqrt(1 - z * z);
        const double phi = step * (k / STEPS + 0.5);
        const double x = r * cos(phi), y = r * sin(phi);
        const double out = z * sin(tilt) + x * cos(tilt), up = z * cos(tilt) - x * sin(tilt);
        if (up <= 0)
            continue;
        small.light = (lmp_vec3) { (float)(out * cos(azimuth) - y * sin(azimuth)),
                                   (float)(out * sin(azimuth) + y * cos(azimuth)), (float)up };
        sum += (double)formula_cosines(&small, &reads) / (acos(-1) * 1e-8);
    }
    return sum * height * step / STEPS;
}

static ruler_figures figures_of_lobes(const cosines_table *cosines, const ruler_table *table) {
    double *const values = calloc((size_t)table->count, sizeof *values);
    assert_non_null(values);
    for (int i = 0; i < table->count; i++)
        if (is_metal(&table->rows[i], NULL))
            values[i] = summed(cosines, &table->rows[i]);
    const ruler_figures figures = ruler_figures_of(table, values, is_metal, NULL);
    print_message("lobes of metals, cut by the horizon: rms %.3f, balanced %.3f, energy %.3f\n",
                  figures.rms, figures.balanced, figures.energy);
    free(values);
    return figures;
}

/* The table is that of Heitz et al. (selfshadow/ltc_code, fit/results/ltc.js), if a folder of data
 * has it. */
static void the_authors_own_table_is_as_near_as_the_page_says(void **state) {
    (void)state;
    const char *const data = getenv("LAMPION_DATA");
    char path[512];
    cosines_table published;
    base_error error;
    snprintf(path, sizeof path, "%s/ltc.js", data ? data : ".");
    if (!data || !cosines_read(path, &published, &error)) {
        print_message("skipped: LAMPION_DATA has no ltc.js\n");
        return;
    }
    const cli_list names = { { "published" }, 1 };
    ruler_table table = open_table();
    board b;
    assert_true(board_create(&table, &names, &published, &b, &error));
    const ruler_figures metal = ruler_figures_of(&table, b.scores[0].values, is_metal, NULL);
    CHECK_WITHIN(fabs(metal.rms - 0.490), 0.001);
    CHECK_WITHIN(fabs(metal.balanced - 0.142), 0.001);
    CHECK_WITHIN(fabs(metal.energy - 1.256), 0.001);
    const ruler_figures lobes = figures_of_lobes(&published, &table);
    CHECK_WITHIN(fabs(lobes.rms - 0.151), 0.002);
    CHECK_WITHIN(fabs(lobes.balanced - 0.108), 0.002);
    board_free(&b);
    ruler_table_free(&table);
    cosines_free(&published);
}

/* --- by the ruler ----------------------------------------------------------------------------- */

/* Most bounds would be broken by an error of a few per cent, because there are many rows. */
static void formulas_are_as_near_the_truth_as_the_page_says(void **state) {
    (void)state;
    static const struct {
        const char *name;
        double lambert, metal, dielectric; /* rms errors */
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
    base_error error;
    assert_true(board_create(&table, &all, NULL, &b, &error));
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
        cmocka_unit_test(a_published_table_is_read_as_it_stands),
        cmocka_unit_test(what_is_no_table_of_cosines_is_refused),
        cmocka_unit_test(the_authors_own_table_is_as_near_as_the_page_says),
        cmocka_unit_test(formulas_are_as_near_the_truth_as_the_page_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
