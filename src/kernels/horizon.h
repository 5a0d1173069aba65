/* SPDX-License-Identifier: MIT */
/* horizon.h - horizon_tmpl.h for one float. */
#ifndef LAMPION_KERNELS_HORIZON_H
#define LAMPION_KERNELS_HORIZON_H

#include <math.h>

typedef float horizon_float;
#define HORIZON_SAME(x)   (x)
#define HORIZON_SQRT(x)   sqrtf(x)
#define HORIZON_MAX(a, b) ((a) > (b) ? (a) : (b))

#include "src/kernels/horizon_tmpl.h"

/* Returns f for any u. */
static inline float lmpi_horizon_cosine(float u, float t) {
    if (u * u < t * (2 - t))
        return horizon_between(u, t);
    return u <= 0 ? 0 : u; /* NaN stays */
}

#endif
