/* SPDX-License-Identifier: MIT */
/* material.h - what a material is to a kernel: for one surface a short list of zonal lobes, or one
 * row of a table. A new kind of material is a case of lmp_shade_source and of
 * lmp_shade_reflection. */
#ifndef LAMPION_SHADE_MATERIAL_H
#define LAMPION_SHADE_MATERIAL_H

#include "src/base/precondition.h"
#include "src/lobe/ggx.h"

#include <lampion/shade.h>

/* What a surface reflects by, as long as nothing is truncated: a diffuse lobe of an albedo around
 * the normal, and Phong lobes. */
typedef struct shade_phong {
    lmp_vec3 axis;
    float exponent;
    lmp_rgb weight;
} shade_phong;

typedef struct shade_reflection {
    lmp_rgb diffuse;
    int count;
    shade_phong lobe[LMP_GGX_LOBES];
} shade_reflection;

#define SHADE_LOBES_MAX (1 + LMP_GGX_LOBES)

/* weight times the kernel around `axis` of Funk-Hecke factors lambda (lobe.h). */
typedef struct shade_lobe {
    lmp_vec3 axis;
    lmp_rgb weight;
    float lambda[LMP_BANDS_MAX]; /* windowed */
} shade_lobe;

typedef struct shade_lobes {
    int bands, count;
    shade_lobe lobe[SHADE_LOBES_MAX];
} shade_lobes;

/* What a surface is shaded from: a table, a preintegrated BRDF, or, if both are NULL, lobes. Of a
 * material that has both, a method that reads what is preintegrated takes that. */
typedef struct shade_source {
    const lmp_brdf_table *table;
    const lmp_preintegrated_brdf *preintegrated;
} shade_source;

static inline shade_source lmp_shade_source(const lmp_material *material, bool preintegrated) {
    shade_source source = { NULL, NULL };
    if (material->kind == LMP_MATERIAL_PREINTEGRATED)
        source.preintegrated = material->preintegrated;
    else if (material->kind == LMP_MATERIAL_TABLE && preintegrated && material->preintegrated)
        source.preintegrated = material->preintegrated;
    else if (material->kind == LMP_MATERIAL_TABLE)
        source.table = material->table;
    return source;
}

/* 0 … 1, all of them. */
static inline bool lmp_is_dielectric(const lmp_dielectric *d) {
    const float f0 = fminf(d->f0.r, fminf(d->f0.g, d->f0.b));
    return !d->given ||
           (f0 >= 0 && d->f0.r <= 1 && d->f0.g <= 1 && d->f0.b <= 1 && d->f90 >= 0 && d->f90 <= 1);
}

/* 0 … 1, all of them; or none of them counts. */
static inline bool lmp_are_fibers(const lmp_fibers *f) {
    const float least = fminf(f->color.r, fminf(f->color.g, f->color.b));
    const float most = fmaxf(f->color.r, fmaxf(f->color.g, f->color.b));
    return !f->white || (least >= 0 && most <= 1 && isfinite(f->roughness));
}

/* Whether the members that the material's kind names are in their ranges (shade.h). */
static inline bool lmp_is_material(const lmp_material *material) {
    const lmp_coat *coat = &material->coat;
    if (!(coat->weight >= 0 && coat->weight <= 1 && isfinite(coat->roughness) &&
          lmp_are_fibers(&material->fibers)))
        return false;
    switch (material->kind) {
    case LMP_MATERIAL_LOBES:
        return material->exponent >= 0 && isfinite(material->exponent);
    case LMP_MATERIAL_METALLIC_ROUGHNESS:
        return isfinite(material->metallic) && isfinite(material->roughness) &&
               lmp_is_dielectric(&material->dielectric);
    case LMP_MATERIAL_TABLE:
        return material->table || material->preintegrated;
    case LMP_MATERIAL_PREINTEGRATED:
        return material->preintegrated;
    }
    return false;
}

static inline const lmp_material *lmp_material_at(const lmp_surfaces *surfaces, size_t i) {
    const char *first = (const char *)surfaces->material;
    return (const lmp_material *)(const void *)(first + i * surfaces->material_stride);
}

static inline const lmp_vec3 *lmp_coat_normal(const lmp_surface *surface) {
    const lmp_vec3 *n = &surface->coat_normal;
    return n->x == 0 && n->y == 0 && n->z == 0 ? &surface->normal : n;
}

/* One of many. */
static inline lmp_surface lmp_surface_at(const lmp_surfaces *surfaces, size_t i) {
    const lmp_vec3_array *const arrays[] = { &surfaces->position, &surfaces->normal,
                                             &surfaces->view, &surfaces->tangent,
                                             &surfaces->coat_normal };
    lmp_vec3 members[5] = { { 0, 0, 0 } };
    for (int k = 0; k < 5; k++)
        if (arrays[k]->x)
            members[k] = lmp_vec3_element(arrays[k], i);
    return (lmp_surface) { members[0], members[1], members[2], members[3], members[4] };
}

/* One surface as many, which functions of one hand to those of many. */
static inline lmp_surfaces lmp_surfaces_of(const lmp_material *material,
                                           const lmp_surface *surface) {
    return (lmp_surfaces) { .position = lmp_vec3_array_same(&surface->position),
                            .normal = lmp_vec3_array_same(&surface->normal),
                            .view = lmp_vec3_array_same(&surface->view),
                            .tangent = lmp_vec3_array_same(&surface->tangent),
                            .material = material,
                            .coat_normal = lmp_vec3_array_same(lmp_coat_normal(surface)) };
}

static inline bool lmp_are_surfaces(const lmp_surfaces *surfaces, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!lmp_is_material(lmp_material_at(surfaces, i)))
            return false;
    return lmp_are_finite(surfaces->position, count) && lmp_are_unit(surfaces->normal, count) &&
           lmp_are_unit(surfaces->view, count);
}

/* A truncated series rings below 0; NaN stays. */
static inline float lmp_shade_clamped(float sum) {
    return sum <= 0 ? 0 : sum;
}

/* NaN counts as 0. */
static inline float lmp_shade_saturate(float x) {
    return x > 0 ? x < 1 ? x : 1 : 0;
}

/* The settings with every default filled in. */
lmp_shade_settings lmp_shade_resolve(const lmp_shade_settings *settings);

/* Metallic-roughness (glTF 2.0, appendix B) is a metal, whose F0 is the base color, mixed with a
 * dielectric, whose base color lies under a layer: the albedo of that base, F0 and F90 of both, and
 * of the layer alone, whose most reflected channel is held back from the base. */
typedef struct shade_layers {
    lmp_rgb diffuse, f0;
    float f90, layer_f0, layer_f90;
} shade_layers;
shade_layers lmp_shade_layers(const lmp_material *material);

/* What passes the layer on its way to the base and back, by diffuse_f90 (lobe.h). */
static inline float lmp_shade_passed(const shade_layers *layers, float diffuse_f90) {
    return 1 - layers->layer_f0 * (1 - diffuse_f90) - layers->layer_f90 * diffuse_f90;
}

/* Where a mirror reflects to: the axis of a material's own Phong lobe. */
static inline lmp_vec3 lmp_shade_mirrored(lmp_vec3 n, lmp_vec3 v) {
    const float twice = 2 * (n.x * v.x + n.y * v.y + n.z * v.z);
    return (lmp_vec3) { twice * n.x - v.x, twice * n.y - v.y, twice * n.z - v.z };
}

/* How many Phong lobes a surface needs; 0 of a material that has none. */
static inline int lmp_shade_phong_count(const lmp_material *material, lmp_vec3 n, lmp_vec3 v) {
    if (material->kind == LMP_MATERIAL_METALLIC_ROUGHNESS)
        return lmp_lobe_ggx_count(n.x * v.x + n.y * v.y + n.z * v.z, material->roughness);
    return material->kind == LMP_MATERIAL_LOBES;
}

/* For a material of a kind that has lobes. */
void lmp_shade_reflection(const lmp_material *material, lmp_vec3 normal, lmp_vec3 view,
                          shade_reflection *reflection);

/* The same truncated to bands; the diffuse lobe, lobe[0], has no lambda unless it is, too. */
void lmp_shade_lobes(const lmp_shade_settings *resolved, const lmp_material *material,
                     const lmp_surface *surface, bool diffuse_by_bands, shade_lobes *lobes);

/* One surface whose source is not preintegrated, nor its lobes (method.h); clamped to 0. */
lmp_rgb lmp_shade_sum(const lmp_shade_settings *resolved, const lmp_material *material,
                      const lmp_surface *surface, const lmp_light *lights, size_t count);

/* What lies over a material, from below: each is shaded as a surface of its own, by one or two
 * materials. */
typedef enum shade_over { SHADE_OVER_FIBERS, SHADE_OVER_COAT, SHADE_OVERS } shade_over;

/* color = left * color + weight * what the material reflects. */
typedef struct shade_layer {
    lmp_material material;
    lmp_rgb weight;
    float left;
} shade_layer;

static inline bool lmp_is_over(const lmp_material *material, shade_over over) {
    return over == SHADE_OVER_COAT ? material->coat.weight > 0 : material->fibers.white != NULL;
}

/* Bit `over` of each that a material has. */
static inline unsigned lmp_shade_overs(const lmp_material *material) {
    return (unsigned)lmp_is_over(material, SHADE_OVER_FIBERS) << SHADE_OVER_FIBERS |
           (unsigned)lmp_is_over(material, SHADE_OVER_COAT) << SHADE_OVER_COAT;
}

/* Returns how many. The normal is the coat's, of a coat. */
enum { SHADE_LAYERS_MAX = 2 };
int lmp_shade_layers_over(const lmp_material *material, shade_over over, lmp_vec3 normal,
                          lmp_vec3 view, shade_layer layers[SHADE_LAYERS_MAX]);

static inline lmp_rgb lmp_shade_add_layer(const shade_layer *layer, lmp_rgb under,
                                          lmp_rgb reflected) {
    return (lmp_rgb) { under.r * layer->left + reflected.r * layer->weight.r,
                       under.g * layer->left + reflected.g * layer->weight.g,
                       under.b * layer->left + reflected.b * layer->weight.b };
}

/* lmp_shade_n and lmp_shade_environment_n of what is under all layers, as if there were none. They
 * read every material, and return what lies over any of them: bit `over` of each. */
unsigned lmp_shade_bare_n(const lmp_shade_settings *settings, const lmp_surfaces *surfaces,
                          size_t count, const lmp_light *lights, size_t light_count,
                          size_t rgb_stride, float *rgb);
unsigned lmp_shade_environment_bare_n(const lmp_shade_settings *settings,
                                      const lmp_surfaces *surfaces, size_t count,
                                      const lmp_environment *environment, size_t rgb_stride,
                                      float *rgb);

/* Such a function, of whatever shines; and surfaces with their layers by it. */
typedef unsigned shade_bare_n(const void *light, const lmp_surfaces *surfaces, size_t count,
                              size_t stride, float *rgb);
void lmp_shade_layered(shade_bare_n *bare, const void *light, bool positions,
                       const lmp_surfaces *surfaces, size_t count, size_t rgb_stride, float *rgb);

/* Not clamped. */
lmp_rgb lmp_shade_lobes_zonal(const shade_lobes *lobes, lmp_vec3 point, const lmp_light *lights,
                              size_t count);
lmp_rgb lmp_shade_lobes_coefficients(const shade_lobes *lobes, lmp_vec3 point,
                                     const lmp_light *lights, size_t count);
lmp_rgb lmp_shade_table(const lmp_brdf_table *table, const lmp_surface *surface,
                        const lmp_light *lights, size_t count);
lmp_rgb lmp_shade_table_environment(const lmp_brdf_table *table, const lmp_surface *surface,
                                    const lmp_environment *environment);

#endif
