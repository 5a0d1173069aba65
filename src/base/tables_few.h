/* SPDX-License-Identifier: MIT */
/* tables_few.h - constants of straight-line code of few bands, laid out for its registers. They are
 * apart from tables.h because a change of that header recompiles all batch kernels. */
#ifndef LAMPION_BASE_TABLES_FEW_H
#define LAMPION_BASE_TABLES_FEW_H

#include <lampion/base.h>

/* Entries of lmpi_table_a and lmpi_table_b for registers of four: A_lm and B_lm of m = 1, 2, 3 and
 * 0; the factors of 1, y, z and x for (0, 0), (1, -1), (1, 0) and (1, 1); and q_4^4 twice, then
 * q_5^4 / z and q_5^5, each twice. */
#define LMPI_TABLE_FEW_BANDS 6
extern const float lmpi_table_few_a[LMPI_TABLE_FEW_BANDS][4];
extern const float lmpi_table_few_b[LMPI_TABLE_FEW_BANDS][4];
extern const float lmpi_table_few_low[4];
extern const float lmpi_table_few_high[2][4];

/* Factors of (2, -2) … (2, 1), and what is added before to xy, yz, z² and xz. */
extern const float lmpi_table_few_second[2][4];

/* lmpi_table_quarter of bands 2 to 5 for registers of 16 lanes, with m in lane 8 + m. A lane adds
 * up, term after term, lmpi_table_quarter_terms[l - 2] times the lane that lmpi_table_quarter_lanes
 * names. Missing terms are 0. */
#define LMPI_TABLE_QUARTER_LANES 16
extern const float lmpi_table_quarter_terms[4][3][LMPI_TABLE_QUARTER_LANES];
extern const int32_t lmpi_table_quarter_lanes[4][3][LMPI_TABLE_QUARTER_LANES];

/* Constants of products of few bands, at the heights of Gauss's rule that is exact for three such
 * functions; heights of the lower half are mirrored. `in` holds q_l^m r^m by m, then l, with r the
 * radius of the circle at that height, and twice the value for m = 0. `out`, for the upper half,
 * holds the values of (l, m) in the order of coefficients, times the weight and pi / 2, or pi for m
 * = 0. */
#define LMPI_TABLE_PRODUCT_BANDS   6
#define LMPI_TABLE_PRODUCT_HEIGHTS 8
#define LMPI_TABLE_PRODUCT_COLUMNS (LMPI_TABLE_PRODUCT_BANDS * (LMPI_TABLE_PRODUCT_BANDS + 1) / 2)
#define LMPI_TABLE_PRODUCT_VALUES  (LMPI_TABLE_PRODUCT_BANDS * LMPI_TABLE_PRODUCT_BANDS)
extern const float lmpi_table_product_in[LMPI_TABLE_PRODUCT_COLUMNS][LMPI_TABLE_PRODUCT_HEIGHTS];
extern const float lmpi_table_product_out[LMPI_TABLE_PRODUCT_VALUES]
                                         [LMPI_TABLE_PRODUCT_HEIGHTS / 2];

static inline int lmpi_table_product_index(int l, int m) {
    return m * LMPI_TABLE_PRODUCT_BANDS - m * (m - 1) / 2 + l - m;
}

#endif
