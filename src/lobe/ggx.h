/* SPDX-License-Identifier: MIT */
/* ggx.h - lmp_lobe_find_ggx of many surfaces, in planes. */
#ifndef LAMPION_LOBE_GGX_H
#define LAMPION_LOBE_GGX_H

#include "src/kernels/lobe.h"
#include "src/lobe/ggx_table.h"

#include <math.h>

/* Finds the first `lobe_count` lobes of surfaces in planes, as kernels take them, with the bits of
 * lmp_lobe_find_ggx. */
void lmpi_lobe_ggx_n(const lmpi_kernel_vec3 *normal, const lmpi_kernel_vec3 *view,
                     const float *roughness, size_t count, int lobe_count,
                     const lmpi_kernel_ggx_lobe *lobes, float *diffuse_f90);

/* Clamps x to least … most; NaN becomes `least`. */
static inline float lmpi_ggx_clamped(float x, float least, float most) {
    const float raised = x > least ? x : least;
    return raised < most ? raised : most;
}

/* Find the position in the table of a roughness and of a cosine that are in range. */
static inline float lmpi_ggx_row(float rough) {
    const float least = LMPI_GGX_ROUGHNESS_MIN, rows = LMPI_GGX_ROUGHNESSES - 1;
    return (rough - least) / (1 - least) * rows;
}

static inline float lmpi_ggx_column(float cosine) {
    return sqrtf(cosine) * (LMPI_GGX_VIEWS - 1);
}

/* Returns LMP_GGX_LOBES_FEW where the lobes after these have weight 0, else LMP_GGX_LOBES; `along`
 * is the cosine of normal and view. Without branches, which views in random order would mispredict.
 */
static inline int lmpi_lobe_ggx_count(float along, float roughness) {
    const float x = lmpi_ggx_column(lmpi_ggx_clamped(along, 0, 1));
    const float y = lmpi_ggx_row(lmpi_ggx_clamped(roughness, LMPI_GGX_ROUGHNESS_MIN, 1));
    const int row = (int)lmpi_ggx_clamped(y, 0, LMPI_GGX_ROUGHNESSES - 2);
    const int few = (x >= lmpi_ggx_few[row]) & (x >= lmpi_ggx_few[row + 1]);
    return LMP_GGX_LOBES - few * (LMP_GGX_LOBES - LMP_GGX_LOBES_FEW);
}

#endif
