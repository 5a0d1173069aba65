/* SPDX-License-Identifier: MIT */
/* points.h - what a field gives to points: interpolated coefficients and near lights. */
#ifndef LAMPION_FIELD_POINTS_H
#define LAMPION_FIELD_POINTS_H

#include "src/field/near.h"
#include "src/kernels/field.h"

/* Floats of the coefficients of as many points as a brick has nodes. */
#define FIELD_ROWS (FIELD_BRICK * 3 * LMP_FIELD_BANDS_MAX * LMP_FIELD_BANDS_MAX)

/* Up to FIELD_BRICK points as the kernel takes them, in nodes laid out as the field's. */
typedef struct field_cells {
    uint32_t corners[8 * FIELD_BRICK];
    float fraction[3][FIELD_BRICK] __attribute__((aligned(64)));
} field_cells;
void lmpi_field_set_place(const lmp_field *field, const field_place *place, size_t at,
                          field_cells *cells);
lmpi_kernel_cells lmpi_field_cells(const lmp_field *field, const float *nodes,
                                   const field_cells *cells);

/* Blocks of cells; neighbors in the same block add it once. */
enum { FIELD_BLOCKS = 64 };
typedef struct field_blocks {
    size_t count;
    uint32_t at[FIELD_BLOCKS];
} field_blocks;

/* Interpolates coefficients at up to FIELD_BRICK points, in any cell where they lie outside the
 * grid. blocks, which may be NULL, receives the blocks of points inside, at most one per point. */
void lmpi_field_interpolate(const lmp_field *field, const lmp_vec3 *points, size_t count,
                            field_blocks *blocks, const lmpi_kernel_out *out);

/* Evaluates field->values coefficients at a point, near lights included. */
void lmpi_field_row(const lmp_field *field, lmp_vec3 point, float *row);

#endif
