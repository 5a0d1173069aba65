/* SPDX-License-Identifier: MIT */
/* Lobes of one surface: the diffuse one by its closed form, Phong's by the addition theorem, a sum
 * over bands per light in place of its n² coefficients. */
#include "src/light/cap.h"
#include "src/lobe/response.h"
#include "src/shade/material.h"

lmp_rgb lmp_shade_lobes_zonal(const shade_lobes *lobes, lmp_vec3 point, const lmp_light *lights,
                              size_t count) {
    const int bands = lobes->bands;
    float weights[SHADE_LOBES_MAX][LMP_BANDS_MAX], r[LMP_BANDS_MAX];
    lmp_rgb accumulated[SHADE_LOBES_MAX] = { { 0, 0, 0 } }, color = { 0, 0, 0 };
    for (int k = 1; k < lobes->count; k++)
        lmp_lobe_weights(bands, lobes->lobe[k].lambda, weights[k]);
    for (size_t i = 0; i < count; i++) {
        lmp_cap cap;
        lmp_light_cap(&lights[i], point, &cap);
        if (lobes->count > 1)
            lmp_cap_polynomials(bands, cap.one_minus_cos, r);
        lmp_cap_add_irradiance(&cap, lobes->lobe[0].axis, &accumulated[0]);
        for (int k = 1; k < lobes->count; k++) {
            const shade_lobe *lobe = &lobes->lobe[k];
            lmp_lobe_add(&cap, lmp_lobe_sum(bands, weights[k], r, lobe->axis, cap.axis),
                         lobe->lambda[0], &accumulated[k]);
        }
    }
    for (int k = 0; k < lobes->count; k++) {
        color.r += lobes->lobe[k].weight.r * accumulated[k].r;
        color.g += lobes->lobe[k].weight.g * accumulated[k].g;
        color.b += lobes->lobe[k].weight.b * accumulated[k].b;
    }
    return color;
}
