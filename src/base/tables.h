/* SPDX-License-Identifier: MIT */
/* tables.h - the constants of every recurrence, computed in double and rounded once to float.
 *
 * tables.c is written by generate/tables.c; a test holds the two together.
 *
 * Triangular tables go by m: for each m the entries l = m … LMP_BANDS_MAX-1 follow one another, in
 * the order the recurrences run, so a kernel walks them with one pointer. */
#ifndef LAMPION_BASE_TABLES_H
#define LAMPION_BASE_TABLES_H

#include <lampion/base.h>

#define LMPI_TABLE_COUNT (LMP_BANDS_MAX * (LMP_BANDS_MAX + 1) / 2)

/* The index of (l, m), 0 <= m <= l < LMP_BANDS_MAX, in a triangular table. */
static inline size_t lmpi_table_index(int l, int m) {
    return (size_t)(m * LMP_BANDS_MAX - m * (m - 1) / 2 + l - m);
}

/* q_l^m = A_lm z q_(l-1)^m + B_lm q_(l-2)^m for l > m, from q_m^m = lmpi_table_diagonal[m]; then
 * Y_l,±m = q_l^m {C_m, S_m}, C_m + i S_m = (x + iy)^m. B = 0 at l = m+1, A = B = 0 at l = m. */
extern const float lmpi_table_a[LMPI_TABLE_COUNT];
extern const float lmpi_table_b[LMPI_TABLE_COUNT];
extern const float lmpi_table_diagonal[LMP_BANDS_MAX];

/* The monic form, one fused step a coefficient: q_m = 1, q_l = z q_(l-1) - b_lm q_(l-2), then
 * Y_l,±m = N_lm q_l {C_m, S_m}. N is finite throughout, but q turns denormal near 128 bands: use it
 * to LMPI_TABLE_MONIC_BANDS. b = 0 at l = m and m+1. */
#define LMPI_TABLE_MONIC_BANDS 64
extern const float lmpi_table_monic[LMPI_TABLE_COUNT];
extern const float lmpi_table_norm[LMPI_TABLE_COUNT];

/* dq_l^m/dz = G_lm q_l^(m+1): G_lm = -e_m sqrt((l-m)(l+m+1)), e_0 = 1/sqrt(2), else 1. */
extern const float lmpi_table_slope[LMPI_TABLE_COUNT];

/* The difference form of R_l (sphere.h), t = 1 - cos a, from D_1 = 0, R_1 = 1, for l >= 2:
 * D_l = d_l D_(l-1) - t_l t R_(l-1), R_l = R_(l-1) + D_l; d_l = (l-2)/(l+1), t_l = (2l-1)/(l+1). */
extern const float lmpi_table_cap_d[LMP_BANDS_MAX];
extern const float lmpi_table_cap_t[LMP_BANDS_MAX];

/* The difference form of Legendre's P_l, with t = 1 - cos a, from E_0 = 0, P_0 = 1, for l >= 1: E_l
 * = d_l E_(l-1) - t_l t P_(l-1), P_l = P_(l-1) + E_l; d_l = (l-1)/l, t_l = (2l-1)/l. The same
 * factors make the plain form P_l = t_l u P_(l-1) - d_l P_(l-2). Entry 0 is 0. */
extern const float lmpi_table_legendre_d[LMP_BANDS_MAX];
extern const float lmpi_table_legendre_t[LMP_BANDS_MAX];

/* Scales s_l of the sum of s_l R_l P_l over bands, of zonal lobes: [0] of the plain form, [1] of
 * the monic form, in which R and P go as x p_(l-1) - c_l p_(l-2) and s_l holds their norms. s_l =
 * (2l+1)/4, and 1/2 for l = 0. In double, because s_l is multiplied by a weight before rounding. */
extern const double lmpi_table_zonal_scale[2][LMP_BANDS_MAX];
extern const float lmpi_table_zonal_cap[LMP_BANDS_MAX],
    lmpi_table_zonal_lobe[LMP_BANDS_MAX]; /* c_l */

/* Y_l0(z) = sqrt((2l+1)/(4 pi)). */
extern const float lmpi_table_pole[LMP_BANDS_MAX];

/* The non-zero entries of the matrices by which a quarter turn around x, (x, y, z) to (x, -z, y),
 * rotates coefficients: rows m = -l … l, band after band, each with every second column from its
 * first one on. The opposite turn has the transposed matrices. */
#define LMPI_TABLE_QUARTER_BANDS 16
#define LMPI_TABLE_QUARTERS      1376
extern const float lmpi_table_quarter[LMPI_TABLE_QUARTERS];

static inline int lmpi_table_quarter_first(int l, int m) {
    if ((l + m) % 2 != 0)
        return m >= 0 ? -l : 1 - l;
    return (m >= 0) == (l % 2 == 0) ? 0 : 1;
}
static inline int lmpi_table_quarter_count(int l, int m) {
    const int first = lmpi_table_quarter_first(l, m);
    return first < 0 ? (1 - first) / 2 : (l - first) / 2 + 1;
}

#endif
