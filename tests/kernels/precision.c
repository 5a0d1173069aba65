/* SPDX-License-Identifier: MIT */
/* Every kernel against the oracle in double precision. */
#include "tests/kernels/run.h"
#include "tests/kernels/shaded.h"

/* Returns a bound relative to an element's largest value: two to eight times what nine seeds
 * showed. alpha2 = cos² a. */
static double bound_of(kind which, int bands, double alpha2) {
    switch (which) {
    case EVAL:
    case EVAL_GRADIENT:
    case IMAGE:
        return 1e-6 * bands;
    case PROJECT:
        return 3e-6 + 1e-6 * bands + surface_bound(alpha2);
    case GRADIENT: /* it grows as 1 / cos a, so by the relative error of cos a */
        return 1e-6 + 6e-7 * bands + surface_bound(alpha2) / sqrt(fmax(alpha2, 1e-30));
    case ZONAL:
        return 2e-6 + surface_bound(alpha2);
    default:
        return 1e-6 + surface_bound(alpha2);
    }
}

static void check_element(int i, int bands, kind which, size_t values, const double *expected,
                          const float *actual, double alpha2) {
    const double error = check_error(values, expected, actual);
    const double bound = bound_of(which, bands, alpha2);
    if (!(error <= bound))
        printf("%s, %d bands, element %d\n", kind_names[which], bands, i);
    CHECK_WITHIN(error, bound);
}

static void basis_zonal_and_project_match_double_precision(void **test) {
    (void)test;
    lmpi_kernels best;
    lmpi_kernels_init(&best, LMP_CPU_ALL);
    inputs *in = inputs_create(drawn_seed());
    double *expected = malloc(128 * 128 * sizeof *expected);
    assert_non_null(expected);
    for (int bands = 1; bands <= 128; bands += bands < 20 ? 1 : 108) {
        float *basis = results(&best, EVAL, bands, in, COUNT, 0);
        float *zonal = results(&best, ZONAL, bands, in, COUNT, 0);
        float *project = results(&best, PROJECT, bands, in, COUNT, 0);
        const size_t n = LMP_SH_COUNT(bands);
        for (int i = 0; i<COUNT; i += bands> 20 ? 4 : 1) {
            double center[3], point[3], axis[3], v2 = 0;
            widen(VECTOR(in->center), i, center);
            widen(VECTOR(in->point), i, point);
            widen(VECTOR(in->axis), i, axis);
            for (int k = 0; k < 3; k++)
                v2 += (center[k] - point[k]) * (center[k] - point[k]);
            const double radius = (double)in->radius[i];
            const double alpha2 =
                fabs(v2 - radius * radius) / fmax(fmax(v2, radius * radius), 1e-30);
            oracle_sh_eval(bands, axis, expected);
            check_element(i, bands, EVAL, n, expected, basis + (size_t)i * n, alpha2);
            if (radius == 0 && v2 == 0) {
                for (size_t j = 0; j < n; j++)
                    assert_true(project[(size_t)i * n + j] == 0);
                continue;
            }
            oracle_sphere(bands, center, radius, point, expected, NULL);
            check_element(i, bands, PROJECT, n, expected, project + (size_t)i * n, alpha2);
            /* Zonal coefficients are those of a sphere along z. */
            oracle_sphere(bands, (double[]) { 0, 0, (double)in->distance[i] }, radius,
                          (double[]) { 0, 0, 0 }, expected, NULL);
            for (int l = 1; l < bands; l++)
                expected[l] = expected[l * l + l];
            check_element(i, bands, ZONAL, (size_t)bands, expected, zonal + i * bands, alpha2);
        }
        free(basis);
        free(zonal);
        free(project);
    }
    free(expected);
    free(in);
}

/* The expected sums at points whose lights the oracle sees. */
typedef struct sums_expected {
    double *sh, *axis_sh; /* red, green, blue; then by x, by y, by z */
    double response[3];
    double alpha2; /* the smallest cos² a */
    bool slopes;   /* derivatives are compared: finite, none clamped (LMP_COS_MIN) */
} sums_expected;

/* Returns cos² a of a light seen from a point; 1 where nothing is seen. */
static double seen_alpha2(inputs *in, int light, int i, double center[3], double point[3]) {
    const double r = (double)in->radius[light];
    double v2 = 0;
    widen(VECTOR(in->center), light, center);
    widen(VECTOR(in->point), i, point);
    for (int k = 0; k < 3; k++)
        v2 += (center[k] - point[k]) * (center[k] - point[k]);
    return r == 0 && v2 == 0 ? 1 : fabs(v2 - r * r) / fmax(v2, r * r);
}

/* The oracle's derivatives cost 2 bands times as much as its values: past 74 bands they are
 * computed for few points. */
static void expect_sums(int bands, inputs *in, int i, const double *lambda, double *one,
                        sums_expected *e) {
    const size_t n = LMP_SH_COUNT(bands);
    double center[3], point[3], axis[3];
    widen(VECTOR(in->axis), i, axis);
    oracle_sh_eval(bands, axis, e->axis_sh);
    memset(e->sh, 0, 12 * n * sizeof *e->sh);
    memset(e->response, 0, sizeof e->response);
    e->alpha2 = 1;
    for (int light = 0; light < LIGHTS; light++)
        e->alpha2 = fmin(e->alpha2, seen_alpha2(in, light, i, center, point));
    e->slopes = e->alpha2 >= (double)(LMP_COS_MIN * LMP_COS_MIN) && (bands <= 74 || i % 8 == 0) &&
                i != 4; /* except at the center of a light */
    for (int light = 0; light < LIGHTS; light++) {
        const double r = (double)in->radius[light];
        seen_alpha2(in, light, i, center, point);
        if (r == 0 && memcmp(center, point, sizeof point) == 0)
            continue; /* nothing is seen */
        oracle_sphere(bands, center, r, point, one, e->slopes ? one + n : NULL);
        const double lit = lobe_of(bands, lambda, one, e->axis_sh);
        for (int c = 0; c < 3; c++) {
            const double rgb = (double)in->rgb[c][light];
            e->response[c] += rgb * lit;
            for (size_t set = 0; set < (e->slopes ? 4 : 1); set++)
                for (size_t j = 0; j < n; j++)
                    e->sh[(3 * set + (size_t)c) * n + j] += rgb * one[set * n + j];
        }
    }
}

/* Point i < LIGHTS sees light i as special[i] says: touching, from inside, at the center. */
static void sums_gradients_and_lobes_match_double_precision(void **test) {
    (void)test;
    lmpi_kernels best;
    lmpi_kernels_init(&best, LMP_CPU_ALL);
    inputs *in = inputs_create(drawn_seed());
    sums_expected e = { malloc(12 * 128 * 128 * sizeof *e.sh),
                        malloc(128 * 128 * sizeof *e.axis_sh),
                        { 0 },
                        0,
                        false };
    double *one = malloc(4 * 128 * 128 * sizeof *one);
    assert_true(e.sh && e.axis_sh && one);
    for (int bands = 1; bands <= 128; bands += bands < 20 ? 1 : 54) {
        const size_t n = LMP_SH_COUNT(bands);
        float *total = results(&best, ACCUMULATE, bands, in, COUNT, 1);
        float *slopes = results(&best, GRADIENT, bands, in, COUNT, 1);
        float *lobes = results(&best, LOBE, bands, in, COUNT, 1), lambda[LMP_BANDS_MAX];
        double wide[LMP_BANDS_MAX];
        make_lambda(bands, lambda);
        for (int l = 0; l < bands; l++)
            wide[l] = (double)lambda[l];
        for (int i = 0; i<COUNT; i += bands> 20 || i >= LIGHTS ? 4 : 1) {
            expect_sums(bands, in, i, wide, one, &e);
            check_element(i, bands, ACCUMULATE, 3 * n, e.sh, total + (size_t)i * 3 * n, e.alpha2);
            for (int c = 0; c < 3; c++)
                CHECK_WITHIN(fabs((double)lobes[3 * i + c] - e.response[c]),
                             4e-6 + LIGHTS * surface_bound(e.alpha2));
            if (e.slopes)
                check_element(i, bands, GRADIENT, 12 * n, e.sh, slopes + (size_t)i * 12 * n,
                              e.alpha2);
        }
        free(total);
        free(slopes);
        free(lobes);
    }
    free(e.sh);
    free(e.axis_sh);
    free(one);
    free(in);
}

static void rotation_and_dot_match_double_precision(void **test) {
    (void)test;
    lmpi_kernels best;
    lmpi_kernels_init(&best, LMP_CPU_ALL);
    inputs *in = inputs_create(drawn_seed());
    for (int bands = 1; bands <= 128; bands += bands < 20 ? 1 : bands == 20 ? 13 : 95) {
        const size_t n = LMP_SH_COUNT(bands);
        float *rotated = results(&best, ROTATE, bands, in, 18, 0);
        float *dots = results(&best, DOT, bands, in, 18, 0), *matrices = make_matrices(bands);
        for (size_t e = 0; e < 18; e++) {
            const float *matrix = matrices;
            double dot = 0, size = 0;
            for (size_t v = 0; v < n; v++) {
                dot += (double)coefficient(e, v) * (double)coefficient(e + 1000, v);
                size += fabs((double)coefficient(e, v) * (double)coefficient(e + 1000, v));
            }
            CHECK_WITHIN(fabs(dot - (double)dots[e]), 1e-6 * size);
            for (int l = 0; l < bands; matrix += (2 * l + 1) * (2 * l + 1), l++)
                for (int i = 0; i<2 * l + 1; i += bands> 33 ? 9 : 1) {
                    double value = 0;
                    for (int j = 0; j < 2 * l + 1; j++)
                        value += (double)matrix[i * (2 * l + 1) + j] *
                                 (double)coefficient(e, (size_t)(l * l + j));
                    CHECK_WITHIN(fabs(value - (double)rotated[e * n + (size_t)(l * l + i)]),
                                 2e-7 * (2 * l + 1));
                }
        }
        free(rotated);
        free(dots);
        free(matrices);
    }
    free(in);
}

static void gradients_of_the_basis_match_double_precision(void **test) {
    (void)test;
    lmpi_kernels best;
    lmpi_kernels_init(&best, LMP_CPU_ALL);
    inputs *in = inputs_create(drawn_seed());
    double *expected = malloc(4 * 128 * 128 * sizeof *expected);
    assert_non_null(expected);
    for (int bands = 1; bands <= 128; bands += bands < 20 ? 1 : 54) {
        const size_t n = LMP_SH_COUNT(bands);
        float *slopes = results(&best, EVAL_GRADIENT, bands, in, COUNT, 0);
        for (int i = 0; i<COUNT; i += bands> 20 ? 4 : 1) {
            double axis[3];
            widen(VECTOR(in->axis), i, axis);
            lmp_sh_eval_gradient_double(bands, axis, expected, expected + n);
            check_element(i, bands, EVAL_GRADIENT, 4 * n, expected, slopes + (size_t)i * 4 * n, 1);
        }
        free(slopes);
    }
    free(expected);
    free(in);
}

/* Computes Σ_l factor_l lambda_l Σ_m f_lm Y_lm of three functions, and the sum of the magnitudes.
 */
static void expect_function(kind which, int bands, const inputs *in, int i, const double *basis,
                            double sums[3], double sizes[3]) {
    float factors[LMP_BANDS_MAX];
    double lambda[LMP_BANDS_MAX];
    make_lambda(bands, factors);
    if (which == RECONSTRUCT_PHONG)
        oracle_lobe_phong(bands, (double)in->exponent[i], lambda);
    else
        for (int l = 0; l < bands; l++)
            lambda[l] = l > 1 && l % 2 ? 0 : 1;
    for (size_t c = 0; c < 3; c++) {
        sums[c] = sizes[c] = 0;
        for (int l = 0; l < bands; l++)
            for (size_t v = (size_t)(l * l); v < LMP_SH_COUNT(l + 1); v++) {
                const double f = (double)factors[l] * lambda[l] * basis[v];
                sums[c] += f * (double)coefficient(c, v);
                sizes[c] += fabs(f * (double)coefficient(c, v));
            }
    }
}

static void functions_of_coefficients_match_double_precision(void **test) {
    (void)test;
    lmpi_kernels best;
    lmpi_kernels_init(&best, LMP_CPU_ALL);
    inputs *in = inputs_create(drawn_seed());
    double *basis = malloc(128 * 128 * sizeof *basis), worst = 0;
    assert_non_null(basis);
    for (int bands = 1; bands <= 128; bands += bands < 20 ? 1 : 54)
        for (kind which = RECONSTRUCT; which <= RECONSTRUCT_PHONG; which++) {
            float *actual = results(&best, which, bands, in, COUNT, 0);
            for (int i = 0; i<COUNT; i += bands> 20 ? 4 : 1) {
                double axis[3], sums[3], sizes[3];
                widen(VECTOR(in->axis), i, axis);
                oracle_sh_eval(bands, axis, basis);
                expect_function(which, bands, in, i, basis, sums, sizes);
                for (int c = 0; c < 3; c++) {
                    const double error = fabs((double)actual[3 * i + c] - sums[c]);
                    worst = fmax(worst, error / sizes[c]);
                    CHECK_WITHIN(error, 3e-6 * sizes[c]);
                }
            }
            free(actual);
        }
    printf("functions: error max %.2g of the sum of magnitudes\n", worst);
    free(basis);
    free(in);
}

static void images_match_double_precision(void **test) {
    (void)test;
    lmpi_kernels best;
    lmpi_kernels_init(&best, LMP_CPU_ALL);
    inputs *in = inputs_create(drawn_seed());
    double *basis = malloc(128 * 128 * sizeof *basis), *sums = malloc(3 * 128 * 128 * sizeof *sums);
    assert_true(basis && sums);
    for (int bands = 1; bands <= 128; bands += bands < 20 ? 1 : 54) {
        const size_t n = LMP_SH_COUNT(bands);
        float *actual = results(&best, IMAGE, bands, in, COUNT, 0);
        memset(sums, 0, 3 * n * sizeof *sums);
        for (int i = 0; i < COUNT; i++) { /* image i has all texels of the images before it */
            double axis[3];
            widen(VECTOR(in->axis), i, axis);
            oracle_sh_eval(bands, axis, basis);
            for (size_t v = 0; v < 3 * n; v++)
                sums[v] += (double)in->rgb[v / n][i] * basis[v % n];
            check_element(i, bands, IMAGE, 3 * n, sums, actual + (size_t)i * 3 * n, 1);
        }
        free(actual);
    }
    free(basis);
    free(sums);
    free(in);
}

static void shading_matches_double_precision(void **test) {
    (void)test;
    static void (*const expect[])(const shading *, int, shaded *) = { expect_zonal,
                                                                      expect_preintegrated_lobe,
                                                                      expect_preintegrated_brdf,
                                                                      expect_zonal,
                                                                      expect_preintegrated_lobe,
                                                                      expect_zonal,
                                                                      expect_preintegrated_lobe };
    lmpi_kernels best;
    lmpi_kernels_init(&best, LMP_CPU_ALL);
    inputs *in = inputs_create(drawn_seed());
    for (int which = SHADE_ZONAL; which <= SHADE_PREINTEGRATED_LOBE_ALL; which++) {
        check_errors errors = { 0 };
        double largest = 0, ratio = 0;
        for (int bands = 1; bands <= 128; bands += bands < 20 ? 1 : 54) {
            const size_t values = values_of((kind)which, bands);
            float *actual = results(&best, (kind)which, bands, in, COUNT, 0);
            shading *s = shading_create(in, bands, lobes_of((kind)which));
            for (int i = 0; i<COUNT; i += bands> 20 ? 11 : 1) {
                shaded e;
                expect[which - SHADE_ZONAL](s, i, &e);
                for (size_t v = 0; v < values; v++) {
                    const double error =
                        fabs((double)actual[(size_t)i * values + v] - (double)v - e.values[v]);
                    if (!(error <= e.bound))
                        printf("%s, %d bands, element %d\n", kind_names[which], bands, i);
                    CHECK_WITHIN(error, e.bound);
                    check_errors_add(&errors, error);
                    largest = fmax(largest, fabs(e.values[v]));
                    ratio = fmax(ratio, error / e.bound);
                }
            }
            shading_free(s);
            free(actual);
        }
        printf("%s: error max %.2g, rms %.2g, of values to %.3g, of the bound %.2g\n",
               kind_names[which], errors.largest, check_errors_rms(&errors), largest, ratio);
    }
    free(in);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(basis_zonal_and_project_match_double_precision),
        cmocka_unit_test(sums_gradients_and_lobes_match_double_precision),
        cmocka_unit_test(rotation_and_dot_match_double_precision),
        cmocka_unit_test(gradients_of_the_basis_match_double_precision),
        cmocka_unit_test(functions_of_coefficients_match_double_precision),
        cmocka_unit_test(images_match_double_precision),
        cmocka_unit_test(shading_matches_double_precision),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
