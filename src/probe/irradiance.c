/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"
#include "src/kernels/batch.h"
#include "src/kernels/dispatch.h"

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

lmp_rgb lmp_probe_irradiance(int bands, const float *sh, lmp_vec3 normal) {
    lmp_rgb rgb;
    lmp_probe_irradiance_n(bands, sh, lmp_vec3_array_same(&normal), 1, lmp_rgb_array_of(&rgb));
    return rgb;
}

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
