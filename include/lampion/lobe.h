/* SPDX-License-Identifier: MIT */
/* lampion/lobe.h - circularly symmetric kernels k(q·w) around an axis q, and their response to
 * lights.
 *
 * A kernel is given by its Funk-Hecke factors lambda_l = 2 pi ∫ k(t) P_l(t) dt: its coefficients
 * are lambda_l Y_lm(q). By the addition theorem its integral against a light of zonal coefficients
 * Z_l around w needs n terms instead of n²:
 *
 *     ∫ L(w') k(q·w') dw' = Σ_l Z_l sqrt((2l+1)/4pi) lambda_l P_l(q·w)
 *
 * In a release build parameters out of range give factors of no meaning (base.h). */
#ifndef LAMPION_LOBE_H
#define LAMPION_LOBE_H

#include <lampion/light.h>

#ifdef __cplusplus
extern "C" {
#endif

/* max(t, 0): the cosine of diffuse reflection (Ramamoorthi and Hanrahan 2001); lambda_0 = pi.
 * lambda receives `bands` values, here and below. */
LMP_API void lmp_lobe_diffuse(int bands, float *lambda);

/* (e+1)/(2 pi) max(t, 0)^e, Phong's lobe scaled to integrate to 1; any finite e >= 0. */
LMP_API void lmp_lobe_phong(int bands, float exponent, float *lambda);

/* von Mises-Fisher: k/(2 pi (1 - exp(-2k))) exp(k (t - 1)); concentration k > 0. */
LMP_API void lmp_lobe_vmf(int bands, float concentration, float *lambda);

/* Coefficients of the lobe around `axis`: lambda_l Y_lm(axis).
 *
 * axis must be unit; sh receives LMP_SH_COUNT(bands) values */
LMP_API void lmp_lobe_project(int bands, const float *lambda, lmp_vec3 axis, float *sh);

/* ∫ L k(axis·w) dw for the sum of the lights, in O(bands) a light.
 *
 * The result is that of the truncated series: it may ring below 0, and is not clamped. */
LMP_API lmp_rgb lmp_lobe_response(int bands, const float *lambda, lmp_vec3 axis,
                                  const lmp_light *lights, size_t count, lmp_vec3 point);

/* lmp_lobe_response of the same spheres and lobe at many points, each with an axis of its own: 3
 * values an element, red, green, blue (rows of stride 3 are an array of lmp_rgb). See sh.h,
 * batches.
 */
LMP_API void lmp_lobe_response_n(int bands, const float *lambda, lmp_vec3_array axes,
                                 const lmp_spheres *spheres, size_t sphere_count,
                                 lmp_vec3_array points, size_t point_count, lmp_sh_layout layout,
                                 size_t stride, float *response);

/* --- glTF's GGX ----------------------------------------------------------------------------------
 * The specular reflection of glTF 2.0's metallic-roughness (appendix B: GGX, Smith's
 * height-correlated masking, Schlick's Fresnel term), f_r cos seen from one direction, as a sum of
 * Phong lobes fitted by least squares (src/lobe/generate/ggx.c):
 *
 *     f_r(v, w) (n·w) ~ Σ_k (f0_k F0 + f90_k F90) (e_k+1)/(2 pi) max(axis_k·w, 0)^e_k
 *
 * F0 and F90 are Fresnel's reflectances at normal incidence and at grazing, F = F0 (1-c) + F90 c
 * with c = (1 - v·h)^5; glTF's core has F90 = 1. Its diffuse part, (1 - F) base/pi, is in all
 * directions the fraction 1 - diffuse_f0 F0 - diffuse_f90 F90 of base/pi.
 *
 * The lobes from LMP_GGX_LOBES_FEW on have weight 0 but toward grazing views, from 53 degrees on,
 * of rough surfaces from 41. Lobes reach a little below the horizon: docs/ggx.md has the errors. */
#define LMP_GGX_LOBES     5
#define LMP_GGX_LOBES_FEW 3

typedef struct lmp_ggx_lobe {
    lmp_vec3 axis;  /* unit, in the plane of incidence */
    float exponent; /* 0.02 … 1.1e8 */
    float f0, f90;  /* -5 … 5: some lobes take from others */
} lmp_ggx_lobe;

typedef struct lmp_ggx_lobes {
    lmp_ggx_lobe lobe[LMP_GGX_LOBES];
    float diffuse_f0, diffuse_f90; /* they sum to 1 */
} lmp_ggx_lobes;

/* normal and view must be unit; a view below the horizon counts as grazing. roughness is glTF's
 * perceptual one, alpha = roughness², clamped to sqrt(0.001) … 1 */
LMP_API void lmp_lobe_ggx(lmp_vec3 normal, lmp_vec3 view, float roughness, lmp_ggx_lobes *lobes);

#define LMP_GGX_TEXELS (32 * 32 * LMP_GGX_LOBES + 32)

/* The table of these lobes, which ggx.glsl looks up: LMP_GGX_TEXELS texels of 4 values, 82 KB. */
LMP_API void lmp_lobe_ggx_texels(float *texels);

#ifdef __cplusplus
}
#endif
#endif
