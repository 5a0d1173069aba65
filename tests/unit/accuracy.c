/* SPDX-License-Identifier: MIT */
/* The tables of docs/accuracy.md, printed and checked: every figure is the largest error of float32
 * against the double-precision oracle at the same float32 input, relative to the largest value
 * expected. No bound is more than three times the document's. */
#include "app/render/zonal.h"
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/lobe.h>

#include "app/base/error.h"
#include "app/base/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = LMP_BANDS_MAX * LMP_BANDS_MAX };

static const lmp_vec3 origin = { 0, 0, 0 };

static void wide(lmp_vec3 v, double w[3]) {
    w[0] = (double)v.x, w[1] = (double)v.y, w[2] = (double)v.z;
}

/* --- the page --------------------------------------------------------------------------------- */

static char *page;

/* Reads the numbers of the first row of the document's table that begins with `row`; returns how
 * many there are. */
static int read_row(const char *table, const char *row, double numbers[16]) {
    const char *at = strstr(page, table);
    at = at ? strstr(at, row) : NULL;
    if (!at)
        fail_msg("the page has no %s under %s", row, table);
    at += strlen(row);
    const char *const end = at + strcspn(at, "\n");
    int count = 0;
    for (; count < 16 && (at = strpbrk(at, "0123456789")) && at < end; count++) {
        char *rest;
        numbers[count] = strtod(at, &rest);
        at = rest;
    }
    return count;
}

/* Checks that a bound is not below the document's figure, nor above three times that. */
static void check_bound(double bound, double said) {
    CHECK_WITHIN(said, bound);
    CHECK_WITHIN(bound, 3 * said);
}

/* --- zonal coefficients ----------------------------------------------------------------------- */

typedef struct zonal_errors {
    double printed, differences;
} zonal_errors;

/* Returns the largest errors over 50 lights of r/d from `ratio` to 2 % below. */
static zonal_errors measure_zonal(int bands, double ratio) {
    zonal_errors worst = { 0, 0 };
    double expected[LMP_BANDS_MAX];
    float zonal[LMP_BANDS_MAX];
    for (int i = 0; i < 50; i++) {
        const float r = (float)(ratio * (1 - 4e-4 * i));
        const double s = (double)r, cosine = sqrt((1 - s) * (1 + s));
        oracle_cap_zonal(bands, s * s / (1 + cosine), expected);
        zonal_printed(bands, sqrtf(1 - r * r), zonal);
        worst.printed = fmax(worst.printed, check_error((size_t)bands, expected, zonal));
        lmp_sphere_project_zonal(bands, r, 1, zonal);
        worst.differences = fmax(worst.differences, check_error((size_t)bands, expected, zonal));
    }
    return worst;
}

static void differences_keep_what_the_printed_equation_loses(void **state) {
    (void)state;
    static const struct {
        const char *row;
        double ratio;
    } rows[] = { { "\n| 1 |", 1 },         { "\n| 0.9 |", 0.9 },   { "\n| 0.5 |", 0.5 },
                 { "\n| 0.1 |", 0.1 },     { "\n| 0.01 |", 0.01 }, { "\n| 0.001 |", 1e-3 },
                 { "\n| 0.0001 |", 1e-4 }, { "\n| 1e-06 |", 1e-6 } };
    static const int counts[] = { 3, 6, 10, 30, 128 };
    for (int i = 0; i < 8; i++) {
        double said[16]; /* as printed for 3 … 128, Sloan for 3 and 6, library for 3 … 128 */
        assert_int_equal(read_row("| r/d | printed", rows[i].row, said), 12);
        for (int k = 0; k < 5; k++) {
            const zonal_errors errors = measure_zonal(counts[k], rows[i].ratio);
            CHECK_WITHIN(errors.differences, 3 * said[7 + k]);
            CHECK_WITHIN(errors.printed, 3 * said[k]);
            if (rows[i].ratio <= 1e-3)
                assert_true(errors.printed > 1e-2);
        }
    }
}

/* --- coefficients, by number of bands --------------------------------------------------------- */

static double *expected, *slopes;
static float *actual, *gradient, *matrices;

/* Returns a direction at least 0.1 off the poles: near them the error differs, however rarely a
 * direction falls there. */
static lmp_vec3 random_off_poles(void) {
    lmp_vec3 direction;
    do
        direction = check_random_direction();
    while (fabsf(direction.z) > 0.995f);
    return direction;
}

/* Returns a direction within 0.1 of a pole, at every scale down to 1e-5. */
static lmp_vec3 random_pole(void) {
    const double r = pow(10, check_random_between(-5, -1)), phi = check_random_between(0, 6.28);
    const float z = (float)sqrt(1 - r * r);
    return (lmp_vec3) { (float)(r * cos(phi)), (float)(r * sin(phi)),
                        check_random() < 0.5 ? z : -z };
}

static lmp_vec3 random_anywhere(void) {
    return check_random() < 0.5 ? random_off_poles() : random_pole();
}

static double measure_eval(int bands, lmp_vec3 direction) {
    double w[3];
    wide(direction, w);
    oracle_sh_eval(bands, w, expected);
    lmp_sh_eval(bands, direction, actual);
    return check_error(LMP_SH_COUNT(bands), expected, actual);
}

/* Returns a random r/d from 1e-4 to 0.95. */
static float random_radius(void) {
    return (float)pow(10, check_random_between(-4, -0.0223));
}

static double measure_sphere(int bands, double *gradient_error) {
    const lmp_vec3 center = random_anywhere();
    const float radius = random_radius();
    const double zero[3] = { 0, 0, 0 };
    double w[3];
    wide(center, w);
    oracle_sphere(bands, w, (double)radius, zero, expected, slopes);
    lmp_sphere_project_gradient(bands, center, radius, origin, actual, gradient);
    *gradient_error = check_error(3 * LMP_SH_COUNT(bands), slopes, gradient);
    return check_error(LMP_SH_COUNT(bands), expected, actual);
}

/* Compares M^l Y_l(w) with Y_l(Rw). */
static double measure_rotation(int bands) {
    const lmp_quat q = check_random_rotation();
    const lmp_vec3 direction = random_anywhere();
    const double four[4] = { (double)q.x, (double)q.y, (double)q.z, (double)q.w };
    double w[3], rotated[3], rotation[9];
    wide(direction, w);
    oracle_quaternion_matrix(four, rotation);
    for (int k = 0; k < 3; k++)
        rotated[k] =
            rotation[3 * k] * w[0] + rotation[3 * k + 1] * w[1] + rotation[3 * k + 2] * w[2];
    oracle_sh_eval(bands, w, expected);
    for (size_t k = 0; k < LMP_SH_COUNT(bands); k++)
        gradient[k] = (float)expected[k];
    oracle_sh_eval(bands, rotated, expected);
    lmp_sh_make_rotation(bands, q, matrices);
    lmp_sh_rotate(bands, matrices, gradient, actual);
    return check_error(LMP_SH_COUNT(bands), expected, actual);
}

/* Returns a direction: half of them within some widths of a lobe of exponent n², the rest anywhere.
 */
static lmp_vec3 random_near(lmp_vec3 axis, int bands) {
    const double spread = check_random() < 0.5 ? 3.0 / bands : 100;
    const lmp_vec3 off = check_random_direction();
    const double v[3] = { (double)axis.x + spread * (double)off.x,
                          (double)axis.y + spread * (double)off.y,
                          (double)axis.z + spread * (double)off.z };
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    return (lmp_vec3) { (float)(v[0] / length), (float)(v[1] / length), (float)(v[2] / length) };
}

/* Measures a Phong lobe of exponent n² under a sphere of r/d from 1e-4 to 0.95, relative to the
 * largest response to it. */
static double measure_response(int bands) {
    static int last; /* bands of lambda_wide, whose quadrature is slow */
    static double lambda_wide[LMP_BANDS_MAX];
    double zonal[LMP_BANDS_MAX], p[LMP_BANDS_MAX];
    float lambda[LMP_BANDS_MAX];
    const lmp_light light = { .position = check_random_direction(),
                              .radius = random_radius(),
                              .radiance = { 1, 1, 1 } };
    const lmp_vec3 q = random_near(light.position, bands);
    double w[3], axis[3], largest = 0, sum = 0;
    wide(light.position, w);
    const double distance2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    const double sin2 = (double)light.radius * (double)light.radius / distance2;
    wide(q, axis);
    if (bands != last)
        oracle_lobe_phong(bands, bands * bands, lambda_wide);
    last = bands;
    lmp_lobe_make_phong(bands, (float)(bands * bands), lambda);
    oracle_cap_zonal(bands, sin2 / (1 + sqrt(1 - sin2)), zonal);
    const double length =
        sqrt(distance2 * (axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]));
    oracle_legendre(bands, (w[0] * axis[0] + w[1] * axis[1] + w[2] * axis[2]) / length, p);
    for (int l = 0; l < bands; l++) {
        const double factor = sqrt((2 * l + 1) / (4 * ORACLE_PI)) * zonal[l] * lambda_wide[l];
        sum += factor * p[l];
        largest += fabs(factor);
    }
    return fabs((double)lmp_lobe_response(bands, lambda, q, &light, 1, origin).r - sum) / largest;
}

/* The largest errors of a number of trials. */
typedef struct row_errors {
    double eval, pole, sphere, gradient, rotation, response;
} row_errors;

static row_errors measure_row(int bands, int trials) {
    row_errors worst = { 0 };
    for (int trial = 0; trial < trials; trial++) {
        double gradient_error;
        for (int k = 0; k < 10; k++) { /* fast, with rare largest errors */
            worst.eval = fmax(worst.eval, measure_eval(bands, random_off_poles()));
            worst.pole = fmax(worst.pole, measure_eval(bands, random_pole()));
            worst.response = fmax(worst.response, measure_response(bands));
        }
        worst.sphere = fmax(worst.sphere, measure_sphere(bands, &gradient_error));
        worst.gradient = fmax(worst.gradient, gradient_error);
        worst.rotation = fmax(worst.rotation, measure_rotation(bands));
    }
    return worst;
}

/* Checks every row. The bounds are twice the largest errors of ten seeds in the long form. */
static void hold_every_row(int times) {
    static const struct {
        int bands, trials; /* a number of `times` */
        row_errors bounds;
    } rows[] = {
        { 3, 100, { 6e-7, 6e-7, 1.3e-6, 2.5e-6, 4e-7, 1.1e-6 } },
        { 6, 50, { 2.4e-6, 2.4e-6, 3.5e-6, 3.6e-6, 5e-7, 1e-6 } },
        { 10, 40, { 5e-6, 6e-6, 8e-6, 7e-6, 6e-7, 1e-6 } },
        { 20, 20, { 1.2e-5, 2.2e-5, 3e-5, 2e-5, 9e-7, 1.1e-6 } },
        { 30, 10, { 1.5e-5, 5e-5, 5.5e-5, 4e-5, 9e-7, 1.1e-6 } },
        { 60, 4, { 3e-5, 1.5e-4, 1.8e-4, 1.6e-4, 1.3e-6, 1.1e-6 } },
        { 128, 2, { 4.6e-5, 5.6e-4, 8e-4, 6e-4, 1.8e-6, 2e-6 } },
    };
    print_message("| bands | Y_lm | near a pole | sphere light | its gradient | rotation | lobe "
                  "response |\n"
                  "|---|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const row_errors *bounds = &rows[i].bounds;
        char row[16];
        double said[16];
        snprintf(row, sizeof row, "\n| %d |", rows[i].bands);
        assert_int_equal(read_row("| bands | Y_lm", row, said), 6);
        check_bound(bounds->eval, said[0]);
        check_bound(bounds->pole, said[1]);
        check_bound(bounds->sphere, said[2]);
        check_bound(bounds->gradient, said[3]);
        check_bound(bounds->rotation, said[4]);
        check_bound(bounds->response, said[5]);
        const row_errors e = measure_row(rows[i].bands, rows[i].trials * times);
        print_message("| %d | %.1e | %.1e | %.1e | %.1e | %.1e | %.1e |\n", rows[i].bands, e.eval,
                      e.pole, e.sphere, e.gradient, e.rotation, e.response);
        CHECK_WITHIN(e.eval, bounds->eval);
        CHECK_WITHIN(e.pole, bounds->pole);
        CHECK_WITHIN(e.sphere, bounds->sphere);
        CHECK_WITHIN(e.gradient, bounds->gradient);
        CHECK_WITHIN(e.rotation, bounds->rotation);
        CHECK_WITHIN(e.response, bounds->response);
    }
}

static void errors_grow_slowly_with_the_number_of_bands(void **state) {
    (void)state;
    print_message("table accuracy.bands\n");
    hold_every_row(check_count(5, 40));
}

/* The long form adds four seeds. */
static void errors_of_other_seeds_are_as_large(void **state) {
    (void)state;
    for (int seed = 1; seed <= check_count(0, 4); seed++) {
        check_seed((unsigned long long)seed);
        hold_every_row(10);
    }
}

/* --- near the surface of a light -------------------------------------------------------------- */

/* Returns the largest error over spheres at d = (1 + gap) r. */
static double measure_touching(int bands, double gap) {
    const double zero[3] = { 0, 0, 0 };
    double worst = 0, w[3];
    for (int trial = check_count(200, 2000); trial-- > 0;) {
        const lmp_vec3 center = random_off_poles();
        wide(center, w);
        const double length = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
        const float radius = (float)(length / (1 + gap));
        oracle_sphere(bands, w, (double)radius, zero, expected, NULL);
        lmp_sphere_project(bands, center, radius, origin, actual);
        worst = fmax(worst, check_error(LMP_SH_COUNT(bands), expected, actual));
    }
    return worst;
}

static void the_last_digits_go_near_the_surface_of_a_light(void **state) {
    (void)state;
    static const struct {
        double gap, bound;
    } rows[] = { { 1e-1, 9e-7 },   { 1e-2, 1.4e-6 }, { 1e-3, 4e-6 },
                 { 1e-4, 1.1e-5 }, { 1e-5, 3.5e-5 }, { 1e-6, 1.1e-4 } };
    double said[16];
    assert_int_equal(read_row("| d/r - 1 |", "\n| error |", said), 6);
    check_random(); /* prints the seed */
    print_message("table accuracy.surface\n"
                  "| d/r - 1 | 0.1 | 0.01 | 0.001 | 1e-4 | 1e-5 | 1e-6 |\n"
                  "|---|---|---|---|---|---|---|\n"
                  "| error |");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const double error = measure_touching(10, rows[i].gap);
        print_message(" %.1e |", error);
        check_bound(rows[i].bound, said[i]);
        CHECK_WITHIN(error, rows[i].bound);
    }
    print_message("\n");
}

static int allocate_arrays(void **state) {
    (void)state;
    size_t size;
    base_error error;
    if (!file_read("docs/accuracy.md", 1 << 20, (void **)&page, &size, &error))
        return -1;
    expected = malloc(MOST * sizeof *expected);
    slopes = malloc(3 * MOST * sizeof *slopes);
    actual = malloc(MOST * sizeof *actual);
    gradient = malloc(3 * MOST * sizeof *gradient);
    matrices = malloc(LMP_SH_ROTATION_COUNT(LMP_BANDS_MAX) * sizeof *matrices);
    return !(expected && slopes && actual && gradient && matrices);
}

static int free_arrays(void **state) {
    (void)state;
    free(page);
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
        cmocka_unit_test(the_last_digits_go_near_the_surface_of_a_light),
        cmocka_unit_test(errors_of_other_seeds_are_as_large),
    };
    cmocka_set_test_filter(getenv("LAMPION_TEST"));
    return cmocka_run_group_tests(tests, allocate_arrays, free_arrays);
}
