/* SPDX-License-Identifier: MIT */
/* cone_tmpl.h - how the light of a cone falls off around its axis. */
#ifndef LAMPION_KERNELS_CONE_TMPL_H
#define LAMPION_KERNELS_CONE_TMPL_H

#include "src/kernels/lanes.h"
#include "src/kernels/packed_light.h"

/* Returns the falloff of a cone's light toward the unit directions x, y, z to it, by the operations
 * of lmpi_cone_falloff (src/light/packed.h), lane by lane. */
LMPI_INLINE vf cone_falloff(const lmpi_packed_light *cone, vf x, vf y, vf z) {
    const lmp_vec3 a = cone->axis;
    const vf cosine = a.x * -x + a.y * -y + a.z * -z;
    const vf position = (cosine - cone->outer) / vf_set(cone->width);
    const vf held = vf_min(vf_max(position, vf_set(0)), vf_set(1));
    return held * held;
}

#endif
