/* SPDX-License-Identifier: MIT */
/* response.h - the inside of a response: plan (which slices on which grids), fill, then read. */
#ifndef LAMPION_RESPONSE_RESPONSE_H
#define LAMPION_RESPONSE_RESPONSE_H

#include "src/response/eval.h"

#define RESPONSE_CELLS_MAX 1024

/* One allocation: this, then the coefficients. */
struct lmp_response {
    lmp_allocator allocator;
    lmp_response_info info;
    float warp[LMP_RESPONSE_WARP_COUNT];
    float exponents[RESPONSE_CELLS_MAX + 1]; /* of the slices */
    lmp_response_cell cells[RESPONSE_CELLS_MAX];
    int16_t coefficients[];
};

/* Decides slices, cells and warp for info.bands, .window, .window_size and .error; sets all but the
 * coefficients. False: an error bound that asks for too many cells. */
int lmp_response_plan(lmp_response *plan);

/* Sets the exponents from the warp and cell_count. */
void lmp_response_exponents(lmp_response *plan);

/* Sets what follows from exponents and the scale and offset of every cell. */
void lmp_response_layout(lmp_response *plan);

/* Whether bands, window, window_size and error are in their ranges. */
int lmp_response_valid(const lmp_response_info *info);

/* A response like the plan, its coefficients not yet set. */
lmp_result lmp_response_allocate(const lmp_allocator *allocator, const lmp_response *plan,
                                 lmp_response **response);

/* Computes slice cell + side, on the grid of `cell`, into every second coefficient of the cell.
 * LMP_OK or LMP_ERROR_MEMORY. */
lmp_result lmp_response_fill(lmp_response *response, uint32_t cell, uint32_t side);

#endif
