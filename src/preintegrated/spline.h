/* SPDX-License-Identifier: MIT */
/* spline.h - uniform cubic B-splines: coefficients from values, and the weights of a reading. */
#ifndef LAMPION_PREINTEGRATED_SPLINE_H
#define LAMPION_PREINTEGRATED_SPLINE_H

#include "shaders/lampion/preintegrated_lookup.h"

#include <stddef.h>

/* Replaces `count` values by the coefficients of the interpolating cubic B-spline, with the series
 * mirrored at both ends (Unser 1999), for `width` series side by side: value k of series j is at
 * values[k * width + j]. */
void lmpi_spline_coefficients(float *values, size_t count, size_t width);

/* Computes the weights of four neighbors, for a point `x` past the second. */
static inline void lmpi_spline_weights(float x, float w[4]) {
    w[0] = lmp_lookup_outer(1 - x) / 6;
    w[1] = lmp_lookup_inner(x) / 6;
    w[2] = lmp_lookup_inner(1 - x) / 6;
    w[3] = lmp_lookup_outer(x) / 6;
}

#endif
