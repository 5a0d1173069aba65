/* SPDX-License-Identifier: MIT */
#include "src/shade/material.h"
#include "src/base/precondition.h"

#include <math.h>

static const float pi = 3.14159265f;

static float saturate(float x) {
    return fminf(fmaxf(x, 0), 1);
}

lmp_material lmp_material_from_metallic_roughness(lmp_rgb base, float metallic, float roughness) {
    const float m = saturate(metallic), rough = saturate(roughness);
    const float alpha = fmaxf(rough * rough, LMP_ALPHA_MIN), dielectric = 0.04f * (1 - m);
    return (lmp_material) {
        .diffuse = { base.r * (1 - m), base.g * (1 - m), base.b * (1 - m) },
        .specular = { dielectric + base.r * m, dielectric + base.g * m, dielectric + base.b * m },
        .exponent = 2 / (alpha * alpha) - 2,
    };
}

lmp_shade_settings lmp_shade_resolve(const lmp_shade_settings *settings) {
    lmp_shade_settings resolved = settings ? *settings : (lmp_shade_settings) { 0 };
    if (resolved.bands == 0)
        resolved.bands = LMP_SHADE_BANDS_DEFAULT;
    assert(lmp_is_bands(resolved.bands));
    assert(resolved.method >= LMP_SHADE_ZONAL && resolved.method <= LMP_SHADE_PREINTEGRATED);
    return resolved;
}

lmp_material lmp_shade_phong(const lmp_material *material) {
    if (material->kind == LMP_MATERIAL_METALLIC_ROUGHNESS)
        return lmp_material_from_metallic_roughness(material->base_color, material->metallic,
                                                    material->roughness);
    return *material;
}

static lmp_vec3 mirrored(lmp_vec3 n, lmp_vec3 v) {
    const float twice = 2 * (n.x * v.x + n.y * v.y + n.z * v.z);
    return (lmp_vec3) { twice * n.x - v.x, twice * n.y - v.y, twice * n.z - v.z };
}

void lmp_shade_lobes(const lmp_shade_settings *resolved, const lmp_material *material,
                     const lmp_surface *surface, shade_lobes *lobes) {
    const lmp_material phong = lmp_shade_phong(material);
    const int bands = resolved->bands;
    shade_lobe *diffuse = &lobes->lobe[0], *specular = &lobes->lobe[1];
    float window[LMP_BANDS_MAX];
    lobes->bands = bands;
    lobes->count = 2;
    lmp_sh_window(bands, resolved->window, resolved->window_size, window);
    lmp_lobe_diffuse(bands, diffuse->lambda);
    lmp_lobe_phong(bands, phong.exponent, specular->lambda);
    for (int l = 0; l < bands; l++) {
        diffuse->lambda[l] *= window[l];
        specular->lambda[l] *= window[l];
    }
    diffuse->axis = surface->normal;
    diffuse->weight =
        (lmp_rgb) { phong.diffuse.r / pi, phong.diffuse.g / pi, phong.diffuse.b / pi };
    specular->axis = mirrored(surface->normal, surface->view);
    specular->weight = phong.specular;
}
