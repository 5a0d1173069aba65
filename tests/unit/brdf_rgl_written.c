/* SPDX-License-Identifier: MIT */
/* The model in a tensor file that the library writes, by which readers other than ours sample: by
 * its definition, the distribution of normals seen in retro-reflection, D ~ f_r(m, m) cos² of their
 * mean color. */
#include "src/base/bytes.h"
#include "src/brdf/brdf.h"
#include "tests/oracle/check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

static lmp_brdf *written_and_read(lmp_brdf *brdf) {
    lmp_brdf *copy;
    void *data;
    size_t size;
    assert_int_equal(lmp_brdf_encode_rgl(NULL, brdf, &data, &size), LMP_OK);
    assert_int_equal(lmp_brdf_read_rgl(NULL, data, size, NULL, &copy), LMP_OK);
    free(data);
    return copy;
}

/* Finds the normal of a node: theta = pi/2 u², with phi over a turn from -pi on. */
static void node_of(const brdf_grid *grid, int i, double m[3]) {
    const double u = (double)(i % grid->width) / (grid->width - 1);
    const double v = (double)(i / grid->width) / (grid->height - 1);
    const double theta = PI / 2 * u * u, phi = PI * (2 * v - 1);
    m[0] = sin(theta) * cos(phi);
    m[1] = sin(theta) * sin(phi);
    m[2] = cos(theta);
}

static double seen_back(const lmp_brdf *brdf, const double m[3]) {
    double rgb[3];
    lmp_brdf_eval_double(brdf, m, m, rgb);
    return (rgb[0] + rgb[1] + rgb[2]) / 3 * m[2] * m[2];
}

/* Checks that normals are as frequent as the light they reflect back: the most frequent count 1,
 * the fewest a thousandth. */
static void check_normals(lmp_brdf *brdf) {
    lmp_brdf *copy = written_and_read(brdf);
    const brdf_grid *ndf = &copy->rgl.ndf;
    double largest = 0, m[3];
    int above = 0;
    for (int i = 0; i < ndf->width * ndf->height; i++) {
        node_of(ndf, i, m);
        largest = fmax(largest, seen_back(brdf, m));
    }
    for (int i = 0; i < ndf->width * ndf->height; i++) {
        node_of(ndf, i, m);
        const double expected = fmax(seen_back(brdf, m) / largest, 1e-3);
        CHECK_WITHIN(fabs((double)ndf->values[i] - expected), 1e-6);
        above += expected > 1e-3;
    }
    assert_true(above > ndf->width / 4);
    lmp_brdf_destroy(copy);
    lmp_brdf_destroy(brdf);
}

static void normals_are_those_seen_in_retro_reflection(void **state) {
    (void)state;
    /* fits whose colors have lobes of their own */
    const char *const names[] = { "gold-metallic-paint", "green-fabric" };
    lmp_brdf *brdf;
    for (int i = 0; i < 2; i++) {
        lmp_sgd sgd;
        assert_int_equal(lmp_brdf_find_sgd(names[i], &sgd), LMP_OK);
        assert_int_equal(lmp_brdf_create_sgd(NULL, &sgd, &brdf), LMP_OK);
        check_normals(brdf);
    }
    const lmp_ggx ggx = { 0.6f, 0.3f, { 0.9f, 0.8f, 0.6f }, { 0.1f, 0.1f, 0.1f } };
    assert_int_equal(lmp_brdf_create_ggx(NULL, &ggx, &brdf), LMP_OK);
    check_normals(brdf);
    assert_int_equal(lmp_brdf_create_lambert(NULL, (lmp_rgb) { 0, 0, 0 }, &brdf), LMP_OK);
    lmp_brdf *black = written_and_read(brdf);
    for (int i = 0; i < black->rgl.ndf.width; i++)
        CHECK_WITHIN(fabs((double)black->rgl.ndf.values[i] - 1), 0);
    lmp_brdf_destroy(black);
    lmp_brdf_destroy(brdf);
}

/* For D = cos² theta: pi/2 from above, pi/8 along the horizon, and in between the integral. */
static void their_projected_area_is_the_integral_over_the_hemisphere(void **state) {
    (void)state;
    enum { STEPS = 200 };
    lmp_brdf *brdf;
    assert_int_equal(lmp_brdf_create_lambert(NULL, (lmp_rgb) { 0.2f, 0.5f, 0.8f }, &brdf), LMP_OK);
    lmp_brdf *copy = written_and_read(brdf);
    const brdf_grid *sigma = &copy->rgl.sigma;
    for (int i = 0; i < sigma->width * sigma->height; i++) {
        double a[3], sum = 0;
        node_of(sigma, i, a);
        for (int t = 0; t < STEPS; t++)
            for (int p = 0; p < STEPS; p++) {
                const double theta = PI / 2 * (t + 0.5) / STEPS, phi = 2 * PI * (p + 0.5) / STEPS;
                const double along = sin(theta) * (cos(phi) * a[0] + sin(phi) * a[1]);
                sum += cos(theta) * cos(theta) * sin(theta) * fmax(along + cos(theta) * a[2], 0);
            }
        CHECK_WITHIN(fabs((double)sigma->values[i] - sum * PI * PI / (STEPS * STEPS)), 2e-3);
    }
    CHECK_WITHIN(fabs((double)sigma->values[0] - PI / 2), 2e-3);
    CHECK_WITHIN(fabs((double)sigma->values[sigma->width - 1] - PI / 8), 2e-3);
    lmp_brdf_destroy(copy);
    lmp_brdf_destroy(brdf);
}

/* Finds a field of a tensor file by the format: 18 bytes, then for each field its name, shape and
 * offset. Sets the number of dimensions and their lengths. */
static const unsigned char *field_of(const unsigned char *bytes, const char *wanted, size_t *count,
                                     size_t shape[5]) {
    const unsigned char *p = bytes + 18;
    for (;;) {
        const size_t length = lmpi_bytes_load_u16(&p);
        const bool found = length == strlen(wanted) && memcmp(p, wanted, length) == 0;
        p += length;
        const int dimensions = lmpi_bytes_load_u16(&p);
        p++;                                           /* the type */
        const size_t offset = lmpi_bytes_load_u32(&p); /* of 8 bytes, the upper ones 0 */
        p += 4;
        *count = 1;
        for (int d = 0; d < dimensions; d++) {
            shape[d] = lmpi_bytes_load_u32(&p);
            p += 4;
            *count *= shape[d];
        }
        if (found)
            return bytes + offset;
    }
}

/* By the format, luminance is the mean of the three channels, for each sample of each slice. */
static void luminance_is_the_mean_of_the_channels(void **state) {
    (void)state;
    const lmp_ggx ggx = { 0.6f, 0.3f, { 0.9f, 0.5f, 0.1f }, { 0, 0.1f, 0.3f } };
    lmp_brdf *brdf;
    void *data;
    size_t size, count, values;
    size_t shape[5];
    assert_int_equal(lmp_brdf_create_ggx(NULL, &ggx, &brdf), LMP_OK);
    assert_int_equal(lmp_brdf_encode_rgl(NULL, brdf, &data, &size), LMP_OK);
    const unsigned char *luminance = field_of(data, "luminance", &count, shape);
    const unsigned char *rgb = field_of(data, "rgb", &values, shape);
    const size_t plane = shape[3] * shape[4], slices = shape[0] * shape[1];
    assert_true(slices > 1 && shape[2] == 3 && values == 3 * slices * plane);
    assert_int_equal(count, slices * plane);
    for (size_t i = 0; i < count; i++) {
        double sum = 0;
        for (size_t c = 0; c < 3; c++)
            sum += (double)lmpi_bytes_at_f32(rgb + 4 * ((3 * (i / plane) + c) * plane + i % plane));
        const double expected = fmax(sum / 3, 0);
        CHECK_WITHIN(fabs((double)lmpi_bytes_at_f32(luminance + 4 * i) - expected),
                     1e-6 * (1e-30 + expected));
    }
    free(data);
    lmp_brdf_destroy(brdf);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normals_are_those_seen_in_retro_reflection),
        cmocka_unit_test(their_projected_area_is_the_integral_over_the_hemisphere),
        cmocka_unit_test(luminance_is_the_mean_of_the_channels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
