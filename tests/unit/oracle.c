/* SPDX-License-Identifier: MIT */
/* The oracle itself against the vector files, which were made with 40 and more digits. */
#include "tests/oracle/oracle.h"
#include "tests/oracle/check.h"

#include <math.h>
#include <string.h>

static void evaluates_the_basis(void **state) {
    (void)state;
    check_csv *csv = check_csv_open("basis.csv");
    for (int row = 0; row < csv->rows; row++) {
        double w[3], expected[169], sh[169];
        check_csv_numbers(csv, row, 0, 3, w);
        check_csv_numbers(csv, row, 3, 169, expected);
        oracle_sh_eval(13, w, sh);
        CHECK_WITHIN(check_error_double(169, expected, sh), 3e-14);
    }
    check_csv_close(csv);
}

static void spheres_of(const char *name, int bands, double bound) {
    check_csv *csv = check_csv_open(name);
    for (int row = 0; row < csv->rows; row++) {
        double in[7], expected[100], sh[100];
        check_csv_numbers(csv, row, 0, 7, in);
        check_csv_numbers(csv, row, 7, bands * bands, expected);
        oracle_sphere(bands, in, in[3], in + 4, sh, NULL);
        CHECK_WITHIN(check_error_double((size_t)(bands * bands), expected, sh), bound);
    }
    check_csv_close(csv);
}

static void projects_spheres_from_outside(void **state) {
    (void)state;
    spheres_of("sphere.csv", 10, 3e-14);
}

static void projects_spheres_from_inside(void **state) {
    (void)state;
    spheres_of("sphere_inside.csv", 6, 1e-14);
}

static void derives_spheres(void **state) {
    (void)state;
    check_csv *csv = check_csv_open("sphere_gradient.csv");
    for (int row = 0; row < csv->rows; row++) {
        double in[7], expected[108], sh[36], gradient[108];
        check_csv_numbers(csv, row, 0, 7, in);
        check_csv_numbers(csv, row, 7, 108, expected);
        oracle_sphere(6, in, in[3], in + 4, sh, gradient);
        CHECK_WITHIN(check_error_double(108, expected, gradient), 2e-13);
    }
    check_csv_close(csv);
}

static void derives_spheres_inside_as_finite_differences_do(void **state) {
    (void)state;
    enum { COUNT = 36 };
    const double center[3] = { 0, 0, 0 }, h = 1e-5;
    double point[3] = { 0.3, -0.2, 0.4 }, sh[COUNT], gradient[3 * COUNT], before[COUNT],
           after[COUNT], difference[3 * COUNT];
    oracle_sphere(6, center, 1, point, sh, gradient);
    for (int k = 0; k < 3; k++) {
        point[k] += h;
        oracle_sphere(6, center, 1, point, after, NULL);
        point[k] -= 2 * h;
        oracle_sphere(6, center, 1, point, before, NULL);
        point[k] += h;
        for (int i = 0; i < COUNT; i++)
            difference[k * COUNT + i] = (after[i] - before[i]) / (2 * h);
    }
    CHECK_WITHIN(check_error_double(3 * COUNT, difference, gradient), 1e-8);
}

static void agrees_with_quadrature_over_the_cap(void **state) {
    (void)state;
    const double angles[] = { 0.01, 0.5, 1.5, 2.5, 3.1 };
    for (int i = 0; i < 5; i++) {
        const lmp_vec3 axis = check_random_direction();
        const double w[3] = { (double)axis.x, (double)axis.y, (double)axis.z };
        const double one_minus_cos = 2 * pow(sin(angles[i] / 2), 2);
        double zonal[12], y[144], expected[144], sh[144];
        oracle_cap_zonal(12, one_minus_cos, zonal);
        oracle_sh_eval(12, w, y);
        oracle_cap(12, w, one_minus_cos, expected);
        for (int l = 0; l < 12; l++)
            for (int k = l * l; k < (l + 1) * (l + 1); k++)
                sh[k] = zonal[l] * sqrt(4 * ORACLE_PI / (2 * l + 1)) * y[k];
        CHECK_WITHIN(check_error_double(144, expected, sh), 1e-13);
    }
}

static void integrates_lobes(void **state) {
    (void)state;
    check_csv *csv = check_csv_open("lobe.csv");
    for (int row = 0; row < csv->rows; row++) {
        const char *kind = check_csv_text(csv, row, 0);
        const double exponent = check_csv_number(csv, row, 1);
        double expected[32], lambda[32];
        check_csv_numbers(csv, row, 2, 32, expected);
        if (strcmp(kind, "cosine") == 0)
            oracle_lobe_diffuse(32, lambda);
        else if (strcmp(kind, "phong") == 0)
            oracle_lobe_phong(32, exponent, lambda);
        else
            oracle_lobe_vmf(32, exponent, lambda);
        for (int l = 0; l < 32; l++)
            CHECK_WITHIN(fabs(lambda[l] - expected[l]), 5e-15);
    }
    check_csv_close(csv);
}

static void rotates(void **state) {
    (void)state;
    check_csv *csv = check_csv_open("rotation.csv");
    for (int row = 0; row < csv->rows; row++) {
        double q[4], rotation[9], in[64], expected[64], out[64] = { 0 }, matrices[680];
        check_csv_numbers(csv, row, 0, 4, q);
        check_csv_numbers(csv, row, 4, 64, in);
        check_csv_numbers(csv, row, 68, 64, expected);
        const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        for (int k = 0; k < 4; k++)
            q[k] /= length;
        oracle_quaternion_matrix(q, rotation);
        oracle_rotation(8, rotation, matrices);
        const double *entry = matrices;
        for (int l = 0; l < 8; l++)
            for (int m = l * l; m < (l + 1) * (l + 1); m++)
                for (int k = l * l; k < (l + 1) * (l + 1); k++)
                    out[m] += *entry++ * in[k];
        CHECK_WITHIN(check_error_double(64, expected, out), 1e-14);
    }
    check_csv_close(csv);
}

static void integrates_zonal_coefficients_of_100_bands(void **state) {
    (void)state;
    check_csv *csv = check_csv_open("zonal.csv");
    for (int row = 0; row < csv->rows; row++) {
        double expected[100], zonal[100];
        const double ratio = check_csv_number(csv, row, 0);
        check_csv_numbers(csv, row, 1, 100, expected);
        oracle_cap_zonal(100, ratio * ratio / (1 + sqrt((1 - ratio) * (1 + ratio))), zonal);
        CHECK_WITHIN(check_error_double(100, expected, zonal), 1e-14);
    }
    check_csv_close(csv);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(evaluates_the_basis),
        cmocka_unit_test(projects_spheres_from_outside),
        cmocka_unit_test(projects_spheres_from_inside),
        cmocka_unit_test(derives_spheres),
        cmocka_unit_test(derives_spheres_inside_as_finite_differences_do),
        cmocka_unit_test(agrees_with_quadrature_over_the_cap),
        cmocka_unit_test(integrates_lobes),
        cmocka_unit_test(rotates),
        cmocka_unit_test(integrates_zonal_coefficients_of_100_bands),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
