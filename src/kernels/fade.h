/* SPDX-License-Identifier: MIT */
/* fade.h - how much of a light is in a field (field.h of the API) at a distance from its center. */
#ifndef LAMPION_KERNELS_FADE_H
#define LAMPION_KERNELS_FADE_H

#include "src/kernels/lanes.h"

/* f(d), and df/dd. */
typedef struct fade_lanes {
    vf value, slope;
} fade_lanes;

LMP_INLINE fade_lanes fade_at(vf d, float radius, float per_reach) {
    const vf one = vf_set(1), t = vf_min(vf_max((d - radius) * per_reach, vf_set(0)), one);
    const vf u = t * t, rest = one - u;
    return (fade_lanes) { u * u * (6.0f - u * (8.0f - 3.0f * u)),
                          24.0f * per_reach * (t * u) * (rest * rest) };
}

#endif
