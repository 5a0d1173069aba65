/* SPDX-License-Identifier: MIT */
/* horizon.h - what a cap gives a surface whose horizon cuts it: written once and compiled twice, as
 * C of one float and as C of the kernels' lanes (where LMP_LANES is defined); lampion.glsl has it
 * in GLSL.
 *
 * Of a cap of radiance L and half angle a around an axis at the cosine u to the normal, the
 * irradiance is pi L sin²a f. Above the horizon, u >= sin a, f = u; below it, u <= -sin a, f = 0.
 * Between, the contour integral over the part above the horizon (Lambert's formula for a boundary
 * made of an arc of the cap's circle and one of the horizon) is, with q² = sin²a - u²,
 *
 *     pi f = u atan2(q, -u cos a) + (atan2(q, cos a) - q cos a) / sin²a.
 *
 * Of a small cap the second term cancels: as the arctangent of m is m - m³ B(m²), and m = q / cos a
 * makes m - q cos a = m sin²a, the term is m (1 - m² B / sin²a), whose digits all count. */
#ifndef LAMPION_KERNELS_HORIZON_H
#define LAMPION_KERNELS_HORIZON_H

#include "src/base/unroll.h"

#define HORIZON_HALF_PI 1.57079633f
#define HORIZON_PER_PI  0.318309886f

#ifdef LMP_LANES
#include "src/kernels/lanes.h"
typedef vf horizon_float;
#define HORIZON_SAME(x)          vf_set(x)
#define HORIZON_SQRT(x)          vf_sqrt(x)
#define HORIZON_MAX(a, b)        vf_max(a, b)
#define HORIZON_LESS(a, b, x, y) vf_select_less(a, b, x, y)
#else
#include <math.h>
typedef float horizon_float;
#define HORIZON_SAME(x)          (x)
#define HORIZON_SQRT(x)          sqrtf(x)
#define HORIZON_MAX(a, b)        ((a) > (b) ? (a) : (b))
#define HORIZON_LESS(a, b, x, y) ((a) < (b) ? (x) : (y))
#endif

/* B of 0 <= m² <= 1: the polynomial that makes the least of the largest error of m B, 2e-7. */
LMP_INLINE horizon_float lmp_horizon_b(horizon_float m2) {
    horizon_float b = 0.00563867157f * m2 - 0.0275278129f;
    b = b * m2 + 0.0639356673f;
    b = b * m2 - 0.102131978f;
    b = b * m2 + 0.141221911f;
    b = b * m2 - 0.199864447f;
    return b * m2 + 0.333330035f;
}

/* The smaller of two numbers over the larger one; neither is negative. */
LMP_INLINE horizon_float lmp_horizon_ratio(horizon_float a, horizon_float b) {
    const horizon_float larger = HORIZON_LESS(a, b, b, a), smaller = HORIZON_LESS(a, b, a, b);
    return smaller / HORIZON_MAX(larger, HORIZON_SAME(1e-30f));
}

/* f where -sin a < u < sin a; t = 1 - cos a, 0 … 1. Elsewhere it is some finite number. */
LMP_INLINE horizon_float lmp_horizon_between(horizon_float u, horizon_float t) {
    const horizon_float zero = HORIZON_SAME(0.0f), half_pi = HORIZON_SAME(HORIZON_HALF_PI);
    const horizon_float cosine = 1.0f - t, sin2 = HORIZON_MAX(t * (2.0f - t), HORIZON_SAME(1e-30f));
    const horizon_float q = HORIZON_SQRT(HORIZON_MAX(sin2 - u * u, zero));
    /* atan2(q, -u cos a), as pi/2 and what it is more */
    const horizon_float along = HORIZON_MAX(u, -u) * cosine;
    const horizon_float n = lmp_horizon_ratio(along, q), n2 = n * n;
    const horizon_float arc = n - n * n2 * lmp_horizon_b(n2);
    const horizon_float more = HORIZON_LESS(q, along, half_pi - arc, arc);
    const horizon_float around = half_pi + HORIZON_LESS(u, zero, -more, more);
    /* the second term, where m is at most 1 and where it is more */
    const horizon_float m = lmp_horizon_ratio(q, cosine), m2 = m * m, b = lmp_horizon_b(m2);
    const horizon_float per_sin2 = 1.0f / sin2, small = m - m * ((m2 * per_sin2) * b);
    const horizon_float large = ((half_pi - (m - m * m2 * b)) - q * cosine) * per_sin2;
    return (u * around + HORIZON_LESS(cosine, q, large, small)) * HORIZON_PER_PI;
}

#ifndef LMP_LANES
/* f of any u. */
static inline float lmp_horizon_cosine(float u, float t) {
    if (u * u < t * (2 - t))
        return lmp_horizon_between(u, t);
    return u <= 0 ? 0 : u; /* NaN stays */
}
#endif

#endif
