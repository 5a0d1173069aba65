/* SPDX-License-Identifier: MIT */
/* tables_few.h - constants of straight-line code of few bands, laid out for its registers. They are
 * apart from tables.h because a change of that header recompiles all batch kernels. */
#ifndef LAMPION_BASE_TABLES_FEW_H
#define LAMPION_BASE_TABLES_FEW_H

#include "src/base/unroll.h"

#include <lampion/base.h>

/* Scales of coefficients that are products (single_values_tmpl.h): the norm times |m| for m = -4 …
 * -2, whose sines have it as a factor; and what those products take away, four coefficients or four
 * orders m side by side. */
#define LMPI_TABLE_FEW_BANDS 6
extern LMPI_HIDDEN const float lmpi_table_few_scale[LMPI_TABLE_FEW_BANDS * LMPI_TABLE_FEW_BANDS];
extern LMPI_HIDDEN const float lmpi_table_few_less[6][4];

/* Constants by which few bands are rotated (single_rotate_tmpl.h): x, y and z of eleven axes, of
 * which the first 2l+1 tell band l; the norms of lmpi_table_norm in the order of coefficients; the
 * squares of the positive roots of q_l^m over that norm by l and m, the greater first; and for l =
 * 2 … 5 the matrix that makes coefficients of values, column by column. What is not there is 0. */
#define LMPI_TABLE_ROTATE_AXES 16 /* whole registers */
extern LMPI_HIDDEN const float lmpi_table_rotate_axes[3][LMPI_TABLE_ROTATE_AXES];
extern LMPI_HIDDEN const float lmpi_table_rotate_norms[LMPI_TABLE_FEW_BANDS * LMPI_TABLE_FEW_BANDS];
extern LMPI_HIDDEN const float lmpi_table_rotate_squares[LMPI_TABLE_FEW_BANDS][LMPI_TABLE_FEW_BANDS]
                                                        [2];
extern LMPI_HIDDEN const float lmpi_table_rotate_inverse[LMPI_TABLE_FEW_BANDS - 2]
                                                        [2 * LMPI_TABLE_FEW_BANDS - 1]
                                                        [LMPI_TABLE_ROTATE_AXES];

/* Constants of products of few bands, at the heights of Gauss's rule that is exact for three such
 * functions; heights of the lower half are mirrored. `in` holds q_l^m r^m by m, then l, with r the
 * radius of the circle at that height, and twice the value for m = 0. `out`, for the upper half,
 * holds the values of (l, m) in the order of coefficients, times the weight and pi / 2, or pi for m
 * = 0. */
#define LMPI_TABLE_PRODUCT_BANDS   6
#define LMPI_TABLE_PRODUCT_HEIGHTS 8
#define LMPI_TABLE_PRODUCT_COLUMNS (LMPI_TABLE_PRODUCT_BANDS * (LMPI_TABLE_PRODUCT_BANDS + 1) / 2)
#define LMPI_TABLE_PRODUCT_VALUES  (LMPI_TABLE_PRODUCT_BANDS * LMPI_TABLE_PRODUCT_BANDS)
extern LMPI_HIDDEN const float lmpi_table_product_in[LMPI_TABLE_PRODUCT_COLUMNS]
                                                    [LMPI_TABLE_PRODUCT_HEIGHTS];
extern LMPI_HIDDEN const float lmpi_table_product_out[LMPI_TABLE_PRODUCT_VALUES]
                                                     [LMPI_TABLE_PRODUCT_HEIGHTS / 2];

static inline int lmpi_table_product_index(int l, int m) {
    return m * LMPI_TABLE_PRODUCT_BANDS - m * (m - 1) / 2 + l - m;
}

#endif
