/* SPDX-License-Identifier: MIT */
/* response.h - the addition theorem: a lobe's response to a cap in one sum over l. */
#ifndef LAMPION_LOBE_RESPONSE_H
#define LAMPION_LOBE_RESPONSE_H

#include "src/light/seen.h"

#include <lampion/lobe.h>

/* Computes weights[l] = (2l+1) lambda_l / (4 pi). */
void lmpi_lobe_weights(int bands, const float *lambda, float *weights);

/* Returns Σ_l weights[l] r[l] P_l(q·w), with r the polynomials of the cap (src/light/cap.h). */
float lmpi_lobe_sum(int bands, const float *weights, const float *r, lmp_vec3 q, lmp_vec3 w);

/* Adds the response of a lobe to a cap, given `response` for strength 1. */
void lmpi_lobe_add(const lmp_cap *cap, float response, float lambda_0, lmp_rgb *sum);

/* Adds the response of a lobe around q to what is seen of a light. r must hold the polynomials of
 * the cap, unless a loop is seen; lambda_0 is the lobe's. */
void lmpi_lobe_add_seen(int bands, const float *weights, float lambda_0, const float *r, lmp_vec3 q,
                        const lmpi_seen *seen, lmp_rgb *sum);

#endif
