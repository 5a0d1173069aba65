/* SPDX-License-Identifier: MIT */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/sh.h>

#include <math.h>
#include <stdlib.h>

/* --- any function ----------------------------------------------------------------------------- */

typedef struct series {
    int bands;
    const float *sh;
} series;

static float series_value(lmp_vec3 direction, void *user) {
    const series *f = user;
    return lmp_sh_reconstruct(f->bands, f->sh, direction);
}

static void returns_the_coefficients_of_a_series(void **state) {
    (void)state;
    const int counts[] = { 1, 2, 5, 12, 30 };
    static float sh[900], projected[900];
    static double expected[900];
    for (int i = 0; i < 5; i++) {
        const int bands = counts[i];
        for (int k = 0; k < bands * bands; k++) {
            sh[k] = (float)check_random_between(-1, 1);
            expected[k] = (double)sh[k];
        }
        series f = { bands, sh };
        lmp_sh_project_function(bands, 0, series_value, &f, projected);
        CHECK_WITHIN(check_error(LMP_SH_COUNT(bands), expected, projected), 1e-4);
        lmp_sh_project_function(bands, bands + 3, series_value, &f, projected);
        CHECK_WITHIN(check_error(LMP_SH_COUNT(bands), expected, projected), 1e-4);
    }
}

static void is_exact_up_to_the_documented_degree(void **state) {
    (void)state;
    /* a function of degree 15 seen through 4 bands needs 2 nodes - 4 >= 15: 10 nodes */
    float sh[256], projected[16];
    double expected[16];
    for (int k = 0; k < 256; k++)
        sh[k] = (float)check_random_between(-1, 1);
    for (int k = 0; k < 16; k++)
        expected[k] = (double)sh[k];
    series f = { 16, sh };
    lmp_sh_project_function(4, 10, series_value, &f, projected);
    CHECK_WITHIN(check_error(16, expected, projected), 1e-5);
    lmp_sh_project_function(4, 8, series_value, &f, projected);
    assert_true(check_error(16, expected, projected) > 1e-3);
}

static float constant(lmp_vec3 direction, void *user) {
    (void)direction;
    ++*(int *)user;
    return 1;
}

static void calls_the_function_as_often_as_documented(void **state) {
    (void)state;
    int calls = 0;
    float sh[16];
    lmp_sh_project_function(4, 7, constant, &calls, sh);
    assert_int_equal(calls, 2 * 7 * 7);
    CHECK_WITHIN(fabs((double)sh[0] - 2 * sqrt(ORACLE_PI)), 1e-6);
    for (int k = 1; k < 16; k++)
        CHECK_WITHIN(fabsf(sh[k]), 1e-6);
    static float all[LMP_BANDS_MAX * LMP_BANDS_MAX];
    lmp_sh_project_function(LMP_BANDS_MAX, 0, constant, &calls, all);
    CHECK_WITHIN(fabs((double)all[0] - 2 * sqrt(ORACLE_PI)), 1e-5);
    for (int k = 1; k < LMP_BANDS_MAX * LMP_BANDS_MAX; k++)
        CHECK_WITHIN(fabsf(all[k]), 1e-4);
}

static lmp_rgb color_value(lmp_vec3 direction, void *user) {
    series *f = user;
    return (lmp_rgb) { series_value(direction, &f[0]), series_value(direction, &f[1]),
                       series_value(direction, &f[2]) };
}

static void a_color_is_three_functions(void **state) {
    (void)state;
    enum { BANDS = 6, COUNT = LMP_SH_COUNT(BANDS) };
    float sh[3][COUNT], alone[3][COUNT], together[3][COUNT];
    series f[3];
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < COUNT; k++)
            sh[c][k] = (float)check_random_between(-1, 1);
        f[c] = (series) { BANDS, sh[c] };
        lmp_sh_project_function(BANDS, 0, series_value, &f[c], alone[c]);
    }
    lmp_sh_project_function_rgb(BANDS, 0, color_value, f, together[0]);
    assert_memory_equal(alone, together, sizeof alone);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(returns_the_coefficients_of_a_series),
        cmocka_unit_test(is_exact_up_to_the_documented_degree),
        cmocka_unit_test(calls_the_function_as_often_as_documented),
        cmocka_unit_test(a_color_is_three_functions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
