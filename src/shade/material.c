/* SPDX-License-Identifier: MIT */
#include "src/shade/material.h"
#include "src/base/precondition.h"
#include "src/lobe/ggx.h"

#include <math.h>

static const float pi = 3.14159265f;

lmp_shade_settings lmpi_shade_resolve(const lmp_shade_settings *settings) {
    lmp_shade_settings resolved = settings ? *settings : (lmp_shade_settings) { 0 };
    if (resolved.bands == 0)
        resolved.bands = LMP_SHADE_BANDS_DEFAULT;
    assert(lmpi_is_bands(resolved.bands));
    assert((unsigned)resolved.method < LMP_SHADE_METHOD_COUNT);
    return resolved;
}

static lmp_rgb times(lmp_rgb color, float factor) {
    return (lmp_rgb) { color.r * factor, color.g * factor, color.b * factor };
}

lmp_dielectric lmp_material_dielectric(float ior, float specular, lmp_rgb color) {
    const float root = (ior - 1) / (ior + 1), f0 = root * root;
    assert(ior >= 0 && specular >= 0 && specular <= 1);
    return (lmp_dielectric) { true,
                              { fminf(f0 * color.r, 1) * specular,
                                fminf(f0 * color.g, 1) * specular,
                                fminf(f0 * color.b, 1) * specular },
                              specular };
}

static float largest(lmp_rgb color) {
    return fmaxf(color.r, fmaxf(color.g, color.b));
}

shade_reflectance lmpi_shade_reflectance_of(const lmp_material *material) {
    static const lmp_dielectric common = {
        true, { LMP_DIELECTRIC_F0, LMP_DIELECTRIC_F0, LMP_DIELECTRIC_F0 }, 1
    };
    const lmp_dielectric *applied = material->dielectric.given ? &material->dielectric : &common;
    const float metal = lmpi_shade_saturate(material->metallic), dielectric = 1 - metal;
    const lmp_rgb base = material->base_color, f0 = times(applied->f0, dielectric);
    return (shade_reflectance) { times(base, dielectric),
                                 { base.r * metal + f0.r, base.g * metal + f0.g,
                                   base.b * metal + f0.b },
                                 applied->f90 + (1 - applied->f90) * metal,
                                 largest(applied->f0),
                                 applied->f90 };
}

static void reflect_metallic_roughness(const lmp_material *material, lmp_vec3 normal, lmp_vec3 view,
                                       shade_reflection *reflection) {
    const shade_reflectance own = lmpi_shade_reflectance_of(material);
    lmp_ggx_lobes ggx;
    lmp_lobe_find_ggx(normal, view, material->roughness, &ggx);
    reflection->diffuse = times(own.diffuse, lmpi_shade_passed(&own, ggx.diffuse_f90));
    reflection->count = lmpi_shade_phong_count(material, normal, view);
    for (int k = 0; k < reflection->count; k++) {
        const lmp_ggx_lobe *lobe = &ggx.lobe[k];
        const float f90 = own.f90 * lobe->f90;
        reflection->lobe[k] =
            (shade_phong) { lobe->axis,
                            lobe->exponent,
                            { own.f0.r * lobe->f0 + f90, own.f0.g * lobe->f0 + f90,
                              own.f0.b * lobe->f0 + f90 } };
    }
}

void lmpi_shade_reflection(const lmp_material *material, lmp_vec3 normal, lmp_vec3 view,
                           shade_reflection *reflection) {
    if (material->kind == LMP_MATERIAL_METALLIC_ROUGHNESS) {
        reflect_metallic_roughness(material, normal, view, reflection);
        return;
    }
    const lmp_rgb specular = material->specular;
    reflection->diffuse = material->diffuse;
    reflection->count = specular.r != 0 || specular.g != 0 || specular.b != 0;
    reflection->lobe[0] =
        (shade_phong) { lmpi_shade_mirrored(normal, view), material->exponent, material->specular };
}

void lmpi_shade_lobes(const lmp_shade_settings *resolved, const lmp_material *material,
                      const lmp_surface *surface, bool diffuse_by_bands, shade_lobes *lobes) {
    const int bands = resolved->bands;
    shade_reflection reflection;
    float window[LMP_BANDS_MAX];
    lobes->bands = bands;
    lmpi_shade_reflection(material, surface->normal, surface->view, &reflection);
    lobes->count = 1 + reflection.count;
    if (diffuse_by_bands)
        lmp_lobe_make_diffuse(bands, lobes->lobe[0].lambda);
    lobes->lobe[0].axis = surface->normal;
    lobes->lobe[0].weight = (lmp_rgb) { reflection.diffuse.r / pi, reflection.diffuse.g / pi,
                                        reflection.diffuse.b / pi };
    for (int k = 1; k < lobes->count; k++) {
        const shade_phong *phong = &reflection.lobe[k - 1];
        lmp_lobe_make_phong(bands, phong->exponent, lobes->lobe[k].lambda);
        lobes->lobe[k].axis = phong->axis;
        lobes->lobe[k].weight = phong->weight;
    }
    /* Without a window nothing is multiplied. */
    if (resolved->window == LMP_WINDOW_NONE)
        return;
    lmp_sh_make_window(bands, resolved->window, resolved->window_size, window);
    for (int k = diffuse_by_bands ? 0 : 1; k < lobes->count; k++)
        for (int l = 0; l < bands; l++)
            lobes->lobe[k].lambda[l] *= window[l];
}
