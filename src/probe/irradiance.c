/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"
#include "src/sh/column.h"

#include <lampion/probe.h>

void lmp_probe_irradiance_n(int bands, const float *sh, lmp_vec3_array normals, size_t count,
                            lmp_rgb *rgb) {
    assert(lmp_is_bands(bands) && lmp_are_unit(normals, count));
    const size_t plane = LMP_SH_COUNT(bands);
    float lambda[LMP_BANDS_MAX];
    lmp_lobe_diffuse(bands, lambda);
    for (size_t i = 0; i < count; i++) {
        const lmp_vec3 n = lmp_vec3_element(&normals, i);
        rgb[i] = (lmp_rgb) { lmp_sh_filtered(bands, sh, lambda, n),
                             lmp_sh_filtered(bands, sh + plane, lambda, n),
                             lmp_sh_filtered(bands, sh + 2 * plane, lambda, n) };
    }
}

lmp_rgb lmp_probe_irradiance(int bands, const float *sh, lmp_vec3 normal) {
    lmp_rgb rgb;
    lmp_probe_irradiance_n(bands, sh, lmp_vec3_array_same(&normal), 1, &rgb);
    return rgb;
}

void lmp_probe_constants_of(int bands, float scale, const float *sh,
                            lmp_probe_constants *constants) {
    assert(bands >= 3 && bands <= LMP_BANDS_MAX && isfinite(scale));
    float lambda[3];
    lmp_lobe_diffuse(3, lambda);
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
