/* SPDX-License-Identifier: MIT */
/* spline.h - uniform cubic B-splines: coefficients from values, and the weights of a reading. */
#ifndef LAMPION_PREINTEGRATED_SPLINE_H
#define LAMPION_PREINTEGRATED_SPLINE_H

#include <stddef.h>

/* In place, `count` values become the coefficients of the interpolating cubic B-spline, the series
 * mirrored at both ends (Unser 1999): of `width` series side by side, value k of series j at
 * values[k * width + j]. */
void lmp_spline_coefficients(float *values, size_t count, size_t width);

/* The weights of four neighbors, the point `x` past the second. */
static inline void lmp_spline_weights(float x, float w[4]) {
    const float y = 1 - x;
    w[0] = y * y * y / 6;
    w[1] = (4 + 3 * x * x * (x - 2)) / 6;
    w[2] = (4 + 3 * y * y * (y - 2)) / 6;
    w[3] = x * x * x / 6;
}

#endif
