/* SPDX-License-Identifier: MIT */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/sh.h>

#include <math.h>

enum { MOST = LMP_BANDS_MAX * LMP_BANDS_MAX };

static void wide(lmp_vec3 v, double w[3]) {
    w[0] = (double)v.x, w[1] = (double)v.y, w[2] = (double)v.z;
}

/* A row holds one band; its other columns are 0. */
static void evaluates_128_bands(void **state) {
    (void)state;
    static float sh[LMP_BANDS_MAX * LMP_BANDS_MAX];
    check_csv *csv = check_csv_open("basis_128.csv");
    for (int row = 0; row < csv->rows; row++) {
        double w[3], expected[255];
        check_csv_numbers(csv, row, 0, 3, w);
        const int l = (int)check_csv_number(csv, row, 3), count = 2 * l + 1;
        check_csv_numbers(csv, row, 4, count, expected);
        const double length = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
        const lmp_vec3 direction = { (float)(w[0] / length), (float)(w[1] / length),
                                     (float)(w[2] / length) };
        lmp_sh_eval(LMP_BANDS_MAX, direction, sh);
        CHECK_WITHIN(check_error((size_t)count, expected, sh + l * l), 3e-4);
    }
    check_csv_close(csv);
}

static void evaluates_the_vector_file(void **state) {
    (void)state;
    check_csv *csv = check_csv_open("basis.csv");
    for (int row = 0; row < csv->rows; row++) {
        double w[3], expected[169];
        float sh[169];
        check_csv_numbers(csv, row, 0, 3, w);
        check_csv_numbers(csv, row, 3, 169, expected);
        const double length = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
        lmp_sh_eval(
            13,
            (lmp_vec3) { (float)(w[0] / length), (float)(w[1] / length), (float)(w[2] / length) },
            sh);
        CHECK_WITHIN(check_error(169, expected, sh), 3e-5);
    }
    check_csv_close(csv);
}

/* The bounds are ten times the errors of float32 that docs/accuracy.md measures, for the unit
 * direction. */
static void evaluates_any_number_of_bands(void **state) {
    (void)state;
    const struct {
        int bands;
        double bound;
    } cases[] = { { 1, 1e-6 },  { 2, 1e-6 },    { 3, 1.3e-6 },
                  { 10, 3e-5 }, { 30, 4.1e-4 }, { 128, 1e-2 } };
    static double expected[MOST];
    static float sh[MOST];
    for (int i = 0; i < 6; i++) {
        for (int trial = 0; trial < 4; trial++) {
            double w[3];
            const lmp_vec3 direction = check_random_direction();
            wide(direction, w);
            const size_t count = LMP_SH_COUNT(cases[i].bands);
            oracle_sh_eval(cases[i].bands, w, expected);
            lmp_sh_eval(cases[i].bands, direction, sh);
            CHECK_WITHIN(check_error(count, expected, sh), cases[i].bound);
        }
    }
}

static void sums_squares_to_the_addition_theorem_at_128_bands(void **state) {
    (void)state;
    static float sh[MOST];
    const lmp_vec3 directions[] = { { 0, 0, 1 },
                                    { 0, 0, -1 },
                                    { 1, 0, 0 },
                                    { 0, -1, 0 },
                                    check_random_direction(),
                                    check_random_direction() };
    for (int i = 0; i < 6; i++) {
        lmp_sh_eval(LMP_BANDS_MAX, directions[i], sh);
        double sum = 0;
        for (int k = 0; k < MOST; k++)
            sum += (double)sh[k] * (double)sh[k];
        CHECK_WITHIN(fabs(sum / (MOST / (4 * ORACLE_PI)) - 1), 1e-4);
        CHECK_WITHIN(fabs((double)lmp_sh_dot(LMP_BANDS_MAX, sh, sh) / sum - 1), 1e-5);
    }
}

static void stays_finite_next_to_the_poles(void **state) {
    (void)state;
    static float sh[MOST];
    static double expected[MOST];
    for (int power = 1; power <= 40; power++) {
        const float tiny = powf(10, (float)-power);
        const lmp_vec3 direction = { tiny, -tiny, power % 2 ? 1.f : -1.f };
        double w[3];
        wide(direction, w);
        if (power < 4)
            continue; /* not unit in float32 */
        oracle_sh_eval(LMP_BANDS_MAX, w, expected);
        lmp_sh_eval(LMP_BANDS_MAX, direction, sh);
        CHECK_WITHIN(check_error(MOST, expected, sh), 1e-2);
    }
}

static void reconstructs_what_the_coefficients_say(void **state) {
    (void)state;
    for (int bands = 1; bands <= 12; bands++) {
        float sh[144], y[144];
        for (int k = 0; k < bands * bands; k++)
            sh[k] = (float)check_random_between(-1, 1);
        const lmp_vec3 direction = check_random_direction();
        lmp_sh_eval(bands, direction, y);
        double expected = 0;
        for (int k = 0; k < bands * bands; k++)
            expected += (double)sh[k] * (double)y[k];
        CHECK_WITHIN(fabs((double)lmp_sh_reconstruct(bands, sh, direction) - expected),
                     3e-6 * bands);
        CHECK_WITHIN(fabs((double)lmp_sh_dot(bands, sh, y) - expected), 3e-6 * bands);
    }
}

static void rotates_zonal_coefficients_to_any_axis(void **state) {
    (void)state;
    float zonal[20], sh[400], along[400];
    double cap[20];
    oracle_cap_zonal(20, 0.3, cap);
    for (int l = 0; l < 20; l++)
        zonal[l] = (float)cap[l];
    const lmp_vec3 axis = check_random_direction();
    double w[3], expected[400];
    wide(axis, w);
    oracle_cap(20, w, 0.3, expected);
    lmp_sh_expand_zonal(20, zonal, axis, sh);
    CHECK_WITHIN(check_error(400, expected, sh), 1e-5);
    lmp_sh_expand_zonal(20, zonal, (lmp_vec3) { 0, 0, 1 }, along);
    for (int l = 0; l < 20; l++)
        CHECK_WITHIN(fabs((double)along[LMP_SH_INDEX(l, 0)] - cap[l]), 1e-5);
}

/* Compares with central differences of the oracle, in double, at the poles, too. */
static void the_gradient_is_that_of_the_definition(void **state) {
    (void)state;
    enum { BANDS = 20, COUNT = BANDS * BANDS };
    static float sh[COUNT], gradient[3 * COUNT], value[COUNT];
    static double expected[COUNT], above[COUNT], below[COUNT];
    const double step = 1e-5;
    for (int i = 0; i < 30; i++) {
        const lmp_vec3 d = i < 2 ? (lmp_vec3) { 0, 0, i ? -1.f : 1.f } : check_random_direction();
        lmp_sh_eval_gradient(BANDS, d, sh, gradient);
        lmp_sh_eval(BANDS, d, value);
        assert_memory_equal(sh, value, sizeof sh);
        for (int axis = 0; axis < 3; axis++) {
            double w[3];
            wide(d, w);
            w[axis] += step;
            oracle_sh_eval(BANDS, w, above);
            w[axis] -= 2 * step;
            oracle_sh_eval(BANDS, w, below);
            for (int k = 0; k < COUNT; k++)
                expected[k] = (above[k] - below[k]) / (2 * step);
            CHECK_WITHIN(check_error(COUNT, expected, gradient + axis * COUNT), 2e-5);
        }
    }
}

static void combines_two_functions(void **state) {
    (void)state;
    float a[4] = { 1, 2, 3, 4 };
    const float b[4] = { 8, 6, 4, 2 };
    lmp_sh_combine(2, 0.5f, a, -1, b, a);
    const float expected[4] = { -7.5f, -5, -2.5f, 0 };
    assert_memory_equal(a, expected, sizeof a);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(evaluates_128_bands),
        cmocka_unit_test(evaluates_the_vector_file),
        cmocka_unit_test(evaluates_any_number_of_bands),
        cmocka_unit_test(sums_squares_to_the_addition_theorem_at_128_bands),
        cmocka_unit_test(stays_finite_next_to_the_poles),
        cmocka_unit_test(reconstructs_what_the_coefficients_say),
        cmocka_unit_test(rotates_zonal_coefficients_to_any_axis),
        cmocka_unit_test(the_gradient_is_that_of_the_definition),
        cmocka_unit_test(combines_two_functions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
