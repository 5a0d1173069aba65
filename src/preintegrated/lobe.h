/* SPDX-License-Identifier: MIT */
/* lobe.h - the inside of a preintegrated lobe: plan (which slices on which grids), fill, then read.
 */
#ifndef LAMPION_PREINTEGRATED_LOBE_H
#define LAMPION_PREINTEGRATED_LOBE_H

#include "src/preintegrated/lobe_eval.h"

#define LOBE_CELLS_MAX 1024

/* One allocation: this, then the coefficients. The host stays first (lmp_release_object). */
struct lmp_preintegrated_lobe {
    lmp_host host;
    lmp_preintegrated_lobe_info info;
    float remap[LMP_PREINTEGRATED_LOBE_REMAP_COUNT];
    float exponents[LOBE_CELLS_MAX + 1]; /* of the slices */
    lmp_preintegrated_lobe_cell cells[LOBE_CELLS_MAX];
    int16_t coefficients[];
};

/* Decides slices, cells and remap for info.bands, .window, .window_size and .error; sets all but
 * the coefficients. LMP_ERROR_ARGUMENT: an error bound that asks for too many cells. */
lmp_result lmp_preintegrated_lobe_plan(lmp_preintegrated_lobe *plan);

/* Sets the exponents from the remap and cell_count. */
void lmp_preintegrated_lobe_exponents(lmp_preintegrated_lobe *plan);

/* Sets what follows from exponents and the scale and offset of every cell. */
void lmp_preintegrated_lobe_layout(lmp_preintegrated_lobe *plan);

/* Whether bands, window, window_size and error are in their ranges. */
bool lmp_preintegrated_lobe_valid(const lmp_preintegrated_lobe_info *info);

/* One like the plan, its coefficients not yet set. */
lmp_result lmp_preintegrated_lobe_allocate(const lmp_host *host, const lmp_preintegrated_lobe *plan,
                                           lmp_preintegrated_lobe **lobe);

/* Computes slice cell + side, on the grid of `cell`, into every second coefficient of the cell.
 * LMP_OK or LMP_ERROR_MEMORY. */
lmp_result lmp_preintegrated_lobe_fill(lmp_preintegrated_lobe *lobe, uint32_t cell, uint32_t side);

#endif
