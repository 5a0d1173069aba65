/* SPDX-License-Identifier: MIT */
/* lobe_plan.h - plans which slices of a preintegrated lobe to hold, and on which grids. */
#ifndef LAMPION_PREINTEGRATED_LOBE_PLAN_H
#define LAMPION_PREINTEGRATED_LOBE_PLAN_H

#include "src/preintegrated/lobe_data.h"

/* Chooses slices, cells and remap for info.bands, .window, .window_size and .error; sets all but
 * the coefficients. Returns LMP_ERROR_ARGUMENT for an error bound that needs too many cells. */
lmp_result lmpi_preintegrated_lobe_plan(lmp_preintegrated_lobe *plan);

/* Sets the exponents from the remap and cell_count. */
void lmpi_preintegrated_lobe_exponents(lmp_preintegrated_lobe *plan);

/* Sets what follows from exponents and the scale and offset of every cell. */
void lmpi_preintegrated_lobe_layout(lmp_preintegrated_lobe *plan);

#endif
