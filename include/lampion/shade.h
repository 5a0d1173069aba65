/* SPDX-License-Identifier: MIT */
/* lampion/shade.h - the radiance a surface reflects to the viewer under many lights.
 *
 * The method determines how the sum is computed. Whatever the material, the reflected light is
 *
 *     L_o = ∫ L(w) k(w) dw,   k = f_r(w, v) max(n·w, 0) in n bands, windowed,
 *
 * where n is the normal and v the view direction of the surface; the light is not windowed. The
 * diffuse part of k needs no bands: the irradiance of a cap that the horizon may cut has a closed
 * form (lmp_light_irradiance), which every method uses except LMP_SHADE_COEFFICIENTS, the paper's.
 * The sum over all lights is then clamped at 0, channel by channel, because a truncated series
 * rings; the light reflected by a coat and that reflected by the material under it are clamped
 * separately. Visibility is not considered.
 *
 * A release build takes vectors that are not unit and floats out of range as they are, and stays
 * finite and within its arrays; more than LMP_BANDS_MAX bands overrun them (base.h). */
#ifndef LAMPION_SHADE_H
#define LAMPION_SHADE_H

#include <lampion/material.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How the sum over the lights is computed. For specular lobes and tables the results differ only by
 * rounding, except that a preintegrated lobe or BRDF has an error of its own (preintegrated.h). For
 * the diffuse lobe they are exact, except that LMP_SHADE_COEFFICIENTS truncates it to n bands and
 * windows it, as the paper does (docs/accuracy.md gives the error). */
typedef enum lmp_shade_method {
    LMP_SHADE_ZONAL = 0,     /* the addition theorem: O(n) per light */
    LMP_SHADE_COEFFICIENTS,  /* the paper's: the lights' n² coefficients, then a dot product */
    LMP_SHADE_PREINTEGRATED, /* specular lobes read from settings.lobe, tables from
                                material.preintegrated: the cost does not depend on the bands;
                                areas are summed as above, and not by preintegrated BRDFs */
} lmp_shade_method;
#define LMP_SHADE_METHOD_COUNT (LMP_SHADE_PREINTEGRATED + 1)

/* How to shade. Zero-initialized it means zonal sums over 10 bands without a windowing filter. */
typedef struct lmp_shade_settings {
    lmp_shade_method method;
    int bands; /* 1 … LMP_BANDS_MAX, 0 means LMP_SHADE_BANDS_DEFAULT */
    lmp_window window;
    float window_size; /* as in lmp_sh_make_window */
    /* The preintegrated lobe of LMP_SHADE_PREINTEGRATED, whose bands and window then replace those
     * above; may be NULL if no material has lobes or a coat. */
    const lmp_preintegrated_lobe *lobe;
} lmp_shade_settings;
#define LMP_SHADE_BANDS_DEFAULT 10

/* A shaded point. */
typedef struct lmp_surface {
    lmp_vec3 position;
    lmp_vec3 normal; /* unit */
    lmp_vec3 view;   /* unit, to the viewer */
    /* The x axis of a material with an anisotropic table, of any length and at any nonzero angle to
     * the normal; zero means the horizontal one, up x normal, where up is y. */
    lmp_vec3 tangent;
    lmp_vec3 coat_normal; /* unit, the normal of a coat; zero means `normal` */
} lmp_surface;

/* Returns the reflected radiance, W·sr⁻¹·m⁻². Under LMP_SHADE_ZONAL it is the definition that every
 * other method, batch and device is held to; under LMP_SHADE_PREINTEGRATED it is what lmp_shade_n
 * computes for one surface.
 *
 * A table is summed by its coefficients under LMP_SHADE_ZONAL and LMP_SHADE_COEFFICIENTS: the
 * lights are transformed into the view's frame, so that no coefficients need rotating (Kautz et al.
 * 2002). Each call prepares the material again: for many surfaces lmp_shade_n takes less time per
 * light.
 *
 * settings may be NULL (zero-initialized); count may be 0 */
LMP_API lmp_rgb lmp_shade(const lmp_shade_settings *settings, const lmp_material *material,
                          const lmp_surface *surface, const lmp_light *lights, size_t count);

/* Many surfaces, in any memory layout (base.h); material_stride 0 means one material for all. */
typedef struct lmp_surfaces {
    lmp_vec3_array position, normal, view;
    lmp_vec3_array tangent; /* zero for all if x is NULL */
    const lmp_material *material;
    size_t material_stride;
    lmp_vec3_array coat_normal; /* `normal` for all if x is NULL */
} lmp_surfaces;

/* Shades many surfaces as lmp_shade does one, vectorized over them, with the same bits on every
 * instruction set. Split the surfaces among your threads as you like: the bits stay the same.
 *
 * Lobes summed by LMP_SHADE_ZONAL differ from lmp_shade by rounding: for n bands, by up to 3e-6 +
 * 2e-7 n² of a light's peak (what it gives where the lobes point at it), which matters where a
 * narrow lobe points at a small light. On the surface of a sphere, where cos a changes faster than
 * float32 can resolve positions, both vectorized methods round it to within 5e-4, as lmp_shade
 * does. Sums of coefficients take one surface after another. The range of positions is that of the
 * batches in light.h.
 *
 * settings may be NULL (zero-initialized); lights may be NULL if light_count is 0;
 * rgb receives one color per surface and must not overlap what is read */
LMP_API void lmp_shade_n(const lmp_shade_settings *settings, const lmp_surfaces *surfaces,
                         size_t count, const lmp_light *lights, size_t light_count,
                         lmp_rgb_array rgb);

/* --- an environment ------------------------------------------------------------------------------
 * Ambient light from far away: the coefficients of its radiance, in three planes, red, green, blue,
 * of LMP_SH_COUNT(bands) values, as lmp_sh_project_latlong and lmp_sh_project_cubemap make them.
 *
 * The light that a surface reflects from it is an integral like that of lmp_shade, clamped at 0
 * separately: add it to what the lights give. An occlusion map attenuates this sum alone. */
typedef struct lmp_environment {
    const float *sh;
    int bands; /* 1 … LMP_BANDS_MAX; those beyond the bands of the settings are not read */
} lmp_environment;

/* Returns the radiance that a surface reflects from an environment, W·sr⁻¹·m⁻². Of the settings
 * only bands and window matter, or those of settings.lobe under LMP_SHADE_PREINTEGRATED. All
 * methods give the same result, because a lobe of n bands takes n² terms whatever the light is,
 * except that LMP_SHADE_COEFFICIENTS alone windows the diffuse lobe. For LMP_MATERIAL_TABLE the
 * first LMP_ENVIRONMENT_TABLE_BANDS bands of the table are read; LMP_MATERIAL_PREINTEGRATED has no
 * table, and reflects nothing.
 *
 * settings may be NULL */
#define LMP_ENVIRONMENT_TABLE_BANDS 16
LMP_API lmp_rgb lmp_shade_environment(const lmp_shade_settings *settings,
                                      const lmp_material *material, const lmp_surface *surface,
                                      const lmp_environment *environment);

/* Shades many surfaces under an environment, as lmp_shade_environment does one, with the same bits
 * for any number of them. Positions are not read; the other arguments are as for lmp_shade_n. */
LMP_API void lmp_shade_environment_n(const lmp_shade_settings *settings,
                                     const lmp_surfaces *surfaces, size_t count,
                                     const lmp_environment *environment, lmp_rgb_array rgb);

#ifdef __cplusplus
}
#endif
#endif
