/* SPDX-License-Identifier: MIT */
#include "src/light/cap.h"
#include "src/lobe/response.h"
#include "src/sh/column.h"

#include <lampion/shade.h>

#include <assert.h>
#include <math.h>

static const float pi = 3.14159265f;

/* --- the material ----------------------------------------------------------------------------- */

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

/* --- both lobes of one surface ---------------------------------------------------------------- */

typedef struct lobe_pair {
    int bands;
    float diffuse[LMP_BANDS_MAX], specular[LMP_BANDS_MAX]; /* windowed lambda_l */
    lmp_vec3 normal, mirror;
} lobe_pair;

static lmp_vec3 mirrored(lmp_vec3 n, lmp_vec3 v) {
    const float twice = 2 * (n.x * v.x + n.y * v.y + n.z * v.z);
    return (lmp_vec3) { twice * n.x - v.x, twice * n.y - v.y, twice * n.z - v.z };
}

static void prepare_lobes(const lmp_shade_settings *settings, const lmp_material *material,
                          const lmp_surface *surface, lobe_pair *lobes) {
    const lmp_shade_settings chosen = settings ? *settings : (lmp_shade_settings) { 0 };
    float window[LMP_BANDS_MAX];
    lobes->bands = chosen.bands ? chosen.bands : LMP_SHADE_BANDS_DEFAULT;
    assert(lobes->bands >= 1 && lobes->bands <= LMP_BANDS_MAX);
    lmp_sh_window(chosen.window, lobes->bands, chosen.window_size, window);
    lmp_lobe_diffuse(lobes->bands, lobes->diffuse);
    lmp_lobe_phong(lobes->bands, material->exponent, lobes->specular);
    for (int l = 0; l < lobes->bands; l++) {
        lobes->diffuse[l] *= window[l];
        lobes->specular[l] *= window[l];
    }
    lobes->normal = surface->normal;
    lobes->mirror = mirrored(surface->normal, surface->view);
}

/* Reflected radiance from what each lobe gathers. */
static lmp_rgb reflect(const lmp_material *material, lmp_rgb diffuse, lmp_rgb specular) {
    return (lmp_rgb) {
        fmaxf(material->diffuse.r / pi * diffuse.r + material->specular.r * specular.r, 0),
        fmaxf(material->diffuse.g / pi * diffuse.g + material->specular.g * specular.g, 0),
        fmaxf(material->diffuse.b / pi * diffuse.b + material->specular.b * specular.b, 0),
    };
}

/* --- the methods ------------------------------------------------------------------------------ */

lmp_rgb lmp_shade_zonal(const lmp_shade_settings *settings, const lmp_material *material,
                        const lmp_surface *surface, const lmp_light *lights, size_t count) {
    if (material->table)
        return lmp_shade_table(material->table, surface, (lmp_vec3) { 0, 0, 0 }, lights, count);
    lobe_pair lobes;
    prepare_lobes(settings, material, surface, &lobes);
    const int bands = lobes.bands;
    float diffuse[LMP_BANDS_MAX], specular[LMP_BANDS_MAX], r[LMP_BANDS_MAX];
    lmp_lobe_weights(bands, lobes.diffuse, diffuse);
    lmp_lobe_weights(bands, lobes.specular, specular);
    lmp_rgb diffuse_sum = { 0, 0, 0 }, specular_sum = { 0, 0, 0 };
    for (size_t i = 0; i < count; i++) {
        lmp_cap cap;
        lmp_light_cap(&lights[i], surface->position, &cap);
        lmp_cap_polynomials(bands, cap.one_minus_cos, r);
        lmp_lobe_add(&cap, lmp_lobe_sum(bands, diffuse, r, lobes.normal, cap.axis),
                     lobes.diffuse[0], &diffuse_sum);
        lmp_lobe_add(&cap, lmp_lobe_sum(bands, specular, r, lobes.mirror, cap.axis),
                     lobes.specular[0], &specular_sum);
    }
    return reflect(material, diffuse_sum, specular_sum);
}

lmp_rgb lmp_shade_coefficients(const lmp_shade_settings *settings, const lmp_material *material,
                               const lmp_surface *surface, const lmp_light *lights, size_t count) {
    if (material->table)
        return lmp_shade_table(material->table, surface, (lmp_vec3) { 0, 0, 0 }, lights, count);
    lobe_pair lobes;
    prepare_lobes(settings, material, surface, &lobes);
    const int bands = lobes.bands;
    float sh[3 * LMP_BANDS_MAX * LMP_BANDS_MAX];
    lmp_light_project(lights, count, surface->position, bands, sh);
    const float *red = sh, *green = red + LMP_SH_COUNT(bands), *blue = green + LMP_SH_COUNT(bands);
    const lmp_rgb diffuse = {
        lmp_sh_filtered(bands, red, lobes.diffuse, lobes.normal),
        lmp_sh_filtered(bands, green, lobes.diffuse, lobes.normal),
        lmp_sh_filtered(bands, blue, lobes.diffuse, lobes.normal),
    };
    const lmp_rgb specular = {
        lmp_sh_filtered(bands, red, lobes.specular, lobes.mirror),
        lmp_sh_filtered(bands, green, lobes.specular, lobes.mirror),
        lmp_sh_filtered(bands, blue, lobes.specular, lobes.mirror),
    };
    return reflect(material, diffuse, specular);
}

lmp_rgb lmp_shade(const lmp_shade_settings *settings, const lmp_material *material,
                  const lmp_surface *surface, const lmp_light *lights, size_t count) {
    return lmp_shade_zonal(settings, material, surface, lights, count);
}
