/* SPDX-License-Identifier: MIT */
/* lampion/shade.h - the radiance a surface reflects to the viewer under many lights.
 *
 * A material is one value, told by its kind; a method says how the sum is taken. Whatever the
 * material, the reflected light is
 *
 *     L_o = ∫ L(w) k(w) dw,   k = f_r(w, v) max(n·w, 0) in n bands, windowed,
 *
 * n the normal and v the view of the surface; the light is not windowed. The diffuse part of k
 * needs no bands: a cap that the horizon may cut gives an irradiance of closed form
 * (lmp_light_irradiance), which every method takes but LMP_SHADE_COEFFICIENTS, the paper's. Of the
 * paper's two lobes (paper §4.1), with r = 2 (n·v) n - v the mirror direction,
 *
 *     k(w) = diffuse/pi max(n·w, 0)  +  specular (e+1)/(2 pi) max(r·w, 0)^e.
 *
 * Of glTF's metallic-roughness (glTF 2.0, appendix B) the specular part is the lobes of
 * lmp_lobe_ggx with F0 = mix(f0, base_color, metallic) and F90 = mix(f90, 1, metallic), and the
 * albedo of the diffuse one base_color (1 - metallic) (1 - max(f0) diffuse_f0 - f90 diffuse_f90),
 * where f0 and f90 are the dielectric's, LMP_DIELECTRIC_F0 and 1 unless it says more.
 *
 * The sum over all lights is then clamped at 0, channel by channel, for a truncated series rings.
 * A coat reflects by GGX around a normal of its own, its weight w (0.04 + 0.96 (1 - |v·n|)^5), and
 * leaves the rest to what is under it, as fibers do; each is clamped by itself. No visibility.
 *
 * A release build takes vectors that are not unit and floats out of range as they are, and stays
 * finite and inside its arrays; bands past LMP_BANDS_MAX overrun them (base.h). */
#ifndef LAMPION_SHADE_H
#define LAMPION_SHADE_H

#include <lampion/brdf.h>
#include <lampion/preintegrated.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lmp_material_kind {
    LMP_MATERIAL_LOBES = 0,          /* diffuse, specular, exponent */
    LMP_MATERIAL_METALLIC_ROUGHNESS, /* base_color, metallic, roughness, dielectric: glTF's */
    LMP_MATERIAL_TABLE,              /* table, and preintegrated if there is one */
    LMP_MATERIAL_PREINTEGRATED       /* preintegrated */
} lmp_material_kind;

/* How the dielectric of metallic-roughness reflects, as KHR_materials_specular and
 * KHR_materials_ior have it: along the normal and at grazing angles. Zero-initialized:
 * LMP_DIELECTRIC_F0, of an index of refraction of 1.5, and 1. */
#define LMP_DIELECTRIC_F0 0.04f
typedef struct lmp_dielectric {
    bool given; /* false: the others are ignored */
    lmp_rgb f0; /* 0 … 1 */
    float f90;  /* 0 … 1 */
} lmp_dielectric;

/* Of an index of refraction, >= 0, of the weight of its reflection, 0 … 1, and of its color, >= 0;
 * 1.5, 1 and white are the default. */
LMP_API lmp_dielectric lmp_material_dielectric(float ior, float specular, lmp_rgb color);

/* A clear coat over a material of any kind, as KHR_materials_clearcoat has it. Zero-initialized:
 * none. */
typedef struct lmp_coat {
    float weight;    /* 0 … 1 */
    float roughness; /* 0 … 1; clamped */
} lmp_coat;

/* The part of the light that a coat reflects, seen from `view`. What is under it, light that the
 * surface emits too, is seen through it: it counts by the rest.
 *
 * normal, the coat's, and view must be unit */
LMP_API float lmp_material_coated(const lmp_coat *coat, lmp_vec3 normal, lmp_vec3 view);

/* Fibers over a material of any kind, under its coat, as KHR_materials_sheen has them: what is
 * under them has 1 - max(color) E of its light, E what white ones reflect of a sky to the view.
 * Zero-initialized: none.
 *
 * white: LMP_FIBER_TABLES tables of white fibers over black (lmp_brdf_create_sheen), of roughnesses
 * that divide LMP_FIBER_ROUGHNESS_MIN … 1 evenly; other roughnesses are between two. Their bands
 * and window count, whatever the settings say. */
#define LMP_FIBER_TABLES        16
#define LMP_FIBER_ROUGHNESS_MIN 0.07f
typedef struct lmp_fibers {
    lmp_rgb color;   /* 0 … 1 */
    float roughness; /* clamped */
    const lmp_brdf_table *const *white;
} lmp_fibers;

/* A material; zero-initialize it and set the members its kind names. Others are ignored. */
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
    lmp_fibers fibers; /* of every kind, as the next one */
    lmp_coat coat;     /* its light is summed by lobes */
    /* A tabulated BRDF, with the bands and the windowing filter of the table. */
    const lmp_brdf_table *table;
    /* The same integrated beforehand: what LMP_SHADE_PREINTEGRATED reads in the table's place. */
    const lmp_preintegrated_brdf *preintegrated;
} lmp_material;

/* How the sum is taken. Of specular lobes and tables the results differ by rounding, except that a
 * preintegrated lobe or BRDF has an error of its own (preintegrated.h). Of the diffuse lobe they
 * are exact, except that LMP_SHADE_COEFFICIENTS truncates it to n bands and windows it, as the
 * paper does (docs/accuracy.md has the error). */
typedef enum lmp_shade_method {
    LMP_SHADE_ZONAL = 0,     /* the addition theorem: O(n) per light */
    LMP_SHADE_COEFFICIENTS,  /* the paper's: the lights' n² coefficients, then a dot product */
    LMP_SHADE_PREINTEGRATED, /* specular lobes read from settings.lobe, tables from
                                material.preintegrated: a cost that the bands do not change */
} lmp_shade_method;
#define LMP_SHADE_METHODS (LMP_SHADE_PREINTEGRATED + 1) /* of the last one */

/* How to shade; zero-initialized: by zonal sums of 10 bands, no windowing filter. */
typedef struct lmp_shade_settings {
    lmp_shade_method method;
    int bands; /* 1 … LMP_BANDS_MAX, 0 means LMP_SHADE_BANDS_DEFAULT */
    lmp_window window;
    float window_size; /* as in lmp_sh_window */
    /* Of LMP_SHADE_PREINTEGRATED, whose bands and window then count in place of those above; NULL
     * where no material has lobes, nor a coat. */
    const lmp_preintegrated_lobe *lobe;
} lmp_shade_settings;
#define LMP_SHADE_BANDS_DEFAULT 10

/* A shaded point. */
typedef struct lmp_surface {
    lmp_vec3 position;
    lmp_vec3 normal; /* unit */
    lmp_vec3 view;   /* unit, to the viewer */
    /* The x axis of a material with an anisotropic table, of any length and at any angle to the
     * normal but 0; zero means the horizontal one, y up x normal. */
    lmp_vec3 tangent;
    lmp_vec3 coat_normal; /* unit, of a coat; zero means `normal` */
} lmp_surface;

/* Reflected radiance, W·sr⁻¹·m⁻². By LMP_SHADE_ZONAL it is the meaning that every other method,
 * batch and device is held to; of LMP_SHADE_PREINTEGRATED it is lmp_shade_n of one surface.
 *
 * A table is summed by its coefficients under either method of sums: the lights are moved to the
 * view's frame, so that none are rotated (Kautz et al. 2002). Each call prepares the material anew:
 * for many surfaces lmp_shade_n takes less time a light.
 *
 * settings may be NULL (zero-initialized); count may be 0 */
LMP_API lmp_rgb lmp_shade(const lmp_shade_settings *settings, const lmp_material *material,
                          const lmp_surface *surface, const lmp_light *lights, size_t count);

/* Many surfaces, wherever their members are (base.h); material_stride 0: the same for all. */
typedef struct lmp_surfaces {
    lmp_vec3_array position, normal, view;
    lmp_vec3_array tangent; /* x NULL: zero for all */
    const lmp_material *material;
    size_t material_stride;
    lmp_vec3_array coat_normal; /* x NULL: `normal` for all */
} lmp_surfaces;

/* lmp_shade of many surfaces, vectorized over them, with the same bits on every instruction set.
 * Split the surfaces among your threads: no split changes a bit.
 *
 * Lobes summed by LMP_SHADE_ZONAL differ from lmp_shade by rounding, at n bands up to 3e-6 + 2e-7
 * n² of a light's peak (what it gives where the lobes point at it), which counts where a narrow
 * lobe points at a small light. On the surface of a sphere, where cos a changes faster than float32
 * tells positions apart, both methods that are vectorized round it to within 5e-4, as lmp_shade
 * does. Sums of coefficients go one surface after another. Positions: light.h, batches.
 *
 * settings may be NULL (zero-initialized); lights may be NULL if light_count is 0
 * rgb_stride is from one surface's red to the next one's; 0 means tight, 3 floats. rgb must not
 * overlap what is read */
LMP_API void lmp_shade_n(const lmp_shade_settings *settings, const lmp_surfaces *surfaces,
                         size_t count, const lmp_light *lights, size_t light_count,
                         size_t rgb_stride, float *rgb);

/* --- an environment ------------------------------------------------------------------------------
 * Ambient light from far away: the coefficients of its radiance, three planes, red, green,
 * blue, of LMP_SH_COUNT(bands), as lmp_sh_project_latlong and lmp_sh_project_cubemap make them.
 *
 * What a surface reflects of it is an integral like that of lmp_shade, clamped at 0 by itself: add
 * it to what the lights give. An occlusion map weakens this sum alone. */
typedef struct lmp_environment {
    const float *sh;
    int bands; /* 1 … LMP_BANDS_MAX; those past the bands of the settings are not read */
} lmp_environment;

/* Reflected radiance, W·sr⁻¹·m⁻². Of the settings, bands and window count, those of settings.lobe
 * under LMP_SHADE_PREINTEGRATED. All methods give the same, for a lobe of n bands takes n² terms
 * whatever the light is, except that LMP_SHADE_COEFFICIENTS alone windows the diffuse lobe. Of
 * LMP_MATERIAL_TABLE the table is read, by its first LMP_ENVIRONMENT_TABLE_BANDS bands;
 * LMP_MATERIAL_PREINTEGRATED has none, and reflects nothing.
 *
 * settings may be NULL */
#define LMP_ENVIRONMENT_TABLE_BANDS 16
LMP_API lmp_rgb lmp_shade_environment(const lmp_shade_settings *settings,
                                      const lmp_material *material, const lmp_surface *surface,
                                      const lmp_environment *environment);

/* The same of many surfaces, with the bits of any number of them; positions are not read, and the
 * rest is as for lmp_shade_n. */
LMP_API void lmp_shade_environment_n(const lmp_shade_settings *settings,
                                     const lmp_surfaces *surfaces, size_t count,
                                     const lmp_environment *environment, size_t rgb_stride,
                                     float *rgb);

#ifdef __cplusplus
}
#endif
#endif
