/* SPDX-License-Identifier: MIT */
/* The kernels of lights other than spheres, and of sums added to the output, against double
 * precision. */
#include "tests/kernels/run.h"

#include <lampion/light.h>

static void widen(float (*from)[COUNT + 16], int i, double to[3]) {
    for (int k = 0; k < 3; k++)
        to[k] = (double)from[k][i];
}

/* Returns a bound relative to the largest value: the rounding of the basis, and that of cos a near
 * a sphere's surface (surface_bound). */
static double bound_of(int bands, double alpha2) {
    return 1e-6 * (1 + bands) + fmin(1.2e-7 / sqrt(fmax(alpha2, 1e-30)), 3e-4);
}

/* Compares one point under lights of which every other one is a Dirac. */
static double expect_diracs(int bands, inputs *in, int i, double *one, double *sh) {
    const size_t n = LMP_SH_COUNT(bands);
    double alpha2 = 1;
    memset(sh, 0, 3 * n * sizeof *sh);
    for (int light = 0; light < LIGHTS; light++) {
        double center[3], point[3], v[3], d2 = 0;
        const double r2 = (double)in->radius[light] * (double)in->radius[light];
        widen(in->center, light, center);
        widen(in->point, i, point);
        for (int k = 0; k < 3; k++) {
            v[k] = center[k] - point[k];
            d2 += v[k] * v[k];
        }
        if (light % 2) {
            oracle_sh_eval(bands, d2 > 0 ? v : (const double[3]) { 0, 0, 1 }, one);
            for (size_t j = 0; j < n; j++)
                one[j] /= fmax(d2, (double)(LMP_POINT_DISTANCE_MIN * LMP_POINT_DISTANCE_MIN));
        } else {
            oracle_sphere(bands, center, (double)in->radius[light], point, one, NULL);
            alpha2 = fmin(alpha2, fabs(d2 - r2) / fmax(d2, r2));
        }
        for (size_t c = 0; c < 3; c++)
            for (size_t j = 0; j < n; j++)
                sh[c * n + j] += (double)in->rgb[c][light] * one[j];
    }
    return alpha2;
}

static void sums_of_point_lights_match_double_precision(void **test) {
    (void)test;
    lmpi_kernels best;
    lmpi_kernels_init(&best, LMP_CPU_ALL);
    inputs *in = inputs_create(drawn_seed());
    double *one = malloc(128 * 128 * sizeof *one), *sh = malloc(3 * 128 * 128 * sizeof *sh);
    assert_true(one && sh);
    for (int bands = 1; bands <= 128; bands += bands < 20 ? 1 : 54) {
        const size_t values = 3 * LMP_SH_COUNT(bands);
        float *actual = results(&best, ACCUMULATE_DIRACS, bands, in, COUNT, 0);
        for (int i = 0; i<COUNT; i += bands> 20 ? 4 : 1) {
            const double alpha2 = expect_diracs(bands, in, i, one, sh);
            const double error = check_error(values, sh, actual + (size_t)i * values);
            if (!(error <= bound_of(bands, alpha2)))
                printf("%d bands, element %d\n", bands, i);
            CHECK_WITHIN(error, bound_of(bands, alpha2));
        }
        free(actual);
    }
    free(one);
    free(sh);
    free(in);
}

/* The sum added is that of accumulate, to the bit. */
static void what_adds_adds_once(void **test) {
    (void)test;
    lmpi_kernels best;
    lmpi_kernels_init(&best, LMP_CPU_ALL);
    inputs *in = inputs_create(drawn_seed());
    for (int bands = 1; bands <= 128; bands += bands < 20 ? 1 : 54) {
        const size_t values = 3 * LMP_SH_COUNT(bands);
        float *sums = results(&best, ACCUMULATE, bands, in, 19, 0);
        float *more = results(&best, ACCUMULATE_MORE, bands, in, 19, 0);
        float *add = results(&best, ADD, bands, in, 19, 0);
        for (size_t e = 0; e < 19; e++)
            for (size_t v = 0; v < values; v++) {
                const float before = held(e, v), sum = before + sums[e * values + v];
                const float product = in->distance[e] * added(v), more_sum = before + product;
                assert_true(more[e * values + v] == sum);
                assert_true(add[e * values + v] == more_sum);
            }
        free(sums);
        free(more);
        free(add);
    }
    free(in);
}

static void cones_match_double_precision(void **test) {
    (void)test;
    lmpi_kernels best;
    lmpi_kernels_init(&best, LMP_CPU_ALL);
    inputs *in = inputs_create(drawn_seed());
    const lmpi_packed_light cone = cone_of(in);
    const double axis[3] = { (double)cone.axis.x, (double)cone.axis.y, (double)cone.axis.z };
    float *actual = results(&best, CONE, 1, in, COUNT, 0);
    for (int i = 0; i < COUNT; i++) {
        double center[3], point[3], v[3], d = 0, cosine = -axis[2];
        widen(in->point, 0, center);
        widen(in->point, i, point);
        for (int k = 0; k < 3; k++) {
            v[k] = point[k] - center[k];
            d += v[k] * v[k];
        }
        if (d > 0)
            cosine = (axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2]) / sqrt(d);
        const double position = (cosine - (double)cone.outer) / (double)cone.width;
        const double falloff = pow(fmin(fmax(position, 0), 1), 2);
        CHECK_WITHIN(fabs((double)actual[i] - falloff * (double)in->distance[i]),
                     1e-6 * (double)in->distance[i]);
    }
    free(actual);
    free(in);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_of_point_lights_match_double_precision),
        cmocka_unit_test(what_adds_adds_once),
        cmocka_unit_test(cones_match_double_precision),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
