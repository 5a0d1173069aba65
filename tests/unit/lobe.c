/* SPDX-License-Identifier: MIT */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/lobe.h>

#include <float.h>
#include <math.h>
#include <string.h>

static void narrow(int count, const double *wide, float *values) {
    for (int k = 0; k < count; k++)
        values[k] = (float)wide[k];
}

static void matches_the_vector_file(void **state) {
    (void)state;
    check_csv *csv = check_csv_open("lobe.csv");
    for (int row = 0; row < csv->rows; row++) {
        const char *kind = check_csv_text(csv, row, 0);
        const float exponent = (float)check_csv_number(csv, row, 1);
        double expected[32];
        float lambda[32];
        check_csv_numbers(csv, row, 2, 32, expected);
        if (strcmp(kind, "cosine") == 0)
            lmp_lobe_make_diffuse(32, lambda);
        else if (strcmp(kind, "phong") == 0)
            lmp_lobe_make_phong(32, exponent, lambda);
        else
            lmp_lobe_make_vmf(32, exponent, lambda);
        for (int l = 0; l < 32; l++)
            CHECK_WITHIN(fabs((double)lambda[l] - expected[l]), 3e-6);
    }
    check_csv_close(csv);
}

static void matches_quadrature_at_128_bands(void **state) {
    (void)state;
    const float exponents[] = { 0, 0.37f, 1, 2.5f, 20, 126, 127.5f, 1e3f, 1e5f, 1e9f };
    const float concentrations[] = { 1e-6f, 0.1f, 1, 10, 300, 1e5f, 1e8f };
    double expected[LMP_BANDS_MAX];
    float lambda[LMP_BANDS_MAX];
    lmp_lobe_make_diffuse(LMP_BANDS_MAX, lambda);
    oracle_lobe_diffuse(LMP_BANDS_MAX, expected);
    CHECK_WITHIN(check_error(LMP_BANDS_MAX, expected, lambda), 1e-7);
    for (int i = 0; i < 10; i++) {
        lmp_lobe_make_phong(LMP_BANDS_MAX, exponents[i], lambda);
        oracle_lobe_phong(LMP_BANDS_MAX, (double)exponents[i], expected);
        CHECK_WITHIN(check_error(LMP_BANDS_MAX, expected, lambda), 1e-7);
    }
    for (int i = 0; i < 7; i++) {
        lmp_lobe_make_vmf(LMP_BANDS_MAX, concentrations[i], lambda);
        oracle_lobe_vmf(LMP_BANDS_MAX, (double)concentrations[i], expected);
        CHECK_WITHIN(check_error(LMP_BANDS_MAX, expected, lambda), 1e-7);
    }
}

/* The downward ratios must have forgotten their start, however few bands are asked for. */
static void vmf_does_not_depend_on_the_number_of_bands(void **state) {
    (void)state;
    const float concentrations[] = { 1, 30, 100, 300, 2000, 1e4f };
    double expected[LMP_BANDS_MAX];
    float lambda[LMP_BANDS_MAX];
    for (int i = 0; i < 6; i++) {
        oracle_lobe_vmf(12, (double)concentrations[i], expected);
        for (int bands = 1; bands <= 12; bands++) {
            lmp_lobe_make_vmf(bands, concentrations[i], lambda);
            CHECK_WITHIN(check_error((size_t)bands, expected, lambda), 1e-7);
        }
    }
}

static void becomes_a_dirac_as_it_sharpens(void **state) {
    (void)state;
    float lambda[LMP_BANDS_MAX];
    lmp_lobe_make_phong(LMP_BANDS_MAX, FLT_MAX, lambda);
    for (int l = 0; l < LMP_BANDS_MAX; l++)
        CHECK_WITHIN(fabsf(lambda[l] - 1), 1e-6);
    lmp_lobe_make_vmf(LMP_BANDS_MAX, FLT_MAX, lambda);
    for (int l = 0; l < LMP_BANDS_MAX; l++)
        CHECK_WITHIN(fabsf(lambda[l] - 1), 1e-6);
    lmp_lobe_make_vmf(LMP_BANDS_MAX, FLT_MIN, lambda);
    for (int l = 1; l < LMP_BANDS_MAX; l++)
        CHECK_WITHIN(fabsf(lambda[l]), 1e-6);
}

static void projects_as_its_factors_times_the_harmonics(void **state) {
    (void)state;
    float lambda[10], sh[100];
    double y[100];
    const lmp_vec3 axis = check_random_direction();
    const double w[3] = { (double)axis.x, (double)axis.y, (double)axis.z };
    lmp_lobe_make_phong(10, 7, lambda);
    lmp_lobe_project(10, lambda, axis, sh);
    oracle_sh_eval(10, w, y);
    for (int l = 0; l < 10; l++)
        for (int k = l * l; k < (l + 1) * (l + 1); k++)
            y[k] *= (double)lambda[l];
    CHECK_WITHIN(check_error(100, y, sh), 1e-5);
}

/* Lights of every kind, one of them containing the point. */
static const lmp_light lights[] = {
    { .kind = LMP_LIGHT_SPHERE, .position = { 1, 2, -1 }, .radius = 0.5f, .radiance = { 3, 2, 1 } },
    { .kind = LMP_LIGHT_SPHERE,
      .position = { 0.2f, 0, 0.1f },
      .radius = 2,
      .radiance = { 1, 2, 3 } },
    { .kind = LMP_LIGHT_POINT, .position = { -2, 1, 0 }, .intensity = { 4, 4, 2 } },
    { .kind = LMP_LIGHT_SPOT,
      .position = { 0, 3, 0 },
      .direction = { 0, -1, 0 },
      .inner = 0.2f,
      .outer = 0.6f,
      .intensity = { 9, 8, 7 } },
    { .kind = LMP_LIGHT_DIRECTIONAL, .direction = { 0.6f, 0, 0.8f }, .irradiance = { 1, 1, 2 } },
    { .kind = LMP_LIGHT_CAP, .direction = { 0, 0, 1 }, .angle = 0.3f, .radiance = { 2, 2, 2 } },
    { .kind = LMP_LIGHT_CAP, .direction = { 0, 1, 0 }, .angle = 2.5f, .radiance = { 1, 0, 1 } },
    { .kind = LMP_LIGHT_HEMISPHERE,
      .direction = { 0, 1, 0 },
      .radiance = { 1, 1, 2 },
      .ground = { 0.5f, 0.2f, 0.1f } },
};
enum { LIGHT_COUNT = sizeof lights / sizeof *lights };

static void answers_lights_as_the_dot_product_of_coefficients_does(void **state) {
    (void)state;
    const int counts[] = { 1, 3, 10, 50 };
    static float sh[3 * 2500], lobe[2500];
    float lambda[50];
    const lmp_vec3 point = { 0.1f, -0.2f, 0.3f };
    for (int i = 0; i < 4; i++) {
        const int bands = counts[i];
        for (int trial = 0; trial < 8; trial++) {
            const lmp_vec3 axis = check_random_direction();
            lmp_lobe_make_phong(bands, (float)(trial * trial), lambda);
            lmp_lobe_project(bands, lambda, axis, lobe);
            lmp_light_project(bands, lights, LIGHT_COUNT, point, sh);
            const lmp_rgb response =
                lmp_lobe_response(bands, lambda, axis, lights, LIGHT_COUNT, point);
            const float channels[3] = { response.r, response.g, response.b };
            double expected[3];
            for (int c = 0; c < 3; c++)
                expected[c] = (double)lmp_sh_dot(bands, sh + (size_t)c * LMP_SH_COUNT(bands), lobe);
            CHECK_WITHIN(check_error(3, expected, channels), 3e-5);
        }
    }
}

static void answers_no_lights_with_nothing(void **state) {
    (void)state;
    float lambda[5];
    lmp_lobe_make_diffuse(5, lambda);
    const lmp_rgb response =
        lmp_lobe_response(5, lambda, (lmp_vec3) { 0, 0, 1 }, NULL, 0, (lmp_vec3) { 0, 0, 0 });
    assert_true(response.r == 0 && response.g == 0 && response.b == 0);
}

/* The normal irradiance of a sphere above the horizon is pi L sin²a cos: exact, and what the series
 * tends to. */
static void diffuse_tends_to_the_irradiance_of_a_sphere(void **state) {
    (void)state;
    const lmp_light sphere = { .position = { 0, 1.2f, 1.6f },
                               .radius = 0.6f,
                               .radiance = { 1, 2, 3 } };
    const double exact = ORACLE_PI * 0.09 * 0.8;
    const struct {
        int bands;
        double bound;
    } cases[] = { { 3, 6e-2 }, { 5, 2e-2 }, { 10, 3e-3 }, { 40, 6e-5 } };
    for (int i = 0; i < 4; i++) {
        float lambda[40];
        lmp_lobe_make_diffuse(cases[i].bands, lambda);
        const lmp_rgb response = lmp_lobe_response(cases[i].bands, lambda, (lmp_vec3) { 0, 0, 1 },
                                                   &sphere, 1, (lmp_vec3) { 0, 0, 0 });
        CHECK_WITHIN(fabs((double)response.r / exact - 1), cases[i].bound);
        CHECK_WITHIN(fabs((double)response.b / (3 * exact) - 1), cases[i].bound);
    }
}

/* Compares with a double sum; float's rounding of q·w alone would cost 1e-3. */
static void keeps_its_digits_where_a_sharp_lobe_points_at_a_far_light(void **state) {
    (void)state;
    double wide[LMP_BANDS_MAX], zonal[LMP_BANDS_MAX], p[LMP_BANDS_MAX];
    float lambda[LMP_BANDS_MAX];
    oracle_lobe_phong(LMP_BANDS_MAX, 5000, wide);
    narrow(LMP_BANDS_MAX, wide, lambda);
    const lmp_light sphere = { .position = { 0, 0, 100 }, .radius = 1, .radiance = { 1, 1, 1 } };
    oracle_cap_zonal(LMP_BANDS_MAX, 1e-4 / (1 + sqrt(1 - 1e-4)), zonal);
    for (int i = 0; i < 20; i++) {
        const double angle = 0.002 * i;
        const lmp_vec3 q = { (float)sin(angle), 0, (float)cos(angle) };
        /* the angle of q as it is stored */
        const double stored = atan2((double)q.x, (double)q.z);
        oracle_legendre(LMP_BANDS_MAX, cos(stored), p);
        double expected = 0;
        for (int l = 0; l < LMP_BANDS_MAX; l++)
            expected += zonal[l] * sqrt((2 * l + 1) / (4 * ORACLE_PI)) * wide[l] * p[l];
        const lmp_rgb response =
            lmp_lobe_response(LMP_BANDS_MAX, lambda, q, &sphere, 1, (lmp_vec3) { 0, 0, 0 });
        CHECK_WITHIN(fabs((double)response.r - expected) / 0.25, 3e-6);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(matches_the_vector_file),
        cmocka_unit_test(matches_quadrature_at_128_bands),
        cmocka_unit_test(vmf_does_not_depend_on_the_number_of_bands),
        cmocka_unit_test(becomes_a_dirac_as_it_sharpens),
        cmocka_unit_test(projects_as_its_factors_times_the_harmonics),
        cmocka_unit_test(answers_lights_as_the_dot_product_of_coefficients_does),
        cmocka_unit_test(answers_no_lights_with_nothing),
        cmocka_unit_test(diffuse_tends_to_the_irradiance_of_a_sphere),
        cmocka_unit_test(keeps_its_digits_where_a_sharp_lobe_points_at_a_far_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
