/* SPDX-License-Identifier: MIT */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/probe.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 64 * 64 };

static void randomize(float *sh, int count) {
    for (int k = 0; k < count; k++)
        sh[k] = (float)check_random_between(-1, 1);
}

/* --- irradiance ------------------------------------------------------------------------------- */

/* The irradiance of a sphere above the horizon is pi L sin²a cos(theta), exactly. */
static void irradiance_of_a_sphere_is_its_closed_form(void **state) {
    (void)state;
    enum { BANDS = 64 };
    static float sh[3 * MOST];
    const lmp_light light = { .position = { 0.5f, 2, 0.3f },
                              .radius = 0.4f,
                              .radiance = { 10, 5, 0 } };
    lmp_light_project(BANDS, &light, 1, (lmp_vec3) { 0, 0, 0 }, sh);
    const double d2 = 0.25 + 4 + 0.09, cosine = 2 / sqrt(d2);
    const double expected = ORACLE_PI * 10 * 0.16 / d2 * cosine;
    const lmp_rgb e = lmp_probe_irradiance(BANDS, sh, (lmp_vec3) { 0, 1, 0 });
    CHECK_WITHIN(fabs((double)e.r / expected - 1), 1e-4);
    CHECK_WITHIN(fabs((double)e.g / expected - 0.5), 1e-4);
    assert_true(e.b == 0);
}

static void many_normals_give_the_same_bits_as_one(void **state) {
    (void)state;
    float sh[3 * 36];
    lmp_vec3 normals[17];
    lmp_rgb rgb[17];
    randomize(sh, 3 * 36);
    for (int i = 0; i < 17; i++)
        normals[i] = check_random_direction();
    lmp_probe_irradiance_n(6, sh, lmp_vec3_array_of(normals), 17, lmp_rgb_array_of(rgb));
    for (int i = 0; i < 17; i++) {
        const lmp_rgb one = lmp_probe_irradiance(6, sh, normals[i]);
        assert_memory_equal(&one, &rgb[i], sizeof one);
    }
    lmp_probe_irradiance_n(6, sh, lmp_vec3_array_same(normals), 0, lmp_rgb_array_of(NULL));
}

/* Evaluates the polynomial as published: Ramamoorthi and Hanrahan 2001, Eq. 13 and c1 … c5 below
 * it, for a basis without the Condon-Shortley sign. */
static double published(const float *sh, const double n[3]) {
    double f[9];
    for (int k = 0; k < 9; k++)
        f[k] = (double)sh[k];
    const double c1 = 0.429043, c2 = 0.511664, c3 = 0.743125, c4 = 0.886227, c5 = 0.247708;
    const double x = n[0], y = n[1], z = n[2];
    const double l00 = f[0], l1m = -f[1], l10 = f[2], l11 = -f[3], l2mm = f[4], l2m = -f[5];
    const double l20 = f[6], l21 = -f[7], l22 = f[8];
    return c1 * l22 * (x * x - y * y) + c3 * l20 * z * z + c4 * l00 - c5 * l20 +
           2 * c1 * (l2mm * x * y + l21 * x * z + l2m * y * z) +
           2 * c2 * (l11 * x + l1m * y + l10 * z);
}

static void constants_are_the_published_polynomial(void **state) {
    (void)state;
    float sh[3 * 16];
    randomize(sh, 3 * 16);
    lmp_probe_constants k;
    lmp_probe_make_constants(4, 1, sh, &k);
    assert_true(k.last[3] == 1);
    for (int i = 0; i < 50; i++) {
        const lmp_vec3 d = check_random_direction();
        const double n[3] = { (double)d.x, (double)d.y, (double)d.z };
        const double products[4] = { n[0] * n[1], n[1] * n[2], n[2] * n[2], n[2] * n[0] };
        for (int c = 0; c < 3; c++) {
            double e = (double)k.linear[c][3] + (double)k.last[c] * (n[0] * n[0] - n[1] * n[1]);
            for (int j = 0; j < 3; j++)
                e += (double)k.linear[c][j] * n[j];
            for (int j = 0; j < 4; j++)
                e += (double)k.quadratic[c][j] * products[j];
            CHECK_WITHIN(fabs(e - published(sh + 16 * c, n)), 2e-5);
        }
    }
    lmp_probe_constants scaled;
    lmp_probe_make_constants(4, 0.5f, sh, &scaled);
    assert_true(scaled.linear[1][3] == k.linear[1][3] / 2);
    assert_true(scaled.quadratic[2][1] == k.quadratic[2][1] / 2);
    assert_true(scaled.last[0] == k.last[0] / 2 && scaled.last[3] == 1);
}

/* --- conventions ------------------------------------------------------------------------------ */

/* Evaluates SphericalHarmonics3.getBasisAt of three.js, as its documentation prints it. */
static void three_js_basis(const double w[3], double basis[9]) {
    const double x = w[0], y = w[1], z = w[2];
    const double values[9] = { 0.282095,
                               0.488603 * y,
                               0.488603 * z,
                               0.488603 * x,
                               1.092548 * x * y,
                               1.092548 * y * z,
                               0.315392 * (3 * z * z - 1),
                               1.092548 * x * z,
                               0.546274 * (x * x - y * y) };
    memcpy(basis, values, sizeof values);
}

/* Evaluates AmbiX: ACN and SN3D with x forward, y left, z up; Y_1 is (y, z, x) itself. */
static void ambix_basis(const double w[3], double basis[9]) {
    const double x = w[0], y = w[1], z = w[2], root3 = sqrt(3);
    const double values[9] = { 1,
                               y,
                               z,
                               x,
                               root3 * x * y,
                               root3 * y * z,
                               (3 * z * z - 1) / 2,
                               root3 * x * z,
                               root3 / 2 * (x * x - y * y) };
    memcpy(basis, values, sizeof values);
}

static void three_js_means_the_same_function(void **state) {
    (void)state;
    float sh[9], theirs[9];
    randomize(sh, 9);
    const lmp_probe_convention ours = { 0 }, three = { .sign = LMP_PROBE_SIGN_POSITIVE };
    lmp_probe_convert(3, &ours, &three, sh, theirs);
    for (int i = 0; i < 20; i++) {
        const lmp_vec3 d = check_random_direction();
        const double w[3] = { (double)d.x, (double)d.y, (double)d.z };
        double basis[9], sum = 0;
        three_js_basis(w, basis);
        for (int k = 0; k < 9; k++)
            sum += (double)theirs[k] * basis[k];
        CHECK_WITHIN(fabs(sum - (double)lmp_sh_reconstruct(3, sh, d)), 1e-5);
    }
}

/* A source is encoded as the basis in its direction: forward is -z, left is -x, up is y. */
static void ambix_encodes_sources_in_its_own_axes(void **state) {
    (void)state;
    const lmp_probe_convention ours = { 0 };
    const lmp_probe_convention ambix = { .sign = LMP_PROBE_SIGN_POSITIVE,
                                         .normalization = LMP_PROBE_SN3D,
                                         .axes = { -3, -1, 2 } };
    for (int i = 0; i < 20; i++) {
        const lmp_vec3 d = i ? check_random_direction() : (lmp_vec3) { -1, 0, 0 };
        const double seen[3] = { -(double)d.z, -(double)d.x, (double)d.y };
        float source[9], encoded[9];
        double expected[9];
        lmp_sh_eval(3, d, source);
        lmp_probe_convert(3, &ours, &ambix, source, encoded);
        ambix_basis(seen, expected);
        CHECK_WITHIN(check_error(9, expected, encoded), 1e-6);
        if (i == 0) /* from the left: W = Y = 1, Z = X = 0 */
            CHECK_WITHIN(fabsf(encoded[1] - 1) + fabsf(encoded[2]) + fabsf(encoded[3]), 1e-6);
    }
}

/* All 48 frames, left-handed ones included, are compared with the function itself at 10 bands. */
static void axes_may_be_any_of_48(void **state) {
    (void)state;
    enum { BANDS = 10, COUNT = BANDS * BANDS };
    float sh[COUNT], theirs[COUNT], back[COUNT];
    randomize(sh, COUNT);
    const signed char orders[6][3] = { { 1, 2, 3 }, { 1, 3, 2 }, { 2, 1, 3 },
                                       { 2, 3, 1 }, { 3, 1, 2 }, { 3, 2, 1 } };
    const lmp_probe_convention ours = { 0 };
    for (int i = 0; i < 48; i++) {
        lmp_probe_convention world = { 0 };
        for (int k = 0; k < 3; k++)
            world.axes[k] = (signed char)(i >> k & 1 ? -orders[i / 8][k] : orders[i / 8][k]);
        lmp_probe_convert(BANDS, &ours, &world, sh, theirs);
        lmp_probe_convert(BANDS, &world, &ours, theirs, back);
        for (int k = 0; k < COUNT; k++)
            CHECK_WITHIN(fabsf(back[k] - sh[k]), 1e-5);
        for (int j = 0; j < 5; j++) {
            const lmp_vec3 d = check_random_direction();
            const float w[3] = { d.x, d.y, d.z };
            float seen[3];
            for (int k = 0; k < 3; k++)
                seen[k] = world.axes[k] > 0 ? w[world.axes[k] - 1] : -w[-world.axes[k] - 1];
            const float value =
                lmp_sh_reconstruct(BANDS, theirs, (lmp_vec3) { seen[0], seen[1], seen[2] });
            CHECK_WITHIN(fabsf(value - lmp_sh_reconstruct(BANDS, sh, d)), 5e-5);
        }
    }
}

static void conventions_are_recognized(void **state) {
    (void)state;
    float ours[25], theirs[25];
    randomize(ours, 25);
    for (int sign = 0; sign < 2; sign++)
        for (int norm = 0; norm < 3; norm++) {
            const lmp_probe_convention made = { .sign = (lmp_probe_sign)sign,
                                                .normalization = (lmp_probe_normalization)norm };
            lmp_probe_convention found = { 0 };
            lmp_probe_convert(5, &(lmp_probe_convention) { 0 }, &made, ours, theirs);
            assert_true(lmp_probe_recognize(5, 1e-5f, ours, theirs, &found));
            assert_int_equal(found.sign, sign);
            assert_int_equal(found.normalization, norm);
            for (int k = 0; k < 25; k++) {
                const float kept = theirs[k];
                theirs[k] += 0.5f;
                assert_false(lmp_probe_recognize(5, 1e-5f, ours, theirs, &found));
                theirs[k] = kept;
            }
            theirs[7] = NAN;
            assert_false(lmp_probe_recognize(5, 1e-5f, ours, theirs, &found));
        }
}

/* Whatever is found must convert: other signs are also a rotation by pi around z. */
static void axes_are_recognized(void **state) {
    (void)state;
    static const signed char axes[][3] = {
        { 1, 3, -2 }, { -3, 1, 2 }, { 1, 2, -3 }, { -1, -2, -3 }
    };
    float ours[25], theirs[25], again[25];
    double expected[25];
    randomize(ours, 25);
    for (int i = 0; i < 24; i++) {
        lmp_probe_convention made = { (lmp_probe_sign)(i % 2),
                                      (lmp_probe_normalization)(i / 2 % 3),
                                      { 0, 0, 0 } };
        lmp_probe_convention found = { 0 };
        memcpy(made.axes, axes[i / 6], sizeof made.axes);
        lmp_probe_convert(5, &(lmp_probe_convention) { 0 }, &made, ours, theirs);
        assert_true(lmp_probe_recognize(5, 1e-5f, ours, theirs, &found));
        assert_int_equal(found.normalization, made.normalization);
        lmp_probe_convert(5, &(lmp_probe_convention) { 0 }, &found, ours, again);
        for (int k = 0; k < 25; k++)
            expected[k] = (double)theirs[k];
        CHECK_WITHIN(check_error(25, expected, again), 1e-5);
    }
}

/* --- from samples ----------------------------------------------------------------------------- */

typedef struct sampled {
    lmp_vec3 directions[400];
    float values[400], weights[400];
    lmp_probe_samples samples;
} sampled;

/* Makes `count` samples of a series of `bands` bands, all in the upper half if asked. */
static void sample(sampled *s, int bands, const float *sh, int count, bool upper) {
    for (int i = 0; i < count; i++) {
        lmp_vec3 d = check_random_direction();
        if (upper)
            d.y = fabsf(d.y);
        s->directions[i] = d;
        s->values[i] = lmp_sh_reconstruct(bands, sh, d);
        s->weights[i] = 1;
    }
    s->samples = (lmp_probe_samples) { .directions = lmp_vec3_array_of(s->directions),
                                       .values = { s->values, sizeof(float) },
                                       .count = (size_t)count };
}

static void samples_of_a_series_give_it_back(void **state) {
    (void)state;
    static sampled s;
    float sh[36], fitted[36];
    double expected[36];
    randomize(sh, 36);
    for (int k = 0; k < 36; k++)
        expected[k] = (double)sh[k];
    sample(&s, 6, sh, 120, false);
    assert_int_equal(lmp_probe_fit(NULL, 6, 0, &s.samples, fitted), LMP_OK);
    CHECK_WITHIN(check_error(36, expected, fitted), 1e-4);
    sample(&s, 3, sh, 200, true); /* half a sphere is enough for a few bands */
    assert_int_equal(lmp_probe_fit(NULL, 3, 0, &s.samples, fitted), LMP_OK);
    CHECK_WITHIN(check_error(9, expected, fitted), 1e-4);
    sample(&s, 1, sh, 1, false);
    assert_int_equal(lmp_probe_fit(NULL, 1, 0, &s.samples, fitted), LMP_OK);
    CHECK_WITHIN(check_error(1, expected, fitted), 1e-6);
}

static void a_weight_of_two_is_a_sample_twice(void **state) {
    (void)state;
    static sampled s;
    float sh[16], twice[4], weighted[4];
    randomize(sh, 16);
    sample(&s, 4, sh, 20, false); /* more bands than are fitted: residuals remain */
    s.directions[20] = s.directions[3];
    s.values[20] = s.values[3];
    s.samples.count = 21;
    assert_int_equal(lmp_probe_fit(NULL, 2, 0, &s.samples, twice), LMP_OK);
    s.weights[3] = 2;
    s.samples.weights = (lmp_float_array) { s.weights, sizeof(float) };
    s.samples.count = 20;
    assert_int_equal(lmp_probe_fit(NULL, 2, 0, &s.samples, weighted), LMP_OK);
    for (int k = 0; k < 4; k++)
        CHECK_WITHIN(fabsf(twice[k] - weighted[k]), 1e-6);
}

static void much_smoothness_leaves_the_mean(void **state) {
    (void)state;
    static sampled s;
    float sh[16], fitted[16];
    double mean = 0;
    randomize(sh, 16);
    sample(&s, 4, sh, 8, false); /* fewer samples than coefficients */
    for (int i = 0; i < 8; i++)
        mean += (double)s.values[i] / 8;
    assert_int_equal(lmp_probe_fit(NULL, 4, 0, &s.samples, fitted), LMP_ERROR_ARGUMENT);
    assert_int_equal(lmp_probe_fit(NULL, 4, 1e6f, &s.samples, fitted), LMP_OK);
    CHECK_WITHIN(fabs((double)fitted[0] - mean * sqrt(4 * ORACLE_PI)), 1e-4);
    for (int k = 1; k < 16; k++)
        CHECK_WITHIN(fabsf(fitted[k]), 1e-5);
}

static void bad_samples_are_refused(void **state) {
    (void)state;
    static sampled s;
    float sh[9] = { 1 }, fitted[9];
    sample(&s, 3, sh, 40, false);
    assert_int_equal(lmp_probe_fit(NULL, 0, 0, &s.samples, fitted), LMP_ERROR_ARGUMENT);
    assert_int_equal(lmp_probe_fit(NULL, 33, 0, &s.samples, fitted), LMP_ERROR_ARGUMENT);
    assert_int_equal(lmp_probe_fit(NULL, 3, -1, &s.samples, fitted), LMP_ERROR_ARGUMENT);
    assert_int_equal(lmp_probe_fit(NULL, 3, NAN, &s.samples, fitted), LMP_ERROR_ARGUMENT);
    s.values[7] = NAN;
    assert_int_equal(lmp_probe_fit(NULL, 3, 0, &s.samples, fitted), LMP_ERROR_ARGUMENT);
    s.values[7] = 0;
    s.weights[39] = -1;
    s.samples.weights = (lmp_float_array) { s.weights, sizeof(float) };
    assert_int_equal(lmp_probe_fit(NULL, 3, 0, &s.samples, fitted), LMP_ERROR_ARGUMENT);
    s.samples.weights.at = NULL;
    s.samples.directions = lmp_vec3_array_same(s.directions); /* all in one direction */
    assert_int_equal(lmp_probe_fit(NULL, 3, 0, &s.samples, fitted), LMP_ERROR_ARGUMENT);
    s.samples.count = 0;
    assert_int_equal(lmp_probe_fit(NULL, 1, 0, &s.samples, fitted), LMP_ERROR_ARGUMENT);
}

/* --- series that stay positive ---------------------------------------------------------------- */

static double least_on_grid(int bands, const float *sh) {
    double least = (double)INFINITY;
    for (int i = 0; i < 200; i++)
        for (int j = 0; j < 400; j++) {
            const double polar = ORACLE_PI * (i + 0.5) / 200, phi = ORACLE_PI * j / 200;
            const lmp_vec3 w = { (float)(sin(polar) * cos(phi)), (float)(sin(polar) * sin(phi)),
                                 (float)cos(polar) };
            least = fmin(least, (double)lmp_sh_reconstruct(bands, sh, w));
        }
    return least;
}

static void the_least_value_of_three_bands_is_exact(void **state) {
    (void)state;
    float sh[9];
    for (int i = 0; i < 40; i++) {
        randomize(sh, 9);
        if (i >= 30) /* no linear part, no quadratic part, parts along one axis */
            for (int k = 1; k < 9; k++)
                if ((i % 3 == 0 && k < 4) || (i % 3 == 1 && k >= 4) || (i % 3 == 2 && k % 2))
                    sh[k] = 0;
        const double least = (double)lmp_probe_minimum(3, sh), seen = least_on_grid(3, sh);
        CHECK_WITHIN(least, seen + 1e-5);
        CHECK_WITHIN(seen - least, 2e-3);
    }
    sh[0] = 2;
    CHECK_WITHIN(fabs((double)lmp_probe_minimum(1, sh) - 2 / sqrt(4 * ORACLE_PI)), 1e-6);
}

static void the_weakest_window_that_keeps_a_light_positive_is_found(void **state) {
    (void)state;
    static float sh[3 * 64], windowed[64], weights[8];
    const int counts[] = { 2, 3, 5, 8 };
    for (int i = 0; i < 4; i++) {
        const int bands = counts[i];
        const size_t plane = LMP_SH_COUNT(bands);
        for (int p = 0; p < 3; p++)
            lmp_sphere_project(bands, (lmp_vec3) { 3, 2 + (float)p, 1 }, 0.2f,
                               (lmp_vec3) { 0, 0, 0 }, sh + (size_t)p * plane);
        lmp_probe_make_positive_window(bands, sh, 3, weights);
        assert_true(weights[0] == 1 && weights[bands - 1] < 1);
        for (int l = 2; l < bands; l++) { /* all are 1 / (1 + mu l² (l+1)²), by the first mu */
            const double square = pow((double)l * (l + 1), 2);
            const double mu = (1 / (double)weights[1] - 1) / 4;
            CHECK_WITHIN(fabs((double)weights[l] * (1 + mu * square) - 1), 1e-3);
        }
        bool below = false;
        for (int p = 0; p < 3; p++) {
            const float *f = sh + (size_t)p * plane;
            const double mean = (double)f[0] / sqrt(4 * ORACLE_PI);
            lmp_sh_apply_window(bands, weights, f, windowed);
            CHECK_WITHIN(-least_on_grid(bands, windowed), 0.01 * mean);
            for (int l = 0; l < bands; l++) /* a window a little weaker */
                weights[l] = 1 / (1 + 0.95f * (1 / weights[l] - 1));
            lmp_sh_apply_window(bands, weights, f, windowed);
            below |= least_on_grid(bands, windowed) < 0;
            lmp_probe_make_positive_window(bands, sh, 3, weights);
        }
        assert_true(below);
    }
}

static void positive_and_dark_functions_are_left_alone(void **state) {
    (void)state;
    float sh[2][16] = { { 3, 0.1f, 0.1f, 0.1f, 0.1f }, { -1, 0.3f } }, weights[4];
    lmp_probe_make_positive_window(4, sh[0], 2, weights);
    for (int l = 0; l < 4; l++)
        assert_true(weights[l] == 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(irradiance_of_a_sphere_is_its_closed_form),
        cmocka_unit_test(many_normals_give_the_same_bits_as_one),
        cmocka_unit_test(constants_are_the_published_polynomial),
        cmocka_unit_test(three_js_means_the_same_function),
        cmocka_unit_test(ambix_encodes_sources_in_its_own_axes),
        cmocka_unit_test(axes_may_be_any_of_48),
        cmocka_unit_test(conventions_are_recognized),
        cmocka_unit_test(axes_are_recognized),
        cmocka_unit_test(samples_of_a_series_give_it_back),
        cmocka_unit_test(a_weight_of_two_is_a_sample_twice),
        cmocka_unit_test(much_smoothness_leaves_the_mean),
        cmocka_unit_test(bad_samples_are_refused),
        cmocka_unit_test(the_least_value_of_three_bands_is_exact),
        cmocka_unit_test(the_weakest_window_that_keeps_a_light_positive_is_found),
        cmocka_unit_test(positive_and_dark_functions_are_left_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
