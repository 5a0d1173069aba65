/* SPDX-License-Identifier: MIT */
/* lampion/lobe.h - circularly symmetric kernels k(q·w) around an axis q, and their response to
 * lights.
 *
 * A kernel is given by its Funk-Hecke factors lambda_l = 2 pi ∫ k(t) P_l(t) dt: its coefficients
 * are lambda_l Y_lm(q). By the addition theorem its integral against a light of zonal coefficients
 * Z_l around w needs n terms instead of n²:
 *
 *     ∫ L(w') k(q·w') dw' = Σ_l Z_l sqrt((2l+1)/4pi) lambda_l P_l(q·w) */
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

/* Coefficients of the lobe round `axis`: lambda_l Y_lm(axis).
 *
 * axis must be unit; sh receives LMP_SH_COUNT(bands) values */
LMP_API void lmp_lobe_project(int bands, const float *lambda, lmp_vec3 axis, float *sh);

/* ∫ L k(axis·w) dw for the sum of the lights, in O(bands) a light.
 *
 * The result is that of the cut series: it may ring below 0, and is not clamped. */
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

#ifdef __cplusplus
}
#endif
#endif
