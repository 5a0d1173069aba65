/* SPDX-License-Identifier: MIT */
/* ggx.h - lmp_lobe_ggx of many surfaces, in planes. */
#ifndef LAMPION_LOBE_GGX_H
#define LAMPION_LOBE_GGX_H

#include "src/kernels/kernels.h"
#include "src/lobe/ggx_table.h"

#include <math.h>

/* The first `lobe_count` lobes of surfaces in planes, as kernels take them; bits are those of
 * lmp_lobe_ggx. */
void lmp_lobe_ggx_n(const lmp_kernel_vec3 *normal, const lmp_kernel_vec3 *view,
                    const float *roughness, size_t count, int lobe_count,
                    const lmp_kernel_ggx_lobe *lobes, float *diffuse_f90);

/* NaN counts as `least`. */
static inline float lmp_ggx_clamped(float x, float least, float most) {
    const float raised = x > least ? x : least;
    return raised < most ? raised : most;
}

/* Where the table has a roughness and a cosine that are in its range. */
static inline float lmp_ggx_row(float rough) {
    const float least = LMP_GGX_ROUGHNESS_MIN, rows = LMP_GGX_ROUGHNESSES - 1;
    return (rough - least) / (1 - least) * rows;
}

static inline float lmp_ggx_column(float cosine) {
    return sqrtf(cosine) * (LMP_GGX_VIEWS - 1);
}

/* LMP_GGX_LOBES_FEW where the lobes after these have weight 0, else LMP_GGX_LOBES; `along` is the
 * cosine of normal and view. Without branches, which views in no order would mislead. */
static inline int lmp_lobe_ggx_count(float along, float roughness) {
    const float x = lmp_ggx_column(lmp_ggx_clamped(along, 0, 1));
    const float y = lmp_ggx_row(lmp_ggx_clamped(roughness, LMP_GGX_ROUGHNESS_MIN, 1));
    const int row = (int)lmp_ggx_clamped(y, 0, LMP_GGX_ROUGHNESSES - 2);
    const int few = (x >= lmp_ggx_few[row]) & (x >= lmp_ggx_few[row + 1]);
    return LMP_GGX_LOBES - few * (LMP_GGX_LOBES - LMP_GGX_LOBES_FEW);
}

#endif
