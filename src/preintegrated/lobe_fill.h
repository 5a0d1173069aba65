/* SPDX-License-Identifier: MIT */
/* lobe_fill.h - computes the slices of a preintegrated lobe. */
#ifndef LAMPION_PREINTEGRATED_LOBE_FILL_H
#define LAMPION_PREINTEGRATED_LOBE_FILL_H

#include "src/preintegrated/lobe_data.h"

/* Computes slice cell + side, on the grid of `cell`, into every second coefficient of the cell.
 * Returns LMP_OK or LMP_ERROR_MEMORY. */
lmp_result lmpi_preintegrated_lobe_fill(lmp_preintegrated_lobe *lobe, uint32_t cell, uint32_t side);

#endif
