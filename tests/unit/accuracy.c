/* SPDX-License-Identifier: MIT */
/* The second table of docs/accuracy.md, printed and held, and bounds of the first: every figure is
 * the largest error of float32 against the double-precision oracle at the same float32 input, over
 * the largest value expected. */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/lobe.h>

#include <math.h>
#include <stdlib.h>

enum { MOST = LMP_BANDS_MAX * LMP_BANDS_MAX };

static const lmp_vec3 origin = { 0, 0, 0 };

static void wide(lmp_vec3 v, double w[3]) {
    w[0] = (double)v.x, w[1] = (double)v.y, w[2] = (double)v.z;
}

/* --- zonal coefficients ----------------------------------------------------------------------- */

typedef struct zonal_errors {
    double printed, differences;
} zonal_errors;

/* The largest over 50 lights of r/d from `ratio` to 2 % below. */
static zonal_errors measure_zonal(int bands, double ratio) {
    zonal_errors worst = { 0, 0 };
    double expected[LMP_BANDS_MAX];
    float zonal[LMP_BANDS_MAX];
    for (int i = 0; i < 50; i++) {
        const float r = (float)(ratio * (1 - 4e-4 * i));
        const double s = (double)r, cosine = sqrt((1 - s) * (1 + s));
        oracle_cap_zonal(bands, s * s / (1 + cosine), expected);
        lmp_zonal_printed(bands, sqrtf(1 - r * r), zonal);
        worst.printed = fmax(worst.printed, check_error((size_t)bands, expected, zonal));
        lmp_sphere_zonal(bands, r, 1, zonal);
        worst.differences = fmax(worst.differences, check_error((size_t)bands, expected, zonal));
    }
    return worst;
}

static void differences_keep_what_the_printed_equation_loses(void **state) {
    (void)state;
    const double ratios[] = { 1, 0.9, 0.5, 0.1, 0.01, 1e-3, 1e-4, 1e-6 };
    const int counts[] = { 3, 10, 128 };
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++) {
            const zonal_errors errors = measure_zonal(counts[k], ratios[i]);
            CHECK_WITHIN(errors.differences, 1e-6);
            if (ratios[i] <= 1e-3)
                assert_true(errors.printed > 1e-2);
        }
}

/* --- coefficients, by number of bands --------------------------------------------------------- */

static double *expected, *slopes;
static float *actual, *gradient, *matrices;

/* Within 0.1 of a pole, where q_l^m is largest. */
static lmp_vec3 random_pole(void) {
    const double r = 0.1 * check_random(), phi = check_random_between(0, 6.28);
    return (lmp_vec3) { (float)(r * cos(phi)), (float)(r * sin(phi)), (float)sqrt(1 - r * r) };
}

static double measure_eval(int bands, lmp_vec3 direction) {
    double w[3];
    wide(direction, w);
    oracle_sh_eval(bands, w, expected);
    lmp_sh_eval(bands, direction, actual);
    return check_error(LMP_SH_COUNT(bands), expected, actual);
}

/* Spheres of r/d from 1e-4 to 0.95 at random. */
static double measure_sphere(int bands, double *gradient_error) {
    const lmp_vec3 center = check_random_direction();
    const float radius = (float)pow(10, check_random_between(-4, -0.0223));
    const double zero[3] = { 0, 0, 0 };
    double w[3];
    wide(center, w);
    oracle_sphere(bands, w, (double)radius, zero, expected, slopes);
    lmp_sphere_project_gradient(bands, center, radius, origin, actual, gradient);
    *gradient_error = check_error(3 * LMP_SH_COUNT(bands), slopes, gradient);
    return check_error(LMP_SH_COUNT(bands), expected, actual);
}

/* M^l Y_l(w) against Y_l(Rw). */
static double measure_rotation(int bands) {
    const lmp_quat q = check_random_rotation();
    const lmp_vec3 direction = check_random_direction();
    const double four[4] = { (double)q.x, (double)q.y, (double)q.z, (double)q.w };
    double w[3], turned[3], rotation[9];
    wide(direction, w);
    oracle_quaternion_matrix(four, rotation);
    for (int k = 0; k < 3; k++)
        turned[k] =
            rotation[3 * k] * w[0] + rotation[3 * k + 1] * w[1] + rotation[3 * k + 2] * w[2];
    oracle_sh_eval(bands, w, expected);
    for (size_t k = 0; k < LMP_SH_COUNT(bands); k++)
        gradient[k] = (float)expected[k];
    oracle_sh_eval(bands, turned, expected);
    lmp_sh_rotation(bands, q, matrices);
    lmp_sh_rotate(bands, matrices, gradient, actual);
    return check_error(LMP_SH_COUNT(bands), expected, actual);
}

/* A Phong lobe of exponent n² answering a sphere, relative to the largest answer. */
static double measure_response(int bands) {
    double lambda_wide[LMP_BANDS_MAX], zonal[LMP_BANDS_MAX], p[LMP_BANDS_MAX];
    float lambda[LMP_BANDS_MAX];
    const lmp_light light = { .position = check_random_direction(),
                              .radius = 0.1f,
                              .radiance = { 1, 1, 1 } };
    const lmp_vec3 q = check_random_direction();
    double w[3], axis[3], largest = 0, sum = 0;
    wide(light.position, w);
    wide(q, axis);
    oracle_lobe_phong(bands, bands * bands, lambda_wide);
    lmp_lobe_phong(bands, (float)(bands * bands), lambda);
    oracle_cap_zonal(bands, 0.01 / (1 + sqrt(0.99)), zonal);
    const double length = sqrt((w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) *
                               (axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]));
    oracle_legendre(bands, (w[0] * axis[0] + w[1] * axis[1] + w[2] * axis[2]) / length, p);
    for (int l = 0; l < bands; l++) {
        const double factor = sqrt((2 * l + 1) / (4 * ORACLE_PI)) * zonal[l] * lambda_wide[l];
        sum += factor * p[l];
        largest += fabs(factor);
    }
    return fabs((double)lmp_lobe_response(bands, lambda, q, &light, 1, origin).r - sum) / largest;
}

static void errors_grow_slowly_with_the_number_of_bands(void **state) {
    (void)state;
    const struct {
        int bands, trials;
        double eval, sphere, gradient, rotation, response; /* bounds */
    } rows[] = {
        { 3, 200, 1e-6, 2e-6, 5e-6, 1e-6, 1e-6 },  { 6, 200, 5e-6, 5e-6, 1e-5, 1e-6, 1e-6 },
        { 10, 200, 1e-5, 2e-5, 3e-5, 1e-6, 1e-6 }, { 20, 50, 5e-5, 5e-5, 1e-4, 1e-6, 2e-6 },
        { 30, 20, 1e-4, 1e-4, 2e-4, 1e-6, 3e-6 },  { 60, 3, 5e-4, 5e-4, 1e-3, 1e-6, 5e-6 },
        { 128, 1, 5e-3, 5e-3, 1e-2, 1e-6, 1e-5 },
    };
    print_message("\n| bands | Y_lm | near a pole | sphere light | its gradient | rotation | lobe "
                  "response |\n"
                  "|---|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double eval = 0, pole = 0, sphere = 0, slope = 0, rotation = 0, response = 0, one;
        for (int trial = 0; trial < rows[i].trials; trial++) {
            eval = fmax(eval, measure_eval(rows[i].bands, check_random_direction()));
            pole = fmax(pole, measure_eval(rows[i].bands, random_pole()));
            sphere = fmax(sphere, measure_sphere(rows[i].bands, &one));
            slope = fmax(slope, one);
            if (trial < 10)
                rotation = fmax(rotation, measure_rotation(rows[i].bands));
            response = fmax(response, measure_response(rows[i].bands));
        }
        print_message("| %d | %.1e | %.1e | %.1e | %.1e | %.1e | %.1e |\n", rows[i].bands, eval,
                      pole, sphere, slope, rotation, response);
        CHECK_WITHIN(eval, rows[i].eval);
        CHECK_WITHIN(pole, rows[i].eval);
        CHECK_WITHIN(sphere, rows[i].sphere);
        CHECK_WITHIN(slope, rows[i].gradient);
        CHECK_WITHIN(rotation, rows[i].rotation);
        CHECK_WITHIN(response, rows[i].response);
    }
}

static int allocate_arrays(void **state) {
    (void)state;
    expected = malloc(MOST * sizeof *expected);
    slopes = malloc(3 * MOST * sizeof *slopes);
    actual = malloc(MOST * sizeof *actual);
    gradient = malloc(3 * MOST * sizeof *gradient);
    matrices = malloc(LMP_SH_ROTATION_COUNT(LMP_BANDS_MAX) * sizeof *matrices);
    return !(expected && slopes && actual && gradient && matrices);
}

static int free_arrays(void **state) {
    (void)state;
    free(expected);
    free(slopes);
    free(actual);
    free(gradient);
    free(matrices);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(differences_keep_what_the_printed_equation_loses),
        cmocka_unit_test(errors_grow_slowly_with_the_number_of_bands),
    };
    return cmocka_run_group_tests(tests, allocate_arrays, free_arrays);
}
