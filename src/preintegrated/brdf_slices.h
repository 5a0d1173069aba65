/* SPDX-License-Identifier: MIT */
/* brdf_slices.h - makes the slices of one half angle. */
#ifndef LAMPION_PREINTEGRATED_BRDF_SLICES_H
#define LAMPION_PREINTEGRATED_BRDF_SLICES_H

#include "src/preintegrated/brdf_rings.h"

/* The slices of one half angle for all views, with texels in their own memory. */
typedef struct brdf_column {
    lmp_preintegrated_brdf_slice *slices; /* of each view; first counts from 0 */
    int16_t *texels;
    size_t texel_count;
} brdf_column;

/* Makes the slices of cap node `index` of `count`. */
lmp_result lmpi_preintegrated_brdf_slices(const brdf_views *views, const int *caps, int count,
                                          int index, float error, brdf_column *column);
void lmpi_preintegrated_brdf_column_free(const brdf_series *series, brdf_column *column);

#endif
