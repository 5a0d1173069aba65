/* SPDX-License-Identifier: MIT */
/* response.h - the addition theorem: a lobe's response to a cap in one sum over l. */
#ifndef LAMPION_LOBE_RESPONSE_H
#define LAMPION_LOBE_RESPONSE_H

#include <lampion/lobe.h>

/* weights[l] = (2l+1) lambda_l / (4 pi). */
void lmp_lobe_weights(int bands, const float *lambda, float *weights);

/* Σ_l weights[l] r[l] P_l(q·w), r the polynomials of the cap (src/light/cap.h). */
float lmp_lobe_sum(int bands, const float *weights, const float *r, lmp_vec3 q, lmp_vec3 w);

/* Adds the response of a lobe to a cap, `response` that for strength 1. */
void lmp_lobe_add(const lmp_cap *cap, float response, float lambda_0, lmp_rgb *sum);

#endif
