/* SPDX-License-Identifier: MIT */
/* horizon_lanes_tmpl.h - horizon_tmpl.h for lanes. */
#ifndef LAMPION_KERNELS_HORIZON_LANES_TMPL_H
#define LAMPION_KERNELS_HORIZON_LANES_TMPL_H

#include "src/kernels/lanes.h"

typedef vf horizon_float;
#define HORIZON_SAME(x)   vf_set(x)
#define HORIZON_SQRT(x)   vf_sqrt(x)
#define HORIZON_MAX(a, b) vf_max(a, b)

#include "src/kernels/horizon_tmpl.h"

#endif
