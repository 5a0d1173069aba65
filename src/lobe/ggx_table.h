/* SPDX-License-Identifier: MIT */
/* ggx_table.h - glTF's GGX as Phong lobes, by roughness and view angle. ggx_table.c is written by
 * generate/ggx.c.
 *
 * Row i belongs to the roughness r that divides LMPI_GGX_ROUGHNESS_MIN … 1 evenly, alpha = r²;
 * column k to the view whose cosine c with the normal has the root k / (LMPI_GGX_VIEWS - 1). */
#ifndef LAMPION_LOBE_GGX_TABLE_H
#define LAMPION_LOBE_GGX_TABLE_H

#include <lampion/lobe.h>

#define LMPI_GGX_VIEWS         32
#define LMPI_GGX_ROUGHNESSES   32
#define LMPI_GGX_ROUGHNESS_MIN 0.0316227766f /* alpha 0.001 */

/* The parameters of each lobe, scaled so that mirrors are no special case:
 *   [0]  (height - c) / alpha: the axis is the mirror direction with this height over the surface,
 *        before it is made unit
 *   [1]  1 / (exponent alpha²)
 *   [2]  the weight of Fresnel's F0
 *   [3]  the weight of F90 - F0 */
extern const float lmpi_ggx_table[LMPI_GGX_ROUGHNESSES][LMPI_GGX_VIEWS][LMP_GGX_LOBES][4];

/* The column of each row from which the lobes from LMP_GGX_LOBES_FEW on have weight 0. */
extern const float lmpi_ggx_few[LMPI_GGX_ROUGHNESSES];

/* What a diffuse surface loses of F90 - F0, by view: ∫ (1 - v·h)^5 cos / pi. */
extern const float lmpi_ggx_diffuse[LMPI_GGX_VIEWS];

#endif
