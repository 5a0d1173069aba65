/* SPDX-License-Identifier: MIT */
/* This library, with one surface and one light per call. */
#include "app/truth/scoreboard_formula.h"

float formula_lampion(const formula_query *q, const formula_reads *reads) {
    const lmp_light light = { .position = q->light, .radius = q->sine, .radiance = { 1, 1, 1 } };
    const lmp_surface surface = { .normal = q->normal, .view = q->view };
    const lmp_rgb color = { q->color, q->color, q->color };
    lmp_material material = { .diffuse = color };
    if (q->material == RULER_PHONG)
        material = (lmp_material) { .specular = color, .exponent = q->exponent };
    if (q->material >= RULER_METAL)
        material = (lmp_material) { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                                    .base_color = color,
                                    .metallic = q->material == RULER_METAL,
                                    .roughness = q->roughness };
    return lmp_shade(&reads->settings, &material, &surface, &light, 1).g;
}
