/* SPDX-License-Identifier: MIT */
/* ggx.h - lmp_lobe_ggx of many surfaces, in planes. */
#ifndef LAMPION_LOBE_GGX_H
#define LAMPION_LOBE_GGX_H

#include <lampion/lobe.h>

/* Surfaces of one call at most. */
#define LMP_GGX_RUN 64

typedef struct lmp_ggx_lobe_planes {
    float *axis[3], *exponent, *f0, *f90;
} lmp_ggx_lobe_planes;

/* Bits are those of lmp_lobe_ggx. */
void lmp_lobe_ggx_n(const float *const normal[3], const float *const view[3],
                    const float *roughness, size_t count,
                    const lmp_ggx_lobe_planes lobes[LMP_GGX_LOBES], float *diffuse_f90);

#endif
