/* SPDX-License-Identifier: MIT */
/* lobe_data.h - how a preintegrated lobe lies in memory. */
#ifndef LAMPION_PREINTEGRATED_LOBE_DATA_H
#define LAMPION_PREINTEGRATED_LOBE_DATA_H

#include "src/preintegrated/reading.h"

#define LOBE_CELLS_MAX 1024

/* One allocation: this struct, then the coefficients. The host stays first (lmpi_release_object).
 */
struct lmp_preintegrated_lobe {
    lmp_host host;
    lmp_preintegrated_lobe_info info;
    float remap[LMP_PREINTEGRATED_LOBE_REMAP_COUNT];
    float exponents[LOBE_CELLS_MAX + 1]; /* of each slice */
    lmp_preintegrated_lobe_cell cells[LOBE_CELLS_MAX];
    int16_t coefficients[];
};

#endif
