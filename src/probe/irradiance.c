/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"
#include "src/kernels/batch.h"
#include "src/kernels/dispatch.h"
#include "src/sh/column.h"

#include <lampion/probe.h>

void lmp_probe_irradiance_n(int bands, const float *sh, lmp_vec3_array normals, size_t count,
                            lmp_rgb_array rgb) {
    assert(lmpi_is_bands(bands) && lmpi_are_unit(normals, count));
    assert(lmpi_is_rgb_array(rgb));
    const float *const planes[3] = { sh, sh + LMP_SH_COUNT(bands), sh + 2 * LMP_SH_COUNT(bands) };
    const lmpi_kernels *kernels = lmpi_kernels_get();
    lmpi_batch_room room;
    float lambda[LMP_BANDS_MAX];
    lmp_lobe_make_diffuse(bands, lambda);
    for (size_t first = 0; first < count; first += LMPI_BATCH) {
        const size_t n = lmpi_batch_count(count, first);
        const lmpi_kernel_vec3 at = lmpi_batch_vectors(&normals, first, n, lmpi_batch_in(&room));
        const lmpi_kernel_out out = lmpi_batch_out(rgb.at, 3, count, 0, rgb.stride, first);
        kernels->sh.reconstruct(bands, lambda, NULL, planes, &at, n, &out);
    }
}

/* --- one normal ------------------------------------------------------------------------------- */

/* lmp_lobe_make_diffuse of few bands. */
static const float few_lambda[LMPI_FEW_BANDS] = { 3.14159265f, 2.09439510f,   0.785398163f,
                                                  0,           -0.130899694f, 0 };

/* Does what the kernel does in each of its lanes, in the same order for the same bits. It is
 * straight-line code, because `bands` is a constant. */
LMPI_INLINE void straight_irradiance(int bands, const float *sh, lmp_vec3 normal, float rgb[3]) {
    lmpi_azimuth azimuth = { 1, 0 };
    rgb[0] = rgb[1] = rgb[2] = 0;
    LMPI_UNROLL for (int m = 0; m < bands; m++) {
        float before = 0, q = lmpi_table_diagonal[m], cosine[3] = { 0 }, sine[3] = { 0 };
        LMPI_UNROLL for (int l = m; l < bands; l++) {
            if (l > m)
                lmpi_sh_step(l, m, normal.z, &before, &q);
            if (few_lambda[l] == 0)
                continue;
            const float value = q * few_lambda[l];
            LMPI_UNROLL for (int c = 0; c < 3; c++) {
                const float *plane = sh + c * bands * bands;
                cosine[c] += plane[LMP_SH_INDEX(l, m)] * value;
                if (m > 0)
                    sine[c] += plane[LMP_SH_INDEX(l, -m)] * value;
            }
        }
        LMPI_UNROLL for (int c = 0; c < 3; c++) rgb[c] +=
            m > 0 ? cosine[c] * azimuth.c + sine[c] * azimuth.s : cosine[c];
        azimuth = lmpi_azimuth_next(azimuth, normal);
    }
}

lmp_rgb lmp_probe_irradiance(int bands, const float *sh, lmp_vec3 normal) {
    assert(lmpi_is_bands(bands) && lmpi_is_unit(normal));
    float rgb[3];
    switch (bands) {
        LMPI_FEW_CASES(straight_irradiance, sh, normal, rgb)
    default:
        lmp_probe_irradiance_n(bands, sh, lmp_vec3_array_same(&normal), 1,
                               (lmp_rgb_array) { rgb, 0 });
    }
    return (lmp_rgb) { rgb[0], rgb[1], rgb[2] };
}

/* --- constants for shaders -------------------------------------------------------------------- */

void lmp_probe_make_constants(int bands, float scale, const float *sh,
                              lmp_probe_constants *constants) {
    assert(bands >= 3 && bands <= LMP_BANDS_MAX && isfinite(scale));
    float lambda[3];
    lmp_lobe_make_diffuse(3, lambda);
    /* factors of Y_1m and Y_2m as polynomials (Sloan 2008, appendix A2) */
    const float y0 = 0.282094792f, y1 = 0.488602512f, y2 = 1.09254843f;
    const float y20 = 0.315391565f, y22 = 0.546274215f;
    for (int c = 0; c < 3; c++) {
        const float *f = sh + (size_t)c * LMP_SH_COUNT(bands);
        const float a0 = scale * lambda[0], a1 = scale * lambda[1], a2 = scale * lambda[2];
        float *linear = constants->linear[c], *quadratic = constants->quadratic[c];
        linear[0] = -a1 * y1 * f[3];
        linear[1] = -a1 * y1 * f[1];
        linear[2] = a1 * y1 * f[2];
        linear[3] = a0 * y0 * f[0] - a2 * y20 * f[6];
        quadratic[0] = a2 * y2 * f[4];
        quadratic[1] = -a2 * y2 * f[5];
        quadratic[2] = 3 * a2 * y20 * f[6];
        quadratic[3] = -a2 * y2 * f[7];
        constants->last[c] = a2 * y22 * f[8];
    }
    constants->last[3] = 1;
}
