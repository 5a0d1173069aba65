/* SPDX-License-Identifier: MIT */
/* ggx_table.h - glTF's GGX as Phong lobes, by roughness and view angle. ggx_table.c is written by
 * generate/ggx.c.
 *
 * Row i belongs to the roughness r that divides LMP_GGX_ROUGHNESS_MIN … 1 evenly, alpha = r²;
 * column k to the view whose cosine c with the normal has the root k / (LMP_GGX_VIEWS - 1). */
#ifndef LAMPION_LOBE_GGX_TABLE_H
#define LAMPION_LOBE_GGX_TABLE_H

#include <lampion/lobe.h>

#define LMP_GGX_VIEWS         32
#define LMP_GGX_ROUGHNESSES   32
#define LMP_GGX_ROUGHNESS_MIN 0.0316227766f /* alpha 0.001 */

/* Of a lobe, so scaled that mirrors are no special case:
 *   [0] (height - c) / alpha: the axis is as the mirror direction, but of this height over the
 *       surface before it is made unit
 *   [1] 1 / (exponent alpha²)
 *   [2] its weight of Fresnel's F0
 *   [3] its weight of F90 - F0 */
extern const float lmp_ggx_table[LMP_GGX_ROUGHNESSES][LMP_GGX_VIEWS][LMP_GGX_LOBES][4];

/* The column of a row from which the lobes from LMP_GGX_LOBES_FEW on have weight 0. */
extern const float lmp_ggx_few[LMP_GGX_ROUGHNESSES];

/* ∫ (1 - v·h)^5 cos / pi: what a diffuse surface loses of F90 - F0. */
extern const float lmp_ggx_diffuse[LMP_GGX_VIEWS];

#endif
