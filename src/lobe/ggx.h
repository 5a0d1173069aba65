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

/* The first `lobe_count` lobes of LMP_GGX_RUN surfaces at most; bits are those of lmp_lobe_ggx. */
void lmp_lobe_ggx_n(const float *const normal[3], const float *const view[3],
                    const float *roughness, size_t count, int lobe_count,
                    const lmp_ggx_lobe_planes *lobes, float *diffuse_f90);

/* LMP_GGX_LOBES_FEW where the lobes after these have weight 0, else LMP_GGX_LOBES; `along` is the
 * cosine of normal and view. */
int lmp_lobe_ggx_count(float along, float roughness);

#endif
