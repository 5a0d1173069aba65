/* SPDX-License-Identifier: MIT */
/* lampion/lobe.h - circularly symmetric kernels k(q·w) around an axis q, and their response to
 * lights.
 *
 * A kernel is given by its Funk-Hecke factors lambda_l = 2 pi ∫ k(t) P_l(t) dt: its coefficients
 * are lambda_l Y_lm(q). By the addition theorem its integral against a light with zonal
 * coefficients Z_l around w takes n terms instead of n²:
 *
 *     ∫ L(w') k(q·w') dw' = Σ_l Z_l sqrt((2l+1)/4pi) lambda_l P_l(q·w)
 *
 * In a release build, parameters out of range give meaningless factors (base.h). */
#ifndef LAMPION_LOBE_H
#define LAMPION_LOBE_H

#include <lampion/light.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Computes the factors of max(t, 0), the cosine of diffuse reflection (Ramamoorthi and Hanrahan
 * 2001), whose lambda_0 is pi. lambda receives `bands` values. */
LMP_API void lmp_lobe_make_diffuse(int bands, float *lambda);

/* Computes the `bands` factors of the Phong lobe (e+1)/(2 pi) max(t, 0)^e, whose integral is 1, for
 * any exponent e >= 0. */
LMP_API void lmp_lobe_make_phong(int bands, float exponent, float *lambda);

/* Computes the `bands` factors of the von Mises-Fisher lobe k/(2 pi (1 - exp(-2k))) exp(k (t - 1)),
 * whose integral is 1, for any concentration k > 0. */
LMP_API void lmp_lobe_make_vmf(int bands, float concentration, float *lambda);

/* Projects the lobe around `axis` onto coefficients lambda_l Y_lm(axis).
 *
 * axis must be unit; sh receives LMP_SH_COUNT(bands) values */
LMP_API void lmp_lobe_project(int bands, const float *lambda, lmp_vec3 axis, float *sh);

/* Computes ∫ L k(axis·w) dw for the sum of the lights, in O(bands) per light.
 *
 * The series is truncated, so the result may ring below 0; it is not clamped. */
LMP_API lmp_rgb lmp_lobe_response(int bands, const float *lambda, lmp_vec3 axis,
                                  const lmp_light *lights, size_t count, lmp_vec3 point);

/* Computes the responses of a lobe to the same spheres at many points, each with its own axis, as
 * lmp_lobe_response does at one. rgb receives one color per point. */
LMP_API void lmp_lobe_response_n(int bands, const float *lambda, lmp_vec3_array axes,
                                 const lmp_spheres *spheres, size_t sphere_count,
                                 lmp_vec3_array points, size_t point_count, lmp_rgb_array rgb);

/* --- glTF's GGX ----------------------------------------------------------------------------------
 * The specular reflection of glTF 2.0's metallic-roughness (appendix B: GGX, Smith's
 * height-correlated masking, Schlick's Fresnel term), f_r cos as seen from one direction, is
 * approximated by a sum of Phong lobes, fitted by least squares (src/lobe/generate/ggx.c):
 *
 *     f_r(v, w) (n·w) ~ Σ_k (f0_k F0 + f90_k F90) (e_k+1)/(2 pi) max(axis_k·w, 0)^e_k
 *
 * F0 and F90 are the Fresnel reflectances at normal incidence and at grazing angles, F = F0 (1-c) +
 * F90 c with c = (1 - v·h)^5; in glTF's core F90 = 1. The diffuse part, (1 - F) base/pi, is
 * approximated in all directions by the fraction 1 - diffuse_f0 F0 - diffuse_f90 F90 of base/pi.
 *
 * The lobes from index LMP_GGX_LOBES_FEW on have weight 0 except at grazing views: from 53 degrees
 * on, or from 41 on rough surfaces. Lobes reach a little below the horizon: docs/ggx.md gives the
 * errors. */
#define LMP_GGX_LOBES     5
#define LMP_GGX_LOBES_FEW 3

typedef struct lmp_ggx_lobe {
    lmp_vec3 axis;  /* unit, in the plane of incidence */
    float exponent; /* 0.02 … 1.1e8 */
    float f0, f90;  /* -5 … 5: a negative weight subtracts from other lobes */
} lmp_ggx_lobe;

typedef struct lmp_ggx_lobes {
    lmp_ggx_lobe lobe[LMP_GGX_LOBES];
    float diffuse_f0, diffuse_f90; /* they sum to 1 */
} lmp_ggx_lobes;

/* Finds the lobes of a surface; normal and view must be unit, and a view below the horizon counts
 * as grazing. roughness is glTF's, alpha = roughness², and is clamped to sqrt(0.001) … 1. */
LMP_API void lmp_lobe_find_ggx(lmp_vec3 normal, lmp_vec3 view, float roughness,
                               lmp_ggx_lobes *lobes);

#define LMP_GGX_TEXELS (32 * 32 * LMP_GGX_LOBES + 32)

/* Copies the table of GGX lobes that ggx.glsl reads: LMP_GGX_TEXELS texels of 4 values, 82 KB. */
LMP_EXPERIMENTAL LMP_API void lmp_lobe_copy_ggx_texels(float *texels);

#ifdef __cplusplus
}
#endif
#endif
