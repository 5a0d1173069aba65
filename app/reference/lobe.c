/* SPDX-License-Identifier: MIT */
#include "app/reference/lobe.h"

/* Blinn's fit of a Beckmann lobe of width alpha: the exponent 2/alpha² - 2. */
#define NARROWEST_ALPHA 0.01

reference_material reference_material_from_metallic_roughness(const double base[3], double metallic,
                                                              double roughness) {
    const double metal = fmin(fmax(metallic, 0), 1), rough = fmin(fmax(roughness, 0), 1);
    const double alpha = fmax(rough * rough, NARROWEST_ALPHA);
    reference_material material = { .exponent = 2 / (alpha * alpha) - 2 };
    for (int c = 0; c < 3; c++) {
        material.diffuse[c] = base[c] * (1 - metal);
        material.specular[c] = 0.04 + (base[c] - 0.04) * metal;
    }
    return material;
}

/* The windowing filter is the library's, which tests/unit/window.c judges.
 * (2l+1)/(4 pi) w_l lambda_l with lambda_l = (e+1) ∫ t^e P_l(t) dt over 0 … 1. Integrating
 * Legendre's equation against t^e gives lambda_l (e+l+1) = lambda_(l-2) (e-l+2). */
static void limit_lobe(reference_lobe *lobe, const reference_band_limit *limit) {
    const double e = lobe->exponent;
    double before = 0, lambda = 1;
    float weights[LMP_BANDS_MAX];
    lmp_sh_window(limit->bands, limit->window, (float)limit->window_size, weights);
    lobe->bands = limit->bands;
    for (int l = 0; l < limit->bands; l++) {
        const double next = l == 0 ? (e + 1) / (e + 2) : before * (e - l + 1) / (e + l + 2);
        lobe->series[l] = (2 * l + 1) / (4 * REFERENCE_PI) * (double)weights[l] * lambda;
        before = lambda;
        lambda = next;
    }
}

void reference_surface_set(reference_surface *surface, const reference_band_limit *limit,
                           const reference_material *material, reference_vec position,
                           reference_vec normal, reference_vec view) {
    reference_lobe *diffuse = &surface->lobes[0], *specular = &surface->lobes[1];
    surface->position = surface->ray_origin = position;
    diffuse->axis = normal;
    diffuse->exponent = 1;
    specular->axis = reference_mirror(view, normal);
    specular->exponent = material->exponent;
    for (int c = 0; c < 3; c++) {
        diffuse->weight[c] = material->diffuse[c];
        specular->weight[c] = material->specular[c];
    }
    diffuse->bands = specular->bands = 0;
    surface->band_limited = limit->bands > 0;
    surface->tabulated = NULL;
    if (limit->bands) {
        limit_lobe(diffuse, limit);
        limit_lobe(specular, limit);
    }
}

/* Neither too wide nor too narrow for most materials; the samples are weighted for it. */
#define GUIDE_EXPONENT 40

void reference_surface_measure(reference_surface *surface, const reference_tabulated *tabulated,
                               reference_vec normal, reference_vec view) {
    const reference_material guide = { { 1, 1, 1 }, { 0.5, 0.5, 0.5 }, GUIDE_EXPONENT };
    const reference_band_limit whole = { .bands = 0 };
    const reference_vec ray_origin = surface->ray_origin;
    reference_surface_set(surface, &whole, &guide, surface->position, normal, view);
    surface->ray_origin = ray_origin;
    surface->tabulated = tabulated;
    surface->band_limited = tabulated->source->coefficients != NULL;
}

double reference_lobe_at(const reference_lobe *lobe, double cosine) {
    if (lobe->bands == 0) {
        const double e = lobe->exponent, scale = (e + 1) / (2 * REFERENCE_PI);
        if (cosine <= 0)
            return 0;
        return e == 1 ? scale * cosine : scale * pow(cosine, e);
    }
    double before = 0, p = 1, sum = 0;
    for (int l = 0; l < lobe->bands; l++) {
        const double next = ((2 * l + 1) * cosine * p - l * before) / (l + 1);
        sum += lobe->series[l] * p;
        before = p;
        p = next;
    }
    return sum;
}
