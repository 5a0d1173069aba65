/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_lobe.h"

/* Computes (2l+1)/(4 pi) w_l lambda_l with lambda_l = (e+1) ∫ t^e P_l(t) dt over 0 … 1. Integrating
 * Legendre's equation against t^e gives lambda_l (e+l+1) = lambda_(l-2) (e-l+2). */
static void limit_lobe(reference_lobe *lobe, const reference_band_limit *limit) {
    const double e = lobe->exponent;
    double before = 0, lambda = 1;
    reference_series_of_direction(limit, lobe->series);
    lobe->bands = limit->bands;
    for (int l = 0; l < limit->bands; l++) {
        const double next = l == 0 ? (e + 1) / (e + 2) : before * (e - l + 1) / (e + l + 2);
        lobe->series[l] *= lambda;
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
    diffuse->ggx = specular->ggx = NULL;
    surface->lobe_count = 2;
    surface->band_limited = limit->bands > 0;
    surface->occluded = 0;
    surface->tabulated = NULL;
    surface->ggx = surface->coat = NULL;
    surface->sheen = NULL;
    surface->under = 1;
    surface->translucent = false;
    if (limit->bands) {
        limit_lobe(diffuse, limit);
        limit_lobe(specular, limit);
    }
}

static void set_guide(reference_surface *surface, const reference_material *guide,
                      reference_vec normal, reference_vec view) {
    const reference_band_limit whole = { .bands = 0 };
    const reference_vec ray_origin = surface->ray_origin;
    reference_surface_set(surface, &whole, guide, surface->position, normal, view);
    surface->ray_origin = ray_origin;
}

/* Returns the exponent of a Phong lobe with about the solid angle of the GGX lobe. */
static double guide_exponent(const reference_ggx *ggx) {
    return fmax(0.5 / (ggx->alpha * ggx->alpha) - 1, 0);
}

void reference_surface_shine(reference_surface *surface, const reference_band_limit *limit,
                             const reference_ggx *ggx, reference_vec normal, reference_vec view) {
    const double grazing = pow(1 - ggx->view[2], 5);
    reference_material guide = { .exponent = guide_exponent(ggx) };
    for (int c = 0; c < 3; c++) {
        guide.diffuse[c] = ggx->diffuse[c];
        guide.specular[c] = ggx->f0[c] + (ggx->f90 - ggx->f0[c]) * grazing;
    }
    set_guide(surface, &guide, normal, view);
    surface->lobes[1].ggx = ggx;
    surface->ggx = ggx;
    surface->limit = *limit;
    surface->band_limited = limit->bands > 0;
}

/* Attenuates the lobes by the layer that is put over them. */
static void cover(reference_surface *surface, double under) {
    for (int k = 0; k < surface->lobe_count; k++)
        for (int c = 0; c < 3; c++)
            surface->lobes[k].weight[c] *= under;
}

/* Adds the guide of a sheen, which reflects in all directions: a lobe of exponent 0. */
void reference_surface_sheen(reference_surface *surface, const reference_sheen *sheen) {
    cover(surface, sheen->under);
    reference_lobe *over = &surface->lobes[surface->lobe_count++];
    *over = (reference_lobe) { .axis = sheen->normal };
    for (int c = 0; c < 3; c++)
        over->weight[c] = sheen->color[c] / 4;
    surface->sheen = sheen;
}

void reference_surface_coat(reference_surface *surface, const reference_ggx *coat,
                            reference_vec normal, reference_vec view) {
    cover(surface, 1 - coat->f90);
    reference_lobe *over = &surface->lobes[surface->lobe_count++];
    *over = (reference_lobe) { .axis = reference_mirror(view, normal),
                               .exponent = guide_exponent(coat),
                               .ggx = coat };
    surface->coat = coat;
    surface->under = 1 - coat->f90;
    for (int c = 0; c < 3; c++)
        over->weight[c] = coat->f90;
}

void reference_surface_transmit(reference_surface *surface, const double color[3],
                                reference_vec normal, reference_vec origin) {
    reference_lobe *through = &surface->lobes[surface->lobe_count++];
    *through = (reference_lobe) { .axis = reference_scale(-1, normal), .exponent = 1 };
    for (int c = 0; c < 3; c++)
        surface->transmitted[c] = through->weight[c] = color[c];
    surface->translucent = true;
    surface->behind[0] = through->axis;
    surface->behind[1] = origin;
}

/* Neither too diffuse nor too specular for most materials; samples are weighted by it. */
#define GUIDE_EXPONENT 40

void reference_surface_measure(reference_surface *surface, const reference_tabulated *tabulated,
                               reference_vec normal, reference_vec view) {
    const reference_material guide = { { 1, 1, 1 }, { 0.5, 0.5, 0.5 }, GUIDE_EXPONENT };
    set_guide(surface, &guide, normal, view);
    surface->tabulated = tabulated;
    surface->band_limited = tabulated->source->coefficients != NULL;
}

double reference_lobe_at(const reference_lobe *lobe, double cosine) {
    if (lobe->ggx)
        return reference_ggx_near(lobe->ggx->alpha, cosine);
    if (lobe->bands > 0)
        return reference_series_at(lobe->bands, lobe->series, cosine);
    const double e = lobe->exponent, scale = (e + 1) / (2 * REFERENCE_PI);
    if (cosine <= 0)
        return 0;
    return e == 1 ? scale * cosine : scale * pow(cosine, e);
}
