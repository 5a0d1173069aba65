/* SPDX-License-Identifier: MIT */
/* The parametric BRDFs and the fits of measured ones against their own laws. */
#include "tests/oracle/oracle.h"
#include "tests/unit/brdfs.h"

#include <math.h>

static double albedo(const lmp_brdf *brdf, double theta, int channel) {
    enum { RINGS = 200, AZIMUTHS = 400 };
    static double node[RINGS], weight[RINGS];
    oracle_gauss_legendre(RINGS, node, weight);
    const double wo[3] = { sin(theta), 0, cos(theta) };
    double sum = 0;
    for (int k = 0; k < RINGS; k++)
        for (int j = 0; j < AZIMUTHS; j++) {
            const double z = (1 + node[k]) / 2, s = sqrt(1 - z * z);
            const double phi = 2 * ORACLE_PI * (j + 0.5) / AZIMUTHS;
            const double wi[3] = { s * cos(phi), s * sin(phi), z };
            double rgb[3];
            lmp_brdf_eval_double(brdf, wi, wo, rgb);
            sum += weight[k] / 2 * z * rgb[channel] * 2 * ORACLE_PI / AZIMUTHS;
        }
    return sum;
}

static void lambert_reflects_its_albedo(void **state) {
    (void)state;
    lmp_brdf *brdf = lambert(0.8f, 0.5f, 0.2f);
    CHECK_WITHIN(fabs(albedo(brdf, 0.7, 0) - (double)0.8f), 1e-12);
    lmp_brdf_destroy(brdf);
}

static void phong_is_normalised_head_on(void **state) {
    (void)state;
    lmp_brdf *brdf = phong(20);
    CHECK_WITHIN(fabs(albedo(brdf, 0, 1) - 0.5), 1e-9);
    lmp_brdf_destroy(brdf);
}

/* Heitz 2014: masking and distribution belong together, so a white GGX loses only what would need
 * a second bounce. */
static void rough_ggx_keeps_nearly_all_energy_when_smooth(void **state) {
    (void)state;
    const lmp_ggx desc = { 0.1f, 0, { 1, 1, 1 }, { 0, 0, 0 } };
    lmp_brdf *brdf = NULL;
    assert_int_equal(lmp_brdf_create_ggx(NULL, &desc, &brdf), LMP_OK);
    const double fraction = albedo(brdf, 0.5, 0);
    assert_true(fraction > 0.98 && fraction < 1.0);
    lmp_brdf_destroy(brdf);
}

/* Evaluates the formulas as appendix B writes them, material by material; F is 1 at grazing
 * whatever F0 is. */
static double appendix_b(double alpha, double f0, double base, const double l[3],
                         const double v[3]) {
    const double h[3] = { l[0] + v[0], l[1] + v[1], l[2] + v[2] };
    const double length = sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]), a2 = alpha * alpha;
    const double nh = h[2] / length, nl = l[2], nv = v[2];
    const double vh = (v[0] * h[0] + v[1] * h[1] + v[2] * h[2]) / length;
    const double distribution = a2 / (ORACLE_PI * pow(nh * nh * (a2 - 1) + 1, 2));
    const double visibility =
        0.5 / (nl * sqrt(nv * nv * (1 - a2) + a2) + nv * sqrt(nl * nl * (1 - a2) + a2));
    const double fresnel = f0 + (1 - f0) * pow(1 - fabs(vh), 5);
    return (1 - fresnel) * base / ORACLE_PI + fresnel * visibility * distribution;
}

static void unit_upper(double x, double y, double z, double unit[3]) {
    const double length = sqrt(x * x + y * y + z * z);
    unit[0] = x / length;
    unit[1] = y / length;
    unit[2] = fabs(z) / length;
}

static void ggx_is_that_of_gltf(void **state) {
    (void)state;
    static const float alphas[] = { 0.001f, 0.01f, 0.1f, 0.5f, 1 };
    for (int i = 0; i < 5; i++) {
        const lmp_ggx desc = { alphas[i], 0, { 0.04f, 0.5f, 1 }, { 0.8f, 0, 0.3f } };
        lmp_brdf *brdf = NULL;
        assert_int_equal(lmp_brdf_create_ggx(NULL, &desc, &brdf), LMP_OK);
        for (int n = 0; n < 2000; n++) {
            const lmp_vec3 at = random_upper(), off = random_upper();
            /* directions around the mirror direction, and anywhere */
            const double part = n % 2 ? 1 : 2 * (double)alphas[i] * check_random();
            double l[3], v[3], rgb[3];
            unit_upper((double)at.x, (double)at.y, (double)at.z, v);
            unit_upper(part * (double)off.x - v[0], part * (double)off.y - v[1], v[2], l);
            lmp_brdf_eval_double(brdf, l, v, rgb);
            for (int c = 0; c < 3; c++) {
                const double expected = appendix_b((double)alphas[i], (double)(&desc.f0.r)[c],
                                                   (double)(&desc.diffuse.r)[c], l, v);
                CHECK_WITHIN(fabs(rgb[c] / expected - 1), 1e-8);
            }
        }
        lmp_brdf_destroy(brdf);
    }
}

static void parametric_brdfs_are_reciprocal(void **state) {
    (void)state;
    lmp_brdf *const brdfs[] = { lambert(0.8f, 0.5f, 0.2f), phong(20), ggx(0.3f, 0), ggx(0.4f, 0.1f),
                                sgd_brdf("gold-metallic-paint") };
    for (size_t i = 0; i < 5; i++) {
        for (int n = 0; n < 500; n++) {
            const lmp_vec3 a = random_upper(), b = random_upper();
            const lmp_rgb ab = lmp_brdf_eval(brdfs[i], a, b), ba = lmp_brdf_eval(brdfs[i], b, a);
            CHECK_WITHIN(fabsf(ab.r - ba.r), 1e-6f * fmaxf(ab.r, 1e-3f));
        }
        lmp_brdf_destroy(brdfs[i]);
    }
}

static void nothing_is_reflected_below_the_surface(void **state) {
    (void)state;
    lmp_brdf *brdf = lambert(0.8f, 0.5f, 0.2f);
    const lmp_vec3 up = { 0, 0, 1 }, down = { 0, 0.6f, -0.8f }, along = { 1, 0, 0 };
    assert_true(lmp_brdf_eval(brdf, up, down).r == 0);
    assert_true(lmp_brdf_eval(brdf, along, up).r == 0);
    lmp_brdf_destroy(brdf);
}

/* Invalid directions reflect nothing, in double as in float, and NaN stays NaN. */
static void only_finite_directions_above_the_surface_reflect(void **state) {
    (void)state;
    const double up[3] = { 0, 0.6, 0.8 }, bad[][3] = {
        { 0, 0.6, -0.8 }, { 1, 0, 0 }, { 0, 0, (double)INFINITY }, { (double)-INFINITY, 0, 1 }
    };
    const double none[3] = { 0, (double)NAN, 1 };
    lmp_brdf *brdfs[] = { lambert(0.8f, 0.5f, 0.2f), phong(12), ggx(0.3f, 0.5f),
                          sgd_brdf("gold-paint") };
    for (size_t i = 0; i < sizeof brdfs / sizeof *brdfs; i++) {
        double rgb[3];
        lmp_brdf_eval_double(brdfs[i], up, up, rgb);
        assert_true(rgb[0] > 0 && rgb[1] > 0 && rgb[2] > 0);
        for (size_t k = 0; k < 2 * (sizeof bad / sizeof *bad); k++) {
            lmp_brdf_eval_double(brdfs[i], k % 2 ? up : bad[k / 2], k % 2 ? bad[k / 2] : up, rgb);
            assert_true(rgb[0] == 0 && rgb[1] == 0 && rgb[2] == 0);
        }
        for (int k = 0; k < 2; k++) {
            lmp_brdf_eval_double(brdfs[i], k ? up : none, k ? none : up, rgb);
            assert_true(isnan(rgb[0]) && isnan(rgb[1]) && isnan(rgb[2]));
        }
        lmp_brdf_destroy(brdfs[i]);
    }
}

static void parameters_out_of_range_are_refused(void **state) {
    (void)state;
    lmp_brdf *brdf = NULL;
    assert_int_equal(lmp_brdf_create_lambert(NULL, (lmp_rgb) { -1, 0, 0 }, &brdf),
                     LMP_ERROR_ARGUMENT);
    assert_null(brdf);
    assert_int_equal(lmp_brdf_create_phong(NULL, (lmp_rgb) { 1, 1, 1 }, NAN, &brdf),
                     LMP_ERROR_ARGUMENT);
    assert_int_equal(lmp_brdf_create_ggx(NULL, &(lmp_ggx) { .alpha_x = 0 }, &brdf),
                     LMP_ERROR_ARGUMENT);
    lmp_sgd parameters;
    assert_int_equal(lmp_brdf_find_sgd("no-such-material", &parameters), LMP_ERROR_ARGUMENT);
    assert_int_equal(lmp_brdf_find_sgd("", &parameters), LMP_ERROR_ARGUMENT);
    assert_int_equal(lmp_brdf_find_sgd("fabric-beige", &parameters), LMP_OK);
    parameters.alpha[1] = 0;
    assert_int_equal(lmp_brdf_create_sgd(NULL, &parameters, &brdf), LMP_ERROR_ARGUMENT);
    assert_null(brdf);
}

/* The materials are wide enough for this quadrature; the numbers come from another implementation.
 */
static void sgd_materials_have_their_published_albedo(void **state) {
    (void)state;
    static const struct {
        const char *name;
        double degrees, rgb[3];
    } rows[] = {
        { "alum-bronze", 10, { 0.099, 0.080, 0.060 } },
        { "alum-bronze", 75, { 0.211, 0.295, 0.181 } },
        { "gold-metallic-paint", 10, { 0.226, 0.157, 0.050 } },
        { "gold-metallic-paint", 75, { 0.118, 0.081, 0.038 } },
        { "red-fabric", 45, { 0.225, 0.032, 0.014 } },
        { "alum-bronze", 45, { 0.163, 0.124, 0.104 } },
        { "white-paint", 75, { 1.419, 0.443, 0.356 } },
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lmp_brdf *brdf = sgd_brdf(rows[i].name);
        for (int c = 0; c < 3; c++)
            CHECK_WITHIN(fabs(albedo(brdf, rows[i].degrees * ORACLE_PI / 180, c) - rows[i].rgb[c]),
                         1e-3 + 0.01 * rows[i].rgb[c]);
        lmp_brdf_destroy(brdf);
    }
}

static void a_fit_of_wild_numbers_is_finite(void **state) {
    (void)state;
    lmp_sgd parameters;
    lmp_brdf *brdf;
    assert_int_equal(lmp_brdf_find_sgd("gold-metallic-paint", &parameters), LMP_OK);
    parameters.p[0] = 1e38;
    parameters.rho_s[1] = 1e38;
    assert_int_equal(lmp_brdf_create_sgd(NULL, &parameters, &brdf), LMP_OK);
    for (int i = 0; i < 1000; i++) {
        const lmp_rgb value =
            lmp_brdf_eval(brdf, i ? check_random_direction() : (lmp_vec3) { 0, 0, 1 },
                          i ? check_random_direction() : (lmp_vec3) { 0, 0, 1 });
        assert_true(isfinite(value.r) && isfinite(value.g) && isfinite(value.b));
    }
    lmp_brdf_destroy(brdf);
}

static void every_sgd_material_is_finite_everywhere(void **state) {
    (void)state;
    size_t count = 0;
    for (; lmp_brdf_sgd_name(count); count++) {
        lmp_brdf *brdf = sgd_brdf(lmp_brdf_sgd_name(count));
        for (int n = 0; n < 300; n++) {
            lmp_vec3 a = random_upper(), b = random_upper();
            if (n % 3 == 0)
                a.z = 1e-6f;
            const lmp_rgb f = lmp_brdf_eval(brdf, a, b);
            assert_true(isfinite(f.r) && f.r >= 0 && isfinite(f.g) && f.g >= 0 && isfinite(f.b) &&
                        f.b >= 0);
        }
        lmp_brdf_destroy(brdf);
    }
    assert_int_equal(count, 100);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lambert_reflects_its_albedo),
        cmocka_unit_test(phong_is_normalised_head_on),
        cmocka_unit_test(rough_ggx_keeps_nearly_all_energy_when_smooth),
        cmocka_unit_test(ggx_is_that_of_gltf),
        cmocka_unit_test(parametric_brdfs_are_reciprocal),
        cmocka_unit_test(nothing_is_reflected_below_the_surface),
        cmocka_unit_test(only_finite_directions_above_the_surface_reflect),
        cmocka_unit_test(parameters_out_of_range_are_refused),
        cmocka_unit_test(sgd_materials_have_their_published_albedo),
        cmocka_unit_test(every_sgd_material_is_finite_everywhere),
        cmocka_unit_test(a_fit_of_wild_numbers_is_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
