/* SPDX-License-Identifier: MIT */
/* fade_tmpl.h - the fraction of a light that a field holds (field.h of the API) at a distance from
 * the light's center. */
#ifndef LAMPION_KERNELS_FADE_TMPL_H
#define LAMPION_KERNELS_FADE_TMPL_H

#include "src/kernels/lanes.h"

/* f(d) and its derivative df/dd. */
typedef struct fade_lanes {
    vf value, slope;
} fade_lanes;

LMPI_INLINE fade_lanes fade_at(vf d, float radius, float per_reach) {
    const vf one = vf_set(1), t = vf_min(vf_max((d - radius) * per_reach, vf_set(0)), one);
    const vf u = t * t, rest = one - u;
    return (fade_lanes) { u * u * (6.0f - u * (8.0f - 3.0f * u)),
                          24.0f * per_reach * (t * u) * (rest * rest) };
}

#endif
