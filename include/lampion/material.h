/* SPDX-License-Identifier: MIT */
/* lampion/material.h - what a surface is made of: lobes, glTF's metallic-roughness or a table, and
 * the layers over it.
 *
 * A material is a plain value, whose kind says what it is. It owns nothing: tables must live as
 * long as it is used. With the paper's two lobes (paper §4.1) it reflects, for a normal n, a view
 * direction v and the mirror direction r = 2 (n·v) n - v,
 *
 *     k(w) = diffuse/pi max(n·w, 0)  +  specular (e+1)/(2 pi) max(r·w, 0)^e.
 *
 * With glTF's metallic-roughness (glTF 2.0, appendix B) the specular part consists of the lobes of
 * lmp_lobe_find_ggx with F0 = mix(f0, base_color, metallic) and F90 = mix(f90, 1, metallic), and
 * the diffuse lobe has the albedo base_color (1 - metallic) (1 - max(f0) diffuse_f0 - f90
 * diffuse_f90). Here f0 and f90 are those of the dielectric: LMP_DIELECTRIC_F0 and 1 unless it is
 * given.
 *
 * A coat of weight w is a GGX lobe around a normal n of its own. It reflects the fraction w (0.04 +
 * 0.96 (1 - |v·n|)^5) and leaves the rest to what is under it, as the fibers of a sheen do.
 *
 * Colors are linear. `roughness` is glTF's here as everywhere; its square is called alpha. */
#ifndef LAMPION_MATERIAL_H
#define LAMPION_MATERIAL_H

#include <lampion/brdf.h>
#include <lampion/preintegrated.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How a material is described; the comments name the members of lmp_material that are read. */
typedef enum lmp_material_kind {
    LMP_MATERIAL_LOBES = 0,          /* diffuse, specular, exponent */
    LMP_MATERIAL_METALLIC_ROUGHNESS, /* base_color, metallic, roughness, dielectric: glTF's */
    LMP_MATERIAL_TABLE,              /* table, and preintegrated if there is one */
    LMP_MATERIAL_PREINTEGRATED       /* preintegrated */
} lmp_material_kind;

/* The reflectance of metallic-roughness's dielectric along the normal and at grazing angles, as in
 * KHR_materials_specular and KHR_materials_ior. Zero-initialized it means LMP_DIELECTRIC_F0, which
 * corresponds to an index of refraction of 1.5, and 1. */
#define LMP_DIELECTRIC_F0 0.04f
typedef struct lmp_dielectric {
    bool given; /* false: the other members are ignored */
    lmp_rgb f0; /* 0 … 1 */
    float f90;  /* 0 … 1 */
} lmp_dielectric;

/* Makes the dielectric that has this index of refraction, >= 0, and whose reflection has this
 * weight, 0 … 1, and color, >= 0. The defaults are 1.5, 1 and white. */
LMP_API lmp_dielectric lmp_material_dielectric(float ior, float specular, lmp_rgb color);

/* A clear coat over a material of any kind, as in KHR_materials_clearcoat. Zero-initialized it
 * means no coat. */
typedef struct lmp_coat {
    float weight;    /* 0 … 1 */
    float roughness; /* 0 … 1; clamped */
} lmp_coat;

/* Returns the fraction of the light that a coat reflects toward `view`. What is under the coat,
 * including emitted light, is seen through it and is weighted by the remainder.
 *
 * normal is the coat's, which may differ from that of the surface; normal and view must be unit.
 * Returns 0 for a coat of weight 0 */
LMP_API float lmp_material_coat_reflectance(const lmp_coat *coat, lmp_vec3 normal, lmp_vec3 view);

/* Sheen over a material of any kind, under its coat, as in KHR_materials_sheen: a layer of fibers.
 * What is under them keeps the fraction 1 - max(color) E of its light, where E is the fraction of a
 * uniform sky that white fibers reflect toward the view. Zero-initialized it means no sheen.
 *
 * white: LMP_SHEEN_TABLES tables of white fibers over black (lmp_brdf_create_sheen), for
 * roughnesses spaced evenly over LMP_SHEEN_ROUGHNESS_MIN … 1; other roughnesses are interpolated
 * between two. Their bands and window apply, whatever the settings say. */
#define LMP_SHEEN_TABLES        16
#define LMP_SHEEN_ROUGHNESS_MIN 0.07f
typedef struct lmp_sheen_layer {
    lmp_rgb color;   /* 0 … 1 */
    float roughness; /* clamped */
    const lmp_brdf_table *const *white;
} lmp_sheen_layer;

/* A material. Zero-initialize it and set the members listed for its kind; others are ignored. A
 * material of zeros is black. */
typedef struct lmp_material {
    lmp_material_kind kind;
    union {
        lmp_rgb diffuse;    /* albedo of the diffuse lobe */
        lmp_rgb base_color; /* linear */
    };
    lmp_rgb specular; /* reflectance of the Phong lobe */
    union {
        float exponent; /* of the Phong lobe, finite, >= 0 */
        float metallic; /* 0 … 1; clamped */
    };
    float roughness; /* 0 … 1; clamped */
    lmp_dielectric dielectric;
    lmp_sheen_layer sheen; /* over a material of any kind */
    lmp_coat coat;         /* over the sheen, whatever the kind; its light is summed by lobes */
    /* A tabulated BRDF, summed with the table's own bands and windowing filter. */
    const lmp_brdf_table *table;
    /* The preintegrated BRDF that LMP_SHADE_PREINTEGRATED reads in place of the table. */
    const lmp_preintegrated_brdf *preintegrated;
} lmp_material;

#ifdef __cplusplus
}
#endif
#endif
