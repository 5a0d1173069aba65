/* SPDX-License-Identifier: MIT */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/light.h>

#include <math.h>

enum { MOST = LMP_BANDS_MAX * LMP_BANDS_MAX };

static lmp_vec3 narrow(const double v[3]) {
    return (lmp_vec3) { (float)v[0], (float)v[1], (float)v[2] };
}

static void project_file(const char *name, int bands, double bound) {
    check_csv *csv = check_csv_open(name);
    for (int row = 0; row < csv->rows; row++) {
        double in[7], expected[100];
        float sh[100];
        check_csv_numbers(csv, row, 0, 7, in);
        check_csv_numbers(csv, row, 7, bands * bands, expected);
        lmp_sphere_project(bands, narrow(in), (float)in[3], narrow(in + 4), sh);
        CHECK_WITHIN(check_error(LMP_SH_COUNT(bands), expected, sh), bound);
    }
    check_csv_close(csv);
}

static void projects_the_vector_file(void **state) {
    (void)state;
    project_file("sphere.csv", 10, 2e-5);
}

static void projects_the_vector_file_of_points_inside(void **state) {
    (void)state;
    project_file("sphere_inside.csv", 6, 1e-5);
}

static void derives_the_vector_file(void **state) {
    (void)state;
    check_csv *csv = check_csv_open("sphere_gradient.csv");
    for (int row = 0; row < csv->rows; row++) {
        double in[7], expected[108];
        float sh[36], gradient[108];
        check_csv_numbers(csv, row, 0, 7, in);
        check_csv_numbers(csv, row, 7, 108, expected);
        const double v[3] = { in[0] - in[4], in[1] - in[5], in[2] - in[6] };
        const double ratio = in[3] / sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        lmp_sphere_project_gradient(6, narrow(in), (float)in[3], narrow(in + 4), sh, gradient);
        /* touching lights lose a digit with 1 / cos a */
        CHECK_WITHIN(check_error(108, expected, gradient), ratio > 0.99 ? 1e-4 : 7e-6);
    }
    check_csv_close(csv);
}

/* A row has every eleventh coefficient of some bands, 0 in columns past the band. */
static void projects_spheres_and_derives_them_at_128_bands(void **state) {
    (void)state;
    enum { KEPT = 23, STEP = 11, ALL = LMP_BANDS_MAX * LMP_BANDS_MAX };
    static float sh[ALL], gradient[3 * ALL];
    check_csv *csv = check_csv_open("sphere_128.csv");
    for (int row = 0; row < csv->rows; row++) {
        double in[7], expected[4][KEPT];
        float actual[4][KEPT] = { { 0 } };
        check_csv_numbers(csv, row, 0, 7, in);
        const int l = (int)check_csv_number(csv, row, 7);
        lmp_sphere_project_gradient(LMP_BANDS_MAX, narrow(in), (float)in[3], narrow(in + 4), sh,
                                    gradient);
        for (int k = 0; k < KEPT; k++) {
            const int m = STEP * (k - KEPT / 2);
            if (m < -l || m > l)
                continue;
            actual[0][k] = sh[LMP_SH_INDEX(l, m)];
            for (int axis = 0; axis < 3; axis++)
                actual[1 + axis][k] = gradient[(size_t)axis * ALL + (size_t)LMP_SH_INDEX(l, m)];
        }
        for (int part = 0; part < 4; part++) {
            check_csv_numbers(csv, row, 8 + KEPT * part, KEPT, expected[part]);
            CHECK_WITHIN(check_error(KEPT, expected[part], actual[part]), 2e-4);
        }
    }
    check_csv_close(csv);
}

static void gives_zonal_coefficients_of_128_bands(void **state) {
    (void)state;
    check_csv *csv = check_csv_open("zonal.csv");
    for (int row = 0; row < csv->rows; row++) {
        double expected[128];
        float zonal[128];
        check_csv_numbers(csv, row, 1, 128, expected);
        lmp_sphere_project_zonal(128, (float)check_csv_number(csv, row, 0), 1, zonal);
        CHECK_WITHIN(check_error(128, expected, zonal), 4e-6);
    }
    check_csv_close(csv);
}

static void projects_as_its_zonal_coefficients_rotated(void **state) {
    (void)state;
    const float radii[] = { 1e-6f, 0.01f, 0.5f, 0.999f, 1, 1.001f, 3, 1e4f };
    static float zonal[LMP_BANDS_MAX], expected[MOST], sh[MOST];
    static double wide[MOST];
    for (int i = 0; i < 8; i++) {
        const lmp_vec3 w = check_random_direction();
        lmp_sphere_project_zonal(LMP_BANDS_MAX, radii[i], 1, zonal);
        lmp_sh_expand_zonal(LMP_BANDS_MAX, zonal, w, expected);
        lmp_sphere_project(LMP_BANDS_MAX, w, radii[i], (lmp_vec3) { 0, 0, 0 }, sh);
        for (int k = 0; k < MOST; k++)
            wide[k] = (double)expected[k];
        CHECK_WITHIN(check_error(MOST, wide, sh), 1e-3);
    }
}

static void is_continuous_across_the_surface(void **state) {
    (void)state;
    float outside[100], on[100], inside[100];
    double expected[100];
    const lmp_vec3 origin = { 0, 0, 0 };
    for (int trial = 0; trial < 5; trial++) {
        const lmp_vec3 w = check_random_direction();
        const float length = sqrtf(w.x * w.x + w.y * w.y + w.z * w.z);
        lmp_sphere_project(10, w, length * (1 - 1e-6f), origin, outside);
        lmp_sphere_project(10, w, length, origin, on);
        lmp_sphere_project(10, w, length * (1 + 1e-6f), origin, inside);
        for (int k = 0; k < 100; k++)
            expected[k] = (double)on[k];
        /* the cap's edge moves as the square root of the step */
        CHECK_WITHIN(check_error(100, expected, outside), 5e-3);
        CHECK_WITHIN(check_error(100, expected, inside), 5e-3);
    }
}

static void is_continuous_across_the_center(void **state) {
    (void)state;
    float one[100], other[100];
    double expected[100];
    const lmp_vec3 origin = { 0, 0, 0 };
    for (int power = 3; power <= 30; power += 3) {
        const float step = powf(10, (float)-power);
        lmp_sphere_project(10, (lmp_vec3) { step, 0, 0 }, 1, origin, one);
        lmp_sphere_project(10, (lmp_vec3) { -step, step, 0 }, 1, origin, other);
        for (int k = 0; k < 100; k++)
            expected[k] = (double)one[k];
        CHECK_WITHIN(check_error(100, expected, other), 3e-6 + 10 * (double)step);
    }
    lmp_sphere_project(10, origin, 1, origin, one);
    CHECK_WITHIN(fabs((double)one[0] - 2 * sqrt(ORACLE_PI)), 1e-6);
    for (int k = 1; k < 100; k++)
        assert_true(one[k] == 0);
}

static void of_no_size_is_dark_even_where_it_is(void **state) {
    (void)state;
    float sh[100], zonal[10];
    const lmp_vec3 origin = { 0, 0, 0 };
    lmp_sphere_project(10, origin, 0, origin, sh);
    for (int k = 0; k < 100; k++)
        assert_true(sh[k] == 0);
    lmp_sphere_project(10, (lmp_vec3) { 1, 2, 3 }, 0, origin, sh);
    for (int k = 0; k < 100; k++)
        assert_true(sh[k] == 0);
    lmp_sphere_project_zonal(10, 0, 0, zonal);
    for (int l = 0; l < 10; l++)
        assert_true(zonal[l] == 0);
}

static void stays_finite_however_far_or_small(void **state) {
    (void)state;
    const double most = CHECK_ASSERTS ? 16.9 : 18; /* LMP_LENGTH_MAX, or past it */
    for (int i = 0; i < 2000; i++) {
        const lmp_vec3 w = check_random_direction();
        const float distance = powf(10, (float)check_random_between(-37, most));
        const float radius = powf(10, (float)check_random_between(-37, most));
        const lmp_vec3 center = { distance * w.x, distance * w.y, distance * w.z };
        float sh[100];
        lmp_sphere_project(10, center, radius, (lmp_vec3) { 0, 0, 0 }, sh);
        /* a full sphere of radiance 1 has |L_lm| <= 4 pi max |Y_lm| */
        for (int k = 0; k < 100; k++)
            CHECK_WITHIN(fabsf(sh[k]), 4 * ORACLE_PI * 1.3);
    }
}

static void derives_as_the_oracle_does_outside_and_inside(void **state) {
    (void)state;
    const double ratios[] = { 1e-6, 1e-3, 0.1, 0.5, 0.9, 0.99, 1.02, 1.5, 10, 1e3 };
    for (int i = 0; i < 10; i++) {
        const lmp_vec3 w = check_random_direction();
        const lmp_vec3 point = { 0.25f, -0.5f, 0.125f };
        const lmp_vec3 center = { point.x + 2 * w.x, point.y + 2 * w.y, point.z + 2 * w.z };
        const double c[3] = { (double)center.x, (double)center.y, (double)center.z };
        const double p[3] = { (double)point.x, (double)point.y, (double)point.z };
        const float radius = (float)(2 * ratios[i]);
        double expected[100], slopes[300];
        float sh[100], gradient[300];
        oracle_sphere(10, c, (double)radius, p, expected, slopes);
        lmp_sphere_project_gradient(10, center, radius, point, sh, gradient);
        CHECK_WITHIN(check_error(100, expected, sh), 2e-5);
        CHECK_WITHIN(check_error(300, slopes, gradient), 3e-5);
    }
}

static void derives_finitely_on_the_surface_and_at_the_center(void **state) {
    (void)state;
    const lmp_vec3 origin = { 0, 0, 0 };
    const float xs[] = { 0, 1e-30f, 0.5f, 0.9999999f, 1, 1.0000001f };
    for (int i = 0; i < 6; i++) {
        float sh[100], gradient[300];
        lmp_sphere_project_gradient(10, (lmp_vec3) { xs[i], 0, 0 }, 1, origin, sh, gradient);
        for (int k = 0; k < 300; k++)
            CHECK_WITHIN(fabsf(gradient[k]), 1e3);
    }
}

static void derives_128_bands(void **state) {
    (void)state;
    static double expected[MOST], slopes[3 * MOST];
    static float sh[MOST], gradient[3 * MOST];
    const double c[3] = { 1, 2, -3 }, p[3] = { 0, 0.5, 0 };
    oracle_sphere(LMP_BANDS_MAX, c, 1, p, expected, slopes);
    lmp_sphere_project_gradient(LMP_BANDS_MAX, narrow(c), 1, narrow(p), sh, gradient);
    CHECK_WITHIN(check_error(MOST, expected, sh), 1e-3);
    CHECK_WITHIN(check_error(3 * MOST, slopes, gradient), 1e-2);
}

/* Members of spheres lie in planes, in structs, or are the same for all: the bits do not differ,
 * whichever of them do. */
static void sums_have_the_bits_of_planes_wherever_members_lie(void **state) {
    (void)state;
    enum { COUNT = 11, BANDS = 4, VALUES = 3 * LMP_SH_COUNT(BANDS), MEMBERS = 7, APART = 3 };
    static float planes[MEMBERS][COUNT], apart[MEMBERS][APART * COUNT];
    for (int k = 0; k < MEMBERS; k++)
        for (int i = 0; i < COUNT; i++)
            planes[k][i] = apart[k][APART * i] =
                k == 3 ? 0.25f : 1 + (float)((5 * i + 3 * k) % 7) / 4; /* 3: the radius */
    const lmp_vec3 point = { 0.5f, -0.25f, 0.125f };
    const size_t plane = sizeof(float), wide = APART * sizeof(float);
    float expected[VALUES], sums[VALUES];
    for (int which = 0; which < 9; which++) {
        float(*const c)[APART * COUNT] = apart, (*const p)[COUNT] = planes;
        const bool center = which & 1, radiance = which & 4;
        const size_t radius = which == 8 ? 0 : which & 2 ? wide : plane;
        const lmp_spheres spheres = {
            center ? (lmp_vec3_array) { c[0], c[1], c[2], wide }
                   : (lmp_vec3_array) { p[0], p[1], p[2], plane },
            { radius == plane ? p[3] : c[3], radius },
            radiance ? (lmp_vec3_array) { c[4], c[5], c[6], wide }
                     : (lmp_vec3_array) { p[4], p[5], p[6], plane },
        };
        lmp_sphere_sum_n(NULL, BANDS, &spheres, COUNT, NULL, lmp_vec3_array_same(&point), 1,
                         lmp_sh_interleaved(which ? sums : expected, 0));
        if (which)
            assert_memory_equal(sums, expected, sizeof sums);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(projects_the_vector_file),
        cmocka_unit_test(projects_the_vector_file_of_points_inside),
        cmocka_unit_test(derives_the_vector_file),
        cmocka_unit_test(projects_spheres_and_derives_them_at_128_bands),
        cmocka_unit_test(gives_zonal_coefficients_of_128_bands),
        cmocka_unit_test(projects_as_its_zonal_coefficients_rotated),
        cmocka_unit_test(is_continuous_across_the_surface),
        cmocka_unit_test(is_continuous_across_the_center),
        cmocka_unit_test(of_no_size_is_dark_even_where_it_is),
        cmocka_unit_test(stays_finite_however_far_or_small),
        cmocka_unit_test(derives_as_the_oracle_does_outside_and_inside),
        cmocka_unit_test(derives_finitely_on_the_surface_and_at_the_center),
        cmocka_unit_test(derives_128_bands),
        cmocka_unit_test(sums_have_the_bits_of_planes_wherever_members_lie),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
