/* SPDX-License-Identifier: MIT */
/* turn.h - directions around an axis. */
#ifndef LAMPION_RENDER_SHADOW_TURN_H
#define LAMPION_RENDER_SHADOW_TURN_H

#include "app/scene/vector.h"

/* Computes sine and cosine of a fraction of a circle, 0 … 1, within 4e-7: by their series within an
 * eighth of a circle of the nearest quarter. */
static inline void shadow_sine_cosine(float part, float *sine, float *cosine) {
    const int quarter = (int)(4 * part + 0.5f);
    const float x = (4 * part - (float)quarter) * (PI / 2), x2 = x * x;
    const float s = x * (1 - x2 / 6 * (1 - x2 / 20 * (1 - x2 / 42)));
    const float c = 1 - x2 / 2 * (1 - x2 / 12 * (1 - x2 / 30 * (1 - x2 / 56)));
    const float up = quarter & 1 ? c : s, right = quarter & 1 ? s : c;
    *sine = quarter & 2 ? -up : up;
    *cosine = (quarter + 1) & 2 ? -right : right;
}

/* Returns a unit direction off a unit axis by 1 - cosine t, and by the fraction v of a circle
 * around it, in an orthonormal basis without branches at the poles (Duff et al. 2017). */
static inline lmp_vec3 shadow_leave(lmp_vec3 axis, float t, float v) {
    const float x = axis.x, y = axis.y, z = axis.z, off = sqrtf(t * (2 - t));
    const float sign = copysignf(1, z), a = -1 / (sign + z), b = x * y * a;
    float sine, cosine;
    shadow_sine_cosine(v, &sine, &cosine);
    const float across = off * cosine, along = off * sine;
    return vec(x * (1 - t) + (1 + sign * x * x * a) * across + b * along,
               y * (1 - t) + sign * b * across + (sign + y * y * a) * along,
               z * (1 - t) - sign * x * across - y * along);
}

#endif
