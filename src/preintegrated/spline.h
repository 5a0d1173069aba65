/* SPDX-License-Identifier: MIT */
/* spline.h - uniform cubic B-splines: coefficients from values, and the weights of a reading. */
#ifndef LAMPION_PREINTEGRATED_SPLINE_H
#define LAMPION_PREINTEGRATED_SPLINE_H

#include "shaders/preintegrated_lookup.h"

#include <stddef.h>

/* In place, `count` values become the coefficients of the interpolating cubic B-spline, the series
 * mirrored at both ends (Unser 1999): of `width` series side by side, value k of series j at
 * values[k * width + j]. */
void lmp_spline_coefficients(float *values, size_t count, size_t width);

/* The weights of four neighbors, the point `x` past the second. */
static inline void lmp_spline_weights(float x, float w[4]) {
    w[0] = lmp_lookup_outer(1 - x) / 6;
    w[1] = lmp_lookup_inner(x) / 6;
    w[2] = lmp_lookup_inner(1 - x) / 6;
    w[3] = lmp_lookup_outer(x) / 6;
}

#endif
