/* SPDX-License-Identifier: MIT */
/* lampion/shade.h - the radiance a surface reflects to the viewer under many lights.
 *
 * Every shading method computes the same sum, of two lobes a material (paper §4.1):
 *
 *     L_o = diffuse/pi ∫ L(w) max(n·w, 0) dw  +  specular (e+1)/(2 pi) ∫ L(w) max(r·w, 0)^e dw
 *
 * n the normal, r = 2 (n·v) n - v the mirror direction of the view v. Both lobes are cut to `bands`
 * bands and windowed, the light is not. The sum of both lobes over all lights is then clamped at 0,
 * channel by channel, for a cut series rings. No visibility. */
#ifndef LAMPION_SHADE_H
#define LAMPION_SHADE_H

#include <lampion/brdf.h>
#include <lampion/preintegrated.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The paper's two lobes. */
typedef struct lmp_material {
    lmp_rgb diffuse;                        /* albedo of the diffuse lobe */
    lmp_rgb specular;                       /* reflectance of the Phong lobe */
    float exponent;                         /* of the Phong lobe, finite, >= 0 */
    const lmp_brdf_table *table;            /* instead of the lobes, or NULL; see lmp_shade_table */
    const lmp_preintegrated_brdf *response; /* the same, for lmp_shade_preintegrated: a material
                                          that no other function shades needs no table; or NULL */
} lmp_material;

/* glTF's metallic-roughness as two lobes: diffuse = base (1 - metallic), specular = Schlick's F0 =
 * mix(0.04, base, metallic), exponent = 2/α² - 2 with α = roughness², held to LMP_ALPHA_MIN and up.
 *
 * metallic and roughness are clamped to 0 … 1 */
#define LMP_ALPHA_MIN 0.01f
LMP_API lmp_material lmp_material_from_metallic_roughness(lmp_rgb base, float metallic,
                                                          float roughness);

/* How to cut the lobes; zero-initialized: 10 bands, no window. */
typedef struct lmp_shade_settings {
    int bands; /* 1 … LMP_BANDS_MAX, 0 means LMP_SHADE_BANDS_DEFAULT */
    lmp_window window;
    float window_size; /* as in lmp_sh_window */
} lmp_shade_settings;
#define LMP_SHADE_BANDS_DEFAULT 10

/* A shaded point. */
typedef struct lmp_surface {
    lmp_vec3 position;
    lmp_vec3 normal; /* unit */
    lmp_vec3 view;   /* unit, to the viewer */
} lmp_surface;

/* --- one surface ---------------------------------------------------------------------------------
 * Each call prepares the material anew: for many surfaces the functions that end in _n take less
 * time a light.
 *
 * settings may be NULL (defaults); count may be 0 */

/* Reflected radiance, W·sr⁻¹·m⁻²: the meaning that every method and device is held to. */
LMP_API lmp_rgb lmp_shade(const lmp_shade_settings *settings, const lmp_material *material,
                          const lmp_surface *surface, const lmp_light *lights, size_t count);

/* The two methods for lobes. `coefficients` is the paper's: all the lights' n² coefficients summed,
 * then a dot product with the material's; it needs 200 KB of stack. `zonal` uses the addition
 * theorem: O(n) a light. They differ by rounding; lmp_shade is `zonal`. */
LMP_API lmp_rgb lmp_shade_coefficients(const lmp_shade_settings *settings,
                                       const lmp_material *material, const lmp_surface *surface,
                                       const lmp_light *lights, size_t count);
LMP_API lmp_rgb lmp_shade_zonal(const lmp_shade_settings *settings, const lmp_material *material,
                                const lmp_surface *surface, const lmp_light *lights, size_t count);

/* Radiance reflected by a tabulated BRDF (brdf.h), with the bands and the window of the table: the
 * lights are moved to the view's frame, so that no coefficients are rotated (Kautz et al. 2002).
 * Every method above calls it for a material with a table, with tangent zero. Clamped at 0; 400 KB
 * of stack.
 *
 * tangent is the material's x axis, of any length and at any angle to the normal but 0: an
 * anisotropic table needs it. Zero means the horizontal one, y up x normal */
LMP_API lmp_rgb lmp_shade_table(const lmp_brdf_table *table, const lmp_surface *surface,
                                lmp_vec3 tangent, const lmp_light *lights, size_t count);

/* The same from the table's response, within its error: no sum over bands, 100 KB of stack. An
 * isotropic material needs no tangent. */
LMP_API lmp_rgb lmp_shade_table_preintegrated(const lmp_preintegrated_brdf *response,
                                              const lmp_surface *surface, const lmp_light *lights,
                                              size_t count);

/* lmp_shade from a response of the same bands and window, within the response's error: its cost
 * does not depend on the bands. It is lmp_shade_preintegrated_n of one surface. A material with a
 * response of its own is read from that, one with a table alone is summed by bands.
 *
 * response may be NULL if the material has a table or its own */
LMP_API lmp_rgb lmp_shade_preintegrated(const lmp_preintegrated_lobe *response,
                                        const lmp_material *material, const lmp_surface *surface,
                                        const lmp_light *lights, size_t count);

/* --- many surfaces -------------------------------------------------------------------------------
 * Vectorized over the surfaces, with the same bits on every instruction set. Split the surfaces
 * among your threads.
 *
 * lmp_shade_n differs from lmp_shade by rounding, at n bands up to 3e-6 + 2e-7 n² of a light's
 * peak (what it gives where the lobes point at it), which counts where a sharp lobe points at a
 * small light. Two limits besides, of both functions:
 *   - A cap, sky or sphere that covers about a hemisphere: up to 5e-4, for cos a comes from sin a.
 *   - A point or spot light is a sphere of radius LMP_POINT_DISTANCE_MIN: no other from d = 2e-3 to
 *     1e13, but nearer by its highlight loses (1e-6 n / d)² / 15 (of 128 bands 0.1 % at 1e-3, 9 %
 *     at 1e-4). Its intensity is at most 1e26.
 * Positions: light.h, batches. */

/* Members of lmp_surface and lmp_material, wherever they are (base.h); x, y, z of the two
 * reflectances are red, green, blue.
 *
 * Pointers are read at `table_stride` and `response_stride` bytes from one surface to the next; 0
 * means the same for all. A surface with neither table nor response has lobes; of others
 * reflectances and exponent are not read; the tangent of an anisotropic one is zero
 * (lmp_shade_table) */
typedef struct lmp_surfaces {
    lmp_vec3_array position, normal, view;
    lmp_vec3_array diffuse, specular;
    lmp_float_array exponent;           /* finite, >= 0 */
    const lmp_brdf_table *const *table; /* of the first surface; NULL: all have lobes */
    size_t table_stride;
    const lmp_preintegrated_brdf *const *response; /* of the first surface, or NULL; read by
                                                 lmp_shade_preintegrated_n alone, which then reads
                                                 no table. Surfaces with a table but no response go
                                                 one by one */
    size_t response_stride;
} lmp_surfaces;

/* Reflected radiance of `count` surfaces under the sum of the lights.
 *
 * settings may be NULL (defaults); response must not. rgb_stride is the number of floats from one
 * surface's red to the next one's, 3 and up; 0 means 3. rgb must not overlap what is read */
LMP_API void lmp_shade_n(const lmp_shade_settings *settings, const lmp_surfaces *surfaces,
                         size_t count, const lmp_light *lights, size_t light_count,
                         size_t rgb_stride, float *rgb);
LMP_API void lmp_shade_preintegrated_n(const lmp_preintegrated_lobe *response,
                                       const lmp_surfaces *surfaces, size_t count,
                                       const lmp_light *lights, size_t light_count,
                                       size_t rgb_stride, float *rgb);

#ifdef __cplusplus
}
#endif
#endif
