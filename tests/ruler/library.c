/* SPDX-License-Identifier: MIT */
/* lmp_shade by every method against the ruler: lobes against their proven truncated series (the
 * code's error), and all materials against the whole truth (the method's error). */
#include "app/truth/ruler_figures.h"
#include "tests/ruler/rows.h"

#include <stdlib.h>
#include <string.h>

#define BAND_COUNTS 5
static const int band_counts[BAND_COUNTS] = { 3, 5, 10, 20, 100 };

static const char *const method_names[LMP_SHADE_METHOD_COUNT] = { "zonal", "coefficients",
                                                                  "preintegrated" };

/* Settings of one method; a preintegrated lobe is made for them. */
typedef struct shading {
    lmp_shade_settings settings;
    lmp_preintegrated_lobe *lobe;
} shading;

static shading shading_of(lmp_shade_method method, int bands, lmp_window window) {
    shading s = { .settings = { .method = method, .bands = bands, .window = window } };
    const lmp_preintegrated_lobe_desc desc = { .bands = bands, .window = window };
    if (method == LMP_SHADE_PREINTEGRATED)
        assert_int_equal(lmp_preintegrated_lobe_create(NULL, &desc, &s.lobe), LMP_OK);
    s.settings.lobe = s.lobe;
    return s;
}

static double shade(const shading *s, const ruler_row *row) {
    const lmp_material material = material_of_row(row);
    const lmp_surface surface = surface_of_row(row);
    const lmp_light light = light_of_row(row);
    return (double)lmp_shade(&s->settings, &material, &surface, &light, 1).g;
}

/* --- the code's error ------------------------------------------------------------------------- */

/* Bounds a light's peak: about its scale times half of e + 1, of which n bands show at most n²/4.
 */
static double peak_of(const ruler_row *row, int bands) {
    const double exponent = row->material == RULER_PHONG ? row->exponent : 1;
    return ruler_scale(row) * fmin((exponent + 1) / 2, bands * bands / 4.0);
}

/* Reads ruler/bands.csv: ten values of each row of lambert and phong, in the order of their ids. */
typedef struct band_values {
    double of[2 * BAND_COUNTS]; /* without a filter, then with Hanning's */
} band_values;
static void read_bands(const ruler_table *table, band_values *values) {
    char line[1024];
    FILE *const file = fopen("ruler/bands.csv", "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    for (int i = 0; i < table->count; i++) {
        if (table->rows[i].material >= RULER_METAL)
            continue;
        char *at = line;
        do {
            assert_non_null(fgets(line, sizeof line, file));
            at = line;
        } while (strtol(at, &at, 10) < table->rows[i].id);
        assert_int_equal(atoi(line), table->rows[i].id);
        for (int k = 0; k < 2 * BAND_COUNTS; k++)
            values[i].of[k] = strtod(at + 1, &at);
    }
    fclose(file);
}

/* Returns the largest error of the rows, relative to their peaks. */
static double code_error(const ruler_table *table, const band_values *values,
                         lmp_shade_method method, int which, int step) {
    const int bands = band_counts[which % BAND_COUNTS];
    const shading s =
        shading_of(method, bands, which < BAND_COUNTS ? LMP_WINDOW_NONE : LMP_WINDOW_HANNING);
    double largest = 0;
    for (int i = 0; i < table->count; i += step) {
        const ruler_row *const row = &table->rows[i];
        if (row->material >= RULER_METAL)
            continue;
        if (row->material == RULER_LAMBERT && method != LMP_SHADE_COEFFICIENTS)
            continue; /* has a closed form */
        const double error = fabs(shade(&s, row) - fmax(values[i].of[which], 0));
        largest = fmax(largest, error / peak_of(row, bands));
    }
    lmp_preintegrated_lobe_destroy(s.lobe);
    return largest;
}

static void lobes_are_their_truncated_series(void **state) {
    (void)state;
    static const double bounds[LMP_SHADE_METHOD_COUNT] = { 1e-5, 1e-4, 0.005 };
    ruler_table table = open_table();
    band_values *const values = calloc((size_t)table.count, sizeof *values);
    assert_non_null(values);
    read_bands(&table, values);
    for (int method = 0; method < LMP_SHADE_METHOD_COUNT; method++) {
        const int step = method == LMP_SHADE_COEFFICIENTS ? check_count(7, 1) : 1;
        for (int k = 0; k < 2 * BAND_COUNTS; k++) {
            const double error = code_error(&table, values, (lmp_shade_method)method, k, step);
            print_message("%-13s %3d bands%s: %.2g of the peak\n", method_names[method],
                          band_counts[k % BAND_COUNTS], k < BAND_COUNTS ? "" : ", Hanning", error);
            CHECK_WITHIN(error, bounds[method]);
        }
    }
    free(values);
    ruler_table_free(&table);
}

/* --- the method's error ----------------------------------------------------------------------- */

/* Returns the root mean square of the relative errors of a material. */
static double method_error(const ruler_table *table, const shading *s, ruler_material material,
                           int step) {
    check_errors errors = { 0 };
    for (int i = 0; i < table->count; i += step) {
        const ruler_row *const row = &table->rows[i];
        if (row->material == material)
            check_errors_add(&errors, ruler_error(row, shade(s, row)));
    }
    return check_errors_rms(&errors);
}

static void methods_are_as_near_the_truth_as_the_page_says(void **state) {
    (void)state;
    static const double bounds[BAND_COUNTS][RULER_MATERIALS] = {
        { 0.45, 20, 10, 10 }, { 0.3, 30, 10, 10 }, { 0.15, 40, 10, 10 },
        { 0.07, 50, 10, 10 }, { 0.015, 30, 5, 5 },
    };
    ruler_table table = open_table();
    for (int method = 0; method < LMP_SHADE_METHOD_COUNT; method++)
        for (int k = 0; k < BAND_COUNTS; k++) {
            const int step = method == LMP_SHADE_COEFFICIENTS ? check_count(7, 1) : 1;
            const shading s = shading_of((lmp_shade_method)method, band_counts[k], LMP_WINDOW_NONE);
            print_message("%-13s %3d bands:", method_names[method], band_counts[k]);
            for (int m = 0; m < RULER_MATERIALS; m++) {
                const double rms = method_error(&table, &s, (ruler_material)m, step);
                print_message(" %s %.3g", ruler_material_names[m], rms);
                CHECK_WITHIN(rms, bounds[k][m]);
            }
            print_message("\n");
            lmp_preintegrated_lobe_destroy(s.lobe);
        }
    ruler_table_free(&table);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lobes_are_their_truncated_series),
        cmocka_unit_test(methods_are_as_near_the_truth_as_the_page_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
