/* SPDX-License-Identifier: MIT */
/* cone.h - how the light of a cone falls off around its axis. */
#ifndef LAMPION_KERNELS_CONE_H
#define LAMPION_KERNELS_CONE_H

#include "src/kernels/kernels.h"
#include "src/kernels/lanes.h"

/* In the unit directions x, y, z to it. The operations of lmp_cone_falloff (src/light/packed.h),
 * lane by lane. */
LMP_INLINE vf cone_falloff(const lmp_packed_light *cone, vf x, vf y, vf z) {
    const lmp_vec3 a = cone->axis;
    const vf cosine = a.x * -x + a.y * -y + a.z * -z;
    const vf position = (cosine - cone->outer) / vf_set(cone->width);
    const vf held = vf_min(vf_max(position, vf_set(0)), vf_set(1));
    return held * held;
}

#endif
