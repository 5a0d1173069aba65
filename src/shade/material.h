/* SPDX-License-Identifier: MIT */
/* material.h - a material as the kernels see it: for one surface, a short list of zonal lobes or
 * one row of a table. A new kind of material needs a case in lmpi_shade_source and one in
 * lmpi_shade_reflection. */
#ifndef LAMPION_SHADE_MATERIAL_H
#define LAMPION_SHADE_MATERIAL_H

#include "src/base/precondition.h"
#include "src/lobe/ggx.h"

#include <lampion/shade.h>

/* What a surface reflects by before truncation: a diffuse lobe of an albedo around the normal, and
 * Phong lobes. */
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

/* A lobe: weight times the kernel around `axis` with Funk-Hecke factors lambda (lobe.h). */
typedef struct shade_lobe {
    lmp_vec3 axis;
    lmp_rgb weight;
    float lambda[LMP_BANDS_MAX]; /* windowed */
} shade_lobe;

typedef struct shade_lobes {
    int bands, count;
    shade_lobe lobe[SHADE_LOBES_MAX];
} shade_lobes;

/* The source that a surface is shaded from: a table, a preintegrated BRDF, or, if both are NULL,
 * lobes. Where a material has both, methods that read preintegrated data take the preintegrated
 * BRDF. */
typedef struct shade_source {
    const lmp_brdf_table *table;
    const lmp_preintegrated_brdf *preintegrated;
} shade_source;

static inline shade_source lmpi_shade_source(const lmp_material *material, bool preintegrated) {
    shade_source source = { NULL, NULL };
    if (material->kind == LMP_MATERIAL_PREINTEGRATED)
        source.preintegrated = material->preintegrated;
    else if (material->kind == LMP_MATERIAL_TABLE && preintegrated && material->preintegrated)
        source.preintegrated = material->preintegrated;
    else if (material->kind == LMP_MATERIAL_TABLE)
        source.table = material->table;
    return source;
}

/* Whether a dielectric is valid: all members are in 0 … 1. */
static inline bool lmpi_is_dielectric(const lmp_dielectric *d) {
    const float f0 = fminf(d->f0.r, fminf(d->f0.g, d->f0.b));
    return !d->given ||
           (f0 >= 0 && d->f0.r <= 1 && d->f0.g <= 1 && d->f0.b <= 1 && d->f90 >= 0 && d->f90 <= 1);
}

/* Whether sheen is valid: all members are in 0 … 1, or there is none. */
static inline bool lmpi_is_sheen(const lmp_sheen_layer *f) {
    const float least = fminf(f->color.r, fminf(f->color.g, f->color.b));
    const float most = fmaxf(f->color.r, fmaxf(f->color.g, f->color.b));
    return !f->white || (least >= 0 && most <= 1 && isfinite(f->roughness));
}

/* Whether the members that the material's kind names are in their ranges (shade.h). */
static inline bool lmpi_is_material(const lmp_material *material) {
    const lmp_coat *coat = &material->coat;
    if (!(coat->weight >= 0 && coat->weight <= 1 && isfinite(coat->roughness) &&
          lmpi_is_sheen(&material->sheen)))
        return false;
    switch (material->kind) {
    case LMP_MATERIAL_LOBES:
        return material->exponent >= 0 && isfinite(material->exponent);
    case LMP_MATERIAL_METALLIC_ROUGHNESS:
        return isfinite(material->metallic) && isfinite(material->roughness) &&
               lmpi_is_dielectric(&material->dielectric);
    case LMP_MATERIAL_TABLE:
        return material->table || material->preintegrated;
    case LMP_MATERIAL_PREINTEGRATED:
        return material->preintegrated;
    }
    return false;
}

static inline const lmp_material *lmpi_material_at(const lmp_surfaces *surfaces, size_t i) {
    const char *first = (const char *)surfaces->material;
    return (const lmp_material *)(const void *)(first + i * surfaces->material_stride);
}

static inline const lmp_vec3 *lmpi_coat_normal(const lmp_surface *surface) {
    const lmp_vec3 *n = &surface->coat_normal;
    return n->x == 0 && n->y == 0 && n->z == 0 ? &surface->normal : n;
}

/* Returns one of many surfaces. */
static inline lmp_surface lmpi_surface_at(const lmp_surfaces *surfaces, size_t i) {
    const lmp_vec3_array *const arrays[] = { &surfaces->position, &surfaces->normal,
                                             &surfaces->view, &surfaces->tangent,
                                             &surfaces->coat_normal };
    lmp_vec3 members[5] = { { 0, 0, 0 } };
    for (int k = 0; k < 5; k++)
        if (arrays[k]->x)
            members[k] = lmpi_vec3_element(arrays[k], i);
    return (lmp_surface) { members[0], members[1], members[2], members[3], members[4] };
}

/* Returns one surface as many, for functions of one that call those of many. */
static inline lmp_surfaces lmpi_surfaces_of(const lmp_material *material,
                                            const lmp_surface *surface) {
    return (lmp_surfaces) { .position = lmp_vec3_array_same(&surface->position),
                            .normal = lmp_vec3_array_same(&surface->normal),
                            .view = lmp_vec3_array_same(&surface->view),
                            .tangent = lmp_vec3_array_same(&surface->tangent),
                            .material = material,
                            .coat_normal = lmp_vec3_array_same(lmpi_coat_normal(surface)) };
}

static inline bool lmpi_are_surfaces(const lmp_surfaces *surfaces, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!lmpi_is_material(lmpi_material_at(surfaces, i)))
            return false;
    return lmpi_are_finite(surfaces->position, count) && lmpi_are_unit(surfaces->normal, count) &&
           lmpi_are_unit(surfaces->view, count);
}

/* Clamps a sum, because a truncated series rings below 0; NaN stays. */
static inline float lmpi_shade_clamped(float sum) {
    return sum <= 0 ? 0 : sum;
}

/* Clamps x to 0 … 1; NaN becomes 0. */
static inline float lmpi_shade_saturate(float x) {
    return x > 0 ? x < 1 ? x : 1 : 0;
}

/* Returns the settings with every default filled in. */
lmp_shade_settings lmpi_shade_resolve(const lmp_shade_settings *settings);

/* The parameters of metallic-roughness (glTF 2.0, appendix B), a metal, whose F0 is the base color,
 * mixed with a dielectric, whose base color lies under its specular reflection. They are the albedo
 * of that base, F0 and F90 of both together, and F0 and F90 of the dielectric alone in the channel
 * that it reflects most, by which it weakens the base. */
typedef struct shade_reflectance {
    lmp_rgb diffuse, f0;
    float f90, dielectric_f0, dielectric_f90;
} shade_reflectance;
shade_reflectance lmpi_shade_reflectance_of(const lmp_material *material);

/* Returns the fraction of light that passes the dielectric on its way to the base and back, by
 * diffuse_f90 (lobe.h). */
static inline float lmpi_shade_passed(const shade_reflectance *own, float diffuse_f90) {
    return 1 - own->dielectric_f0 * (1 - diffuse_f90) - own->dielectric_f90 * diffuse_f90;
}

/* Returns the mirror direction of the view: the axis of a material's own Phong lobe. */
static inline lmp_vec3 lmpi_shade_mirrored(lmp_vec3 n, lmp_vec3 v) {
    const float twice = 2 * (n.x * v.x + n.y * v.y + n.z * v.z);
    return (lmp_vec3) { twice * n.x - v.x, twice * n.y - v.y, twice * n.z - v.z };
}

/* Returns how many Phong lobes a surface needs; 0 if its material has no lobes. */
static inline int lmpi_shade_phong_count(const lmp_material *material, lmp_vec3 n, lmp_vec3 v) {
    if (material->kind == LMP_MATERIAL_METALLIC_ROUGHNESS)
        return lmpi_lobe_ggx_count(n.x * v.x + n.y * v.y + n.z * v.z, material->roughness);
    return material->kind == LMP_MATERIAL_LOBES;
}

/* Finds the lobes of a material of a kind that has lobes. */
void lmpi_shade_reflection(const lmp_material *material, lmp_vec3 normal, lmp_vec3 view,
                           shade_reflection *reflection);

/* Finds the lobes of a material, truncated to bands. The diffuse lobe, lobe[0], has lambda only
 * where diffuse_by_bands. */
void lmpi_shade_lobes(const lmp_shade_settings *resolved, const lmp_material *material,
                      const lmp_surface *surface, bool diffuse_by_bands, shade_lobes *lobes);

/* Shades one surface whose source and lobes are not preintegrated (method.h); clamped at 0. */
lmp_rgb lmpi_shade_sum(const lmp_shade_settings *resolved, const lmp_material *material,
                       const lmp_surface *surface, const lmp_light *lights, size_t count);

/* The layers that may lie over a material, from below. Each is shaded as a surface of its own, by
 * one or two materials. */
typedef enum shade_layer_kind {
    SHADE_LAYER_SHEEN,
    SHADE_LAYER_COAT,
    SHADE_LAYER_KINDS
} shade_layer_kind;

/* A layer over a color: color = left * color + weight * what the material reflects. */
typedef struct shade_layer {
    lmp_material material;
    lmp_rgb weight;
    float left;
} shade_layer;

static inline bool lmpi_has_layer(const lmp_material *material, shade_layer_kind kind) {
    return kind == SHADE_LAYER_COAT ? material->coat.weight > 0 : material->sheen.white != NULL;
}

/* Returns the layers that a material has: bit `kind` for each. */
static inline unsigned lmpi_shade_layer_mask(const lmp_material *material) {
    return (unsigned)lmpi_has_layer(material, SHADE_LAYER_SHEEN) << SHADE_LAYER_SHEEN |
           (unsigned)lmpi_has_layer(material, SHADE_LAYER_COAT) << SHADE_LAYER_COAT;
}

/* Finds the materials of a layer and returns how many there are. For a coat, normal is the coat's.
 */
enum { SHADE_LAYERS_MAX = 2 };
int lmpi_shade_layers_over(const lmp_material *material, shade_layer_kind kind, lmp_vec3 normal,
                           lmp_vec3 view, shade_layer layers[SHADE_LAYERS_MAX]);

static inline lmp_rgb lmpi_shade_add_layer(const shade_layer *layer, lmp_rgb under,
                                           lmp_rgb reflected) {
    return (lmp_rgb) { under.r * layer->left + reflected.r * layer->weight.r,
                       under.g * layer->left + reflected.g * layer->weight.g,
                       under.b * layer->left + reflected.b * layer->weight.b };
}

/* Do lmp_shade_n and lmp_shade_environment_n for what is under all layers, as if there were none.
 * They examine every material, and return the layers over any of them: bit `kind` for each. stride
 * is in bytes, from one color to the next. */
unsigned lmpi_shade_bare_n(const lmp_shade_settings *settings, const lmp_surfaces *surfaces,
                           size_t count, const lmp_light *lights, size_t light_count, size_t stride,
                           float *rgb);
unsigned lmpi_shade_environment_bare_n(const lmp_shade_settings *settings,
                                       const lmp_surfaces *surfaces, size_t count,
                                       const lmp_environment *environment, size_t stride,
                                       float *rgb);

/* A function that shades without layers, by any light; and lmpi_shade_layered, which adds the
 * layers to it. */
typedef unsigned shade_bare_n(const void *light, const lmp_surfaces *surfaces, size_t count,
                              size_t stride, float *rgb);
void lmpi_shade_layered(shade_bare_n *bare, const void *light, bool positions,
                        const lmp_surfaces *surfaces, size_t count, lmp_rgb_array rgb);

/* Shade one surface by its lobes or its table; the result is not clamped. */
lmp_rgb lmpi_shade_lobes_zonal(const shade_lobes *lobes, lmp_vec3 point, const lmp_light *lights,
                               size_t count);
lmp_rgb lmpi_shade_lobes_coefficients(const shade_lobes *lobes, lmp_vec3 point,
                                      const lmp_light *lights, size_t count);
lmp_rgb lmpi_shade_table(const lmp_brdf_table *table, const lmp_surface *surface,
                         const lmp_light *lights, size_t count);
lmp_rgb lmpi_shade_table_environment(const lmp_brdf_table *table, const lmp_surface *surface,
                                     const lmp_environment *environment);

#endif
