/* SPDX-License-Identifier: MIT */
/* horizon_tmpl.h - the irradiance of a cap that a surface's horizon cuts, written once and compiled
 * twice, as C of one float and as C of the kernels' lanes (where LMPI_LANES is defined);
 * lampion.glsl has it in GLSL.
 *
 * Of a cap of radiance L and half angle a around an axis at the cosine u to the normal, the
 * irradiance is pi L sin²a f. Above the horizon, u >= sin a, f = u; below it, u <= -sin a, f = 0.
 * Between, the contour integral over the part above the horizon (Lambert's formula for a boundary
 * made of an arc of the cap's circle and one of the horizon) is, with q² = sin²a - u²,
 *
 *     pi f = u atan2(q, -u cos a) + (atan2(q, cos a) - q cos a) / sin²a.
 *
 * Roots and quotients take most of the time, so two of each serve both angles. The first needs
 * neither cases nor relative precision: f(u) = max(u, 0) + f(-|u|), and
 *
 *     atan2(q, w) = pi/4 + atan((q - w) / (q + w)),  w = |u| cos a.
 *
 * The second term cancels for a small cap. In b = atan2(q, cos a) and p² = q² + cos²a = 1 - u², q
 * is p sin b and cos a is p cos b; with b - sin b cos b = g sin³b, where g is smooth,
 *
 *     b - q cos a = q (q² g / p + u² cos a) / p²,
 *
 * whose terms are positive. Its singularity at b = pi makes g a poor polynomial of cos b, but a
 * good one of y = 1 / (1 + cos b) = p / (p + cos a), without a constant, so that g / p = (g / y) /
 * (p + cos a). */
#ifndef LAMPION_KERNELS_HORIZON_TMPL_H
#define LAMPION_KERNELS_HORIZON_TMPL_H

#include "src/base/unroll.h"

#define HORIZON_PER_PI 0.318309886f

/* Returns 1/4 + atan(n) / pi, for -1 <= n <= 1: the odd polynomial that minimizes the largest
 * error, 9e-8, among those that are exact at the ends. */
LMPI_INLINE horizon_float horizon_angle(horizon_float n) {
    const horizon_float n2 = n * n;
    horizon_float sum = 0.0021207465f * n2 - 0.010554982f;
    sum = sum * n2 + 0.025184294f;
    sum = sum * n2 - 0.042036485f;
    sum = sum * n2 + 0.0630279f;
    sum = sum * n2 - 0.10605005f;
    return (sum * n2 + 0.31830856f) * n + 0.25f;
}

/* Returns g / (pi y), for 1/2 <= y <= 1: the polynomial that minimizes the largest error of f,
 * 2e-7. */
LMPI_INLINE horizon_float horizon_g(horizon_float y) {
    horizon_float sum = 0.04378761f - 0.00937415f * y;
    sum = sum * y - 0.09877415f;
    sum = sum * y + 0.2402777f;
    return sum * y + 0.3240828f;
}

/* Returns f where -sin a < u < sin a, given t = 1 - cos a in 0 … 1; elsewhere any number or NaN. */
LMPI_INLINE horizon_float horizon_between(horizon_float u, horizon_float t) {
    const horizon_float v = HORIZON_MAX(u, -u), cosine = 1.0f - t, along = v * cosine;
    const horizon_float sin2 = HORIZON_MAX(t * (2.0f - t), HORIZON_SAME(1e-30f));
    const horizon_float q2 = sin2 - u * u, p2 = q2 + cosine * cosine;
    const horizon_float q = HORIZON_SQRT(q2), p = HORIZON_SQRT(p2);
    const horizon_float angle = horizon_angle((q - along) / (q + along));
    /* 1 / (p² sin²a) and 1 / (p + cos a), by one quotient */
    const horizon_float product = p2 * sin2, sum = p + cosine, both = 1.0f / (product * sum);
    const horizon_float per_product = sum * both, per_sum = product * both;
    const horizon_float second = (q * per_product) * ((q2 * per_sum) * horizon_g(p * per_sum) +
                                                      (v * along) * HORIZON_PER_PI);
    return HORIZON_MAX(u, HORIZON_SAME(0.0f)) + (second - v * angle);
}

#endif
