/* SPDX-License-Identifier: MIT */
/* MERL .binary: half-angle coordinates (Rusinkiewicz 1998), theta_h nodes dense near 0. */
#include "src/brdf/brdf.h"

#include <math.h>

#define HEADER 12u

/* Quadrature converges slowly across the edges of cells: rings of 0.35 degrees, where cells have 1,
 * and finer ones for tables of so many bands that they are worth the time. */
#define RINGS          256
#define RINGS_PER_BAND 8

static const int full_shape[3] = { 90, 90, 180 };
static const double scale[3] = { 1.00 / 1500, 1.15 / 1500, 1.66 / 1500 };

static int cell(double fraction, int count) {
    const int i = (int)(fraction * count);
    return i < 0 ? 0 : i < count ? i : count - 1;
}

/* Computes theta_h, theta_d and phi_d as fractions of their ranges pi/2, pi/2, pi; theta_h is
 * stored by its square root. */
static void half_angles(const double a[3], const double b[3], double fractions[3]) {
    double h[3];
    lmpi_brdf_half_vector(a, b, h);
    const double ct = h[2], st = sqrt(h[0] * h[0] + h[1] * h[1]);
    const double cp = st > 1e-12 ? h[0] / st : 1, sp = st > 1e-12 ? h[1] / st : 0;
    const double x = cp * a[0] + sp * a[1], y = cp * a[1] - sp * a[0];
    const double dx = ct * x - st * a[2], dz = st * x + ct * a[2];
    double phi = atan2(y, dx);
    if (phi < 0)
        phi += BRDF_PI;
    fractions[0] = sqrt(atan2(st, ct) / (BRDF_PI / 2));
    fractions[1] = atan2(sqrt(dx * dx + y * y), dz) / (BRDF_PI / 2);
    fractions[2] = phi / BRDF_PI;
}

/* Finds the samples of a pair of directions along phi_d, and the position among them. */
static const float *find_row(const brdf_merl *merl, const double a[3], const double b[3], int *k) {
    const int *shape = merl->shape;
    double fractions[3];
    half_angles(a, b, fractions);
    const size_t i = (size_t)cell(fractions[0], shape[0]), j = (size_t)cell(fractions[1], shape[1]);
    *k = cell(fractions[2], shape[2]);
    return merl->samples + 3 * (i * (size_t)shape[1] + j) * (size_t)shape[2];
}

static void eval_merl(const lmp_brdf *brdf, const double a[3], const double b[3], double rgb[3]) {
    int k;
    const float *row = find_row(&brdf->merl, a, b, &k);
    for (int c = 0; c < 3; c++)
        rgb[c] = (double)row[3 * k + c];
}

/* Evaluates the mean of f_r and its mirror image, whose phi_d is pi - phi_d. */
static void eval_merl_mirrored(const lmp_brdf *brdf, const double a[3], const double b[3],
                               double rgb[3]) {
    int k;
    const float *row = find_row(&brdf->merl, a, b, &k);
    const int image = brdf->merl.shape[2] - 1 - k;
    for (int c = 0; c < 3; c++)
        rgb[c] = ((double)row[3 * k + c] + (double)row[3 * image + c]) / 2;
}

/* Computes the pair of directions at the center of a cell; returns false if one lies below the
 * surface. */
static bool cell_center(const int shape[3], int i, int j, int k, double a[3], double b[3]) {
    const double root = (i + 0.5) / shape[0], theta_h = BRDF_PI / 2 * root * root;
    const double theta_d = BRDF_PI / 2 * (j + 0.5) / shape[1],
                 phi_d = BRDF_PI * (k + 0.5) / shape[2];
    const double d[3] = { sin(theta_d) * cos(phi_d), sin(theta_d) * sin(phi_d), cos(theta_d) };
    const double h[3] = { sin(theta_h), 0, cos(theta_h) };
    a[0] = h[2] * d[0] + h[0] * d[2];
    a[1] = d[1];
    a[2] = h[2] * d[2] - h[0] * d[0];
    const double along = 2 * brdf_dot(a, h);
    for (int c = 0; c < 3; c++)
        b[c] = along * h[c] - a[c];
    return a[2] > 0 && b[2] > 0;
}

static lmp_result check_header(const unsigned char *bytes, size_t size, int shape[3], size_t *cells,
                               lmp_parse_error *error) {
    if (size < HEADER)
        return lmpi_parse_fail(error, LMP_ERROR_FORMAT, size,
                               "a MERL file begins with 12 bytes of dimensions, this has %zu",
                               size);
    uint64_t product = 1;
    for (int axis = 0; axis < 3; axis++) {
        const uint32_t n = lmpi_bytes_at_u32(bytes + 4 * axis);
        if (n < 1 || n > 1u << 20)
            return lmpi_parse_fail(error, LMP_ERROR_FORMAT, 4 * (size_t)axis,
                                   "MERL dimension %d is %d, not a sensible number of cells", axis,
                                   (int)n);
        shape[axis] = (int)n;
        product *= n;
    }
    const uint64_t wanted = HEADER + 24 * product;
    if (product > UINT64_C(1) << 40 || wanted != size)
        return lmpi_parse_fail(error, LMP_ERROR_FORMAT, 0,
                               "MERL dimensions %d x %d x %d need %zu bytes, the file has %zu",
                               shape[0], shape[1], shape[2], (size_t)wanted, size);
    *cells = (size_t)product;
    return LMP_OK;
}

lmp_result lmp_brdf_read_merl(const lmp_host *host, const void *data, size_t size,
                              lmp_parse_error *error, lmp_brdf **brdf) {
    *brdf = NULL;
    const unsigned char *bytes = data;
    int shape[3];
    size_t cells = 0;
    lmp_result result = check_header(bytes, size, shape, &cells, error);
    if (result != LMP_OK)
        return result;
    lmp_brdf *made = NULL;
    result = lmpi_brdf_new(host, LMP_BRDF_MERL, 3 * cells * sizeof(float), &made);
    if (result != LMP_OK)
        return lmpi_parse_fail(error, result, 0, "out of memory for %zu MERL cells", cells);
    float *samples = lmpi_brdf_extra(made);
    for (size_t c = 0; c < 3; c++)
        for (size_t i = 0; i < cells; i++) {
            const size_t offset = HEADER + 8 * (c * cells + i);
            const double value = lmpi_bytes_at_f64(bytes + offset) * scale[c];
            if (!(fabs(value) <= 3e38)) {
                lmp_brdf_destroy(made);
                return lmpi_parse_fail(error, LMP_ERROR_FORMAT, offset,
                                       "MERL cell %zu of channel %zu is not a finite number", i, c);
            }
            samples[3 * i + c] = value > 0 ? (float)value : 0;
        }
    made->merl.samples = samples;
    memcpy(made->merl.shape, shape, sizeof shape);
    memcpy(made->info.shape, shape, sizeof shape);
    made->info.measured = true;
    made->info.rings = RINGS;
    made->rings_per_band = RINGS_PER_BAND;
    made->eval = eval_merl;
    made->eval_mirrored = eval_merl_mirrored;
    *brdf = made;
    return LMP_OK;
}

typedef struct writing {
    const lmp_brdf *brdf;
    unsigned char *bytes;
} writing;

/* Writes all cells of one theta_h. */
static lmp_result write_theta_h(size_t index, void *data) {
    const writing *job = data;
    const size_t cells = (LMP_MERL_SIZE - HEADER) / 24;
    size_t n = index * (size_t)full_shape[1] * (size_t)full_shape[2];
    for (int j = 0; j < full_shape[1]; j++)
        for (int k = 0; k < full_shape[2]; k++, n++) {
            double a[3], b[3], rgb[3] = { -1, -1, -1 };
            if (cell_center(full_shape, (int)index, j, k, a, b))
                lmp_brdf_eval_double(job->brdf, a, b, rgb);
            for (size_t c = 0; c < 3; c++)
                lmpi_bytes_store_f64(job->bytes + HEADER + 8 * (c * cells + n),
                                     rgb[0] < 0 ? -1 : rgb[c] / scale[c]);
        }
    return LMP_OK;
}

lmp_result lmp_brdf_encode_merl(const lmp_host *host, const lmp_brdf *brdf, void **data,
                                size_t *size) {
    *size = LMP_MERL_SIZE;
    const lmp_host resolved = lmpi_host_resolve(host);
    writing job = { brdf, lmpi_allocate(&resolved, LMP_MERL_SIZE) };
    *data = NULL;
    *size = 0;
    if (!job.bytes)
        return LMP_ERROR_MEMORY;
    for (int axis = 0; axis < 3; axis++)
        lmpi_bytes_store_u32(job.bytes + 4 * axis, (uint32_t)full_shape[axis]);
    const lmp_result result =
        lmpi_host_run(&resolved, 0, 1, (size_t)full_shape[0], write_theta_h, &job);
    if (result != LMP_OK) {
        lmpi_release(&resolved, job.bytes);
        return result;
    }
    *data = job.bytes;
    *size = LMP_MERL_SIZE;
    return LMP_OK;
}
