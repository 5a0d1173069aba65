/* SPDX-License-Identifier: MIT */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/sh.h>

#include <math.h>
#include <stdlib.h>

enum { MOST = LMP_BANDS_MAX * LMP_BANDS_MAX };

static float *allocate_matrices(int bands) {
    float *matrices = malloc(LMP_SH_ROTATION_COUNT(bands) * sizeof *matrices);
    assert_non_null(matrices);
    return matrices;
}

static void matrix_of(lmp_quat q, double rotation[9]) {
    const double wide[4] = { (double)q.x, (double)q.y, (double)q.z, (double)q.w };
    oracle_quaternion_matrix(wide, rotation);
}

static void rotates_the_vector_file(void **state) {
    (void)state;
    check_csv *csv = check_csv_open("rotation.csv");
    float matrices[LMP_SH_ROTATION_COUNT(8)];
    for (int row = 0; row < csv->rows; row++) {
        double q[4], rotation[9], in[64], expected[64];
        float sh[64], rotated[64], matrix[9];
        check_csv_numbers(csv, row, 0, 4, q);
        check_csv_numbers(csv, row, 4, 64, in);
        check_csv_numbers(csv, row, 68, 64, expected);
        const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        for (int k = 0; k < 4; k++)
            q[k] /= length;
        oracle_quaternion_matrix(q, rotation);
        for (int k = 0; k < 64; k++)
            sh[k] = (float)in[k];
        for (int k = 0; k < 9; k++)
            matrix[k] = (float)rotation[k];
        lmp_sh_make_rotation_from_matrix(8, matrix, matrices);
        lmp_sh_rotate(8, matrices, sh, rotated);
        CHECK_WITHIN(check_error(64, expected, rotated), 3e-6);
        for (int bands = 1; bands <= 8; bands++) {
            lmp_sh_rotate_by_matrix(bands, matrix, sh, rotated);
            CHECK_WITHIN(check_error(LMP_SH_COUNT(bands), expected, rotated), 3e-6);
        }
    }
    check_csv_close(csv);
}

/* Compares peaks of 128 bands, by the double-precision basis, which unit.oracle checks against the
 * vectors. */
static void rotates_128_bands_as_the_vector_file_says(void **state) {
    (void)state;
    enum { COUNT = LMP_SH_COUNT(128) };
    check_csv *csv = check_csv_open("rotation_128.csv");
    static double peak[COUNT];
    static float sh[COUNT], rotated[COUNT], matrices[LMP_SH_ROTATION_COUNT(128)];
    for (int row = 0; row < csv->rows; row++) {
        double asked[8], expected[255];
        check_csv_numbers(csv, row, 0, 8, asked);
        check_csv_numbers(csv, row, 8, 255, expected);
        const int l = (int)asked[7];
        const double length = sqrt(asked[4] * asked[4] + asked[5] * asked[5] + asked[6] * asked[6]);
        const double p[3] = { asked[4] / length, asked[5] / length, asked[6] / length };
        const lmp_quat q = { (float)asked[0], (float)asked[1], (float)asked[2], (float)asked[3] };
        oracle_sh_eval(128, p, peak);
        for (int k = 0; k < COUNT; k++)
            sh[k] = (float)peak[k];
        lmp_sh_make_rotation(128, q, matrices);
        lmp_sh_rotate(128, matrices, sh, rotated);
        CHECK_WITHIN(check_error((size_t)(2 * l + 1), expected, rotated + l * l), 1e-6);
    }
    check_csv_close(csv);
}

static void matches_exact_quadrature_of_every_entry(void **state) {
    (void)state;
    const float half = sqrtf(0.5f);
    const lmp_quat rotations[] = {
        { 0, 0, 0, 1 },       { 1, 0, 0, 0 },          { 0, 1, 0, 0 },
        { 0, 0, 1, 0 },       { half, 0, 0, half },    { 0, half, 0, half },
        { half, half, 0, 0 }, { 1e-12f, 0, 0, 1 },     { 1, 2, 3, 4 },
        { 0, 1, 0, 1e-7f },   check_random_rotation(), check_random_rotation(),
    };
    float matrices[LMP_SH_ROTATION_COUNT(7)];
    double expected[LMP_SH_ROTATION_COUNT(7)], rotation[9];
    for (size_t i = 0; i < sizeof rotations / sizeof *rotations; i++) {
        matrix_of(rotations[i], rotation);
        oracle_rotation(7, rotation, expected);
        lmp_sh_make_rotation(7, rotations[i], matrices);
        CHECK_WITHIN(check_error(LMP_SH_ROTATION_COUNT(7), expected, matrices), 2e-7);
    }
}

/* The matrices are correct to float32 rounding; the bounds are those of sums of 2l+1 rounded
 * products. */
static void takes_harmonics_to_the_rotated_direction_at_any_bands(void **state) {
    (void)state;
    const int counts[] = { 1, 2, 10, 30, 60, LMP_BANDS_MAX };
    static float sh[MOST], rotated[MOST];
    static double before[MOST], after[MOST];
    for (int i = 0; i < 6; i++) {
        const int bands = counts[i];
        float *matrices = allocate_matrices(bands);
        for (int trial = 0; trial < 2; trial++) {
            const lmp_quat q = check_random_rotation();
            const lmp_vec3 v = check_random_direction();
            const double w[3] = { (double)v.x, (double)v.y, (double)v.z };
            double rotation[9], direction[3];
            matrix_of(q, rotation);
            for (int k = 0; k < 3; k++)
                direction[k] = rotation[3 * k] * w[0] + rotation[3 * k + 1] * w[1] +
                               rotation[3 * k + 2] * w[2];
            oracle_sh_eval(bands, w, before);
            oracle_sh_eval(bands, direction, after);
            for (size_t k = 0; k < LMP_SH_COUNT(bands); k++)
                sh[k] = (float)before[k];
            lmp_sh_make_rotation(bands, q, matrices);
            lmp_sh_rotate(bands, matrices, sh, rotated);
            CHECK_WITHIN(check_error(LMP_SH_COUNT(bands), after, rotated), 2e-6);
        }
        free(matrices);
    }
}

static void is_orthogonal_at_128_bands(void **state) {
    (void)state;
    float *matrices = allocate_matrices(LMP_BANDS_MAX);
    const lmp_quat rotations[] = { { 0, 1e-3f, 0, 1 },
                                   { 0.7f, 0.7f, 1e-4f, 0 },
                                   check_random_rotation() };
    for (int i = 0; i < 3; i++) {
        lmp_sh_make_rotation(LMP_BANDS_MAX, rotations[i], matrices);
        const int bands[] = { 1, 20, 64, 127 };
        for (int b = 0; b < 4; b++) {
            const int l = bands[b], size = 2 * l + 1;
            const float *matrix = matrices + LMP_SH_ROTATION_COUNT(l);
            for (int row = 0; row < size; row++) {
                for (int other = 0; other <= row; other++) {
                    double sum = 0;
                    for (int k = 0; k < size; k++)
                        sum += (double)matrix[row * size + k] * (double)matrix[other * size + k];
                    CHECK_WITHIN(fabs(sum - (row == other)), 5e-7);
                }
            }
        }
    }
    free(matrices);
}

static void of_no_rotation_is_the_identity(void **state) {
    (void)state;
    float *matrices = allocate_matrices(LMP_BANDS_MAX);
    lmp_sh_make_rotation(LMP_BANDS_MAX, (lmp_quat) { 0, 0, 0, -3 }, matrices);
    const float *entry = matrices;
    for (int l = 0; l < LMP_BANDS_MAX; l++)
        for (int m = 0; m <= 2 * l; m++)
            for (int k = 0; k <= 2 * l; k++)
                CHECK_WITHIN(fabsf(*entry++ - (float)(m == k)), 1e-6);
    free(matrices);
}

static void undoes_itself(void **state) {
    (void)state;
    const lmp_quat q = check_random_rotation(), back = { -q.x, -q.y, -q.z, q.w };
    float *there = allocate_matrices(40), *again = allocate_matrices(40);
    float sh[1600], rotated[1600], returned[1600];
    double expected[1600];
    for (int k = 0; k < 1600; k++) {
        sh[k] = (float)check_random_between(-1, 1);
        expected[k] = (double)sh[k];
    }
    lmp_sh_make_rotation(40, q, there);
    lmp_sh_make_rotation(40, back, again);
    lmp_sh_rotate(40, there, sh, rotated);
    lmp_sh_rotate(40, again, rotated, returned);
    CHECK_WITHIN(check_error(1600, expected, returned), 5e-6);
    free(there);
    free(again);
}

/* The rotations take all four branches: the largest component of the quaternion is x, y, z or w. */
static void a_matrix_rotates_like_its_quaternion(void **state) {
    (void)state;
    enum { BANDS = 6 };
    static float expected[LMP_SH_ROTATION_COUNT(BANDS)], matrices[LMP_SH_ROTATION_COUNT(BANDS)];
    for (int i = 0; i < 40; i++) {
        lmp_quat q = check_random_rotation();
        float *largest[4] = { &q.x, &q.y, &q.z, &q.w };
        *largest[i % 4] *= 10;
        double rotation[9];
        float matrix[9];
        matrix_of(q, rotation);
        for (int k = 0; k < 9; k++)
            matrix[k] = (float)rotation[k];
        lmp_sh_make_rotation(BANDS, q, expected);
        lmp_sh_make_rotation_from_matrix(BANDS, matrix, matrices);
        for (size_t k = 0; k < LMP_SH_ROTATION_COUNT(BANDS); k++)
            CHECK_WITHIN(fabsf(matrices[k] - expected[k]), 3e-6);
    }
}

static void around_z_needs_no_matrices(void **state) {
    (void)state;
    enum { BANDS = 12, COUNT = BANDS * BANDS };
    static float matrices[LMP_SH_ROTATION_COUNT(BANDS)];
    const float angles[] = { 0, 0.3f, -1.9f, 3.14159265f, 40 };
    for (int i = 0; i < 5; i++) {
        float sh[COUNT], expected[COUNT], rotated[COUNT];
        for (int k = 0; k < COUNT; k++)
            sh[k] = (float)check_random_between(-1, 1);
        const double half = (double)angles[i] / 2;
        const lmp_quat q = { 0, 0, (float)sin(half), (float)cos(half) };
        lmp_sh_make_rotation(BANDS, q, matrices);
        lmp_sh_rotate(BANDS, matrices, sh, expected);
        lmp_sh_rotate_z(BANDS, angles[i], sh, rotated);
        lmp_sh_rotate_z(BANDS, angles[i], sh, sh); /* in place */
        assert_memory_equal(sh, rotated, sizeof sh);
        for (int k = 0; k < COUNT; k++)
            CHECK_WITHIN(fabsf(rotated[k] - expected[k]), 4e-6);
    }
}

/* The matrices include those without directions of angles: middle angles of 0, nearly 0 and half a
 * turn. */
static void a_matrix_rotates_without_matrices(void **state) {
    (void)state;
    enum { BANDS = 24 };
    const int counts[] = { 1, 2, 3, 4, 5, 6, 7, 10, 16, 17, BANDS };
    const lmp_quat rotations[] = {
        { 0, 0, 0, 1 },
        { 1, 0, 0, 0 },
        { 0, 1, 0, 0 },
        { 0, 0, 1, 0 },
        { 1e-12f, 0, 0.6f, 0.8f },
        { 1e-5f, 1e-4f, 0.6f, 0.8f },
        { 0.6f, 0.8f, 0, 1e-7f },
        { 0.6f, 0.8f, 1e-4f, 0 },
        { 1, 2, 3, 4 },
        check_random_rotation(),
        check_random_rotation(),
        check_random_rotation(),
    };
    static double matrices[LMP_SH_ROTATION_COUNT(BANDS)], wide[LMP_SH_COUNT(BANDS)],
        expected[LMP_SH_COUNT(BANDS)];
    float sh[LMP_SH_COUNT(BANDS)], rotated[LMP_SH_COUNT(BANDS) + 1];
    for (size_t i = 0; i < sizeof rotations / sizeof *rotations; i++) {
        const lmp_quat q = rotations[i];
        const double four[4] = { (double)q.x, (double)q.y, (double)q.z, (double)q.w };
        double rotation[9];
        float matrix[9];
        matrix_of(q, rotation);
        for (int k = 0; k < 9; k++)
            matrix[k] = (float)rotation[k];
        for (size_t k = 0; k < LMP_SH_COUNT(BANDS); k++)
            wide[k] = (double)(sh[k] = (float)check_random_between(-1, 1));
        lmp_sh_make_rotation_double(BANDS, four, matrices);
        lmp_sh_rotate_double(BANDS, matrices, wide, expected);
        for (size_t n = 0; n < sizeof counts / sizeof *counts; n++) {
            const size_t count = LMP_SH_COUNT(counts[n]);
            rotated[count] = 42;
            lmp_sh_rotate_by_matrix(counts[n], matrix, sh, rotated);
            CHECK_WITHIN(check_error(count, expected, rotated), counts[n] > 6 ? 1e-5 : 3e-6);
            assert_true(rotated[count] == 42);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rotates_the_vector_file),
        cmocka_unit_test(rotates_128_bands_as_the_vector_file_says),
        cmocka_unit_test(matches_exact_quadrature_of_every_entry),
        cmocka_unit_test(takes_harmonics_to_the_rotated_direction_at_any_bands),
        cmocka_unit_test(is_orthogonal_at_128_bands),
        cmocka_unit_test(of_no_rotation_is_the_identity),
        cmocka_unit_test(undoes_itself),
        cmocka_unit_test(a_matrix_rotates_like_its_quaternion),
        cmocka_unit_test(around_z_needs_no_matrices),
        cmocka_unit_test(a_matrix_rotates_without_matrices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
