/* SPDX-License-Identifier: MIT */
/* zonal.c - shades the lobes of one surface: the diffuse one by its closed form, Phong lobes by the
 * addition theorem, a sum over bands per light in place of its n² coefficients. */
#include "src/light/seen.h"
#include "src/lobe/response.h"
#include "src/shade/material.h"

lmp_rgb lmpi_shade_lobes_zonal(const shade_lobes *lobes, lmp_vec3 point, const lmp_light *lights,
                               size_t count) {
    const int bands = lobes->bands;
    float weights[SHADE_LOBES_MAX][LMP_BANDS_MAX], r[LMP_BANDS_MAX];
    lmp_rgb accumulated[SHADE_LOBES_MAX] = { { 0, 0, 0 } }, color = { 0, 0, 0 };
    for (int k = 1; k < lobes->count; k++)
        lmpi_lobe_weights(bands, lobes->lobe[k].lambda, weights[k]);
    for (size_t i = 0; i < count; i++) {
        lmpi_seen seen;
        lmpi_light_see(&lights[i], point, &seen);
        if (lobes->count > 1 && !seen.is_loop)
            lmpi_cap_polynomials(bands, seen.cap.one_minus_cos, r);
        lmpi_seen_add_irradiance(&seen, lobes->lobe[0].axis, &accumulated[0]);
        for (int k = 1; k < lobes->count; k++) {
            const shade_lobe *lobe = &lobes->lobe[k];
            lmpi_lobe_add_seen(bands, weights[k], lobe->lambda[0], r, lobe->axis, &seen,
                               &accumulated[k]);
        }
    }
    for (int k = 0; k < lobes->count; k++) {
        color.r += lobes->lobe[k].weight.r * accumulated[k].r;
        color.g += lobes->lobe[k].weight.g * accumulated[k].g;
        color.b += lobes->lobe[k].weight.b * accumulated[k].b;
    }
    return color;
}
