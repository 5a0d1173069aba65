/* SPDX-License-Identifier: MIT */
/* column.h - the recurrence that all of sh and light share: one m at a time, l upward. */
#ifndef LAMPION_SH_COLUMN_H
#define LAMPION_SH_COLUMN_H

#include "src/base/tables.h"
#include "src/base/unroll.h"

#include <lampion/sh.h>

#include <math.h>

/* C_m + i S_m = (x + iy)^m, the azimuthal part of Y_l,±m: no angles and no poles. */
typedef struct lmpi_azimuth {
    float c, s;
} lmpi_azimuth;

static inline lmpi_azimuth lmpi_azimuth_next(lmpi_azimuth a, lmp_vec3 direction) {
    return (lmpi_azimuth) { direction.x * a.c - direction.y * a.s,
                            direction.x * a.s + direction.y * a.c };
}

/* Steps along column m: q becomes q_l^m(z) from that of l - 1, with the one before it; the first of
 * the column, lmpi_table_diagonal[m], has 0 before it. */
LMPI_INLINE void lmpi_sh_step(int l, int m, float z, float *before, float *q) {
    const size_t i = lmpi_table_index(l, m);
    const float next = lmpi_table_a[i] * z * *q + lmpi_table_b[i] * *before;
    *before = *q;
    *q = next;
}

/* Computes q[l] = q_l^m(z) for l = m … bands-1; Y_l,±m = q_l^m {C_m, S_m}. */
static inline void lmpi_sh_column(int bands, int m, float z, float *q) {
    const float *a = lmpi_table_a + lmpi_table_index(m, m);
    const float *b = lmpi_table_b + lmpi_table_index(m, m);
    float before = 0;
    q[m] = lmpi_table_diagonal[m];
    for (int l = m + 1; l < bands; l++) {
        q[l] = a[l - m] * z * q[l - 1] + b[l - m] * before;
        before = q[l - 1];
    }
}

/* Returns q_(m+1)^(m+1) from q_m^m, which is sqrt(1 / (4 pi)) for m = 0; lmpi_table_diagonal has
 * them in float. */
static inline double lmpi_sh_next_diagonal(int m, double diagonal) {
    return -diagonal * sqrt(m == 0 ? 3 : (2 * m + 3) / (2.0 * m + 2));
}

/* Computes Y_lm(direction), with q times radial[l] and the product times factors[l] where they are
 * not NULL. It is straight-line code for a constant number of bands. */
LMPI_INLINE void lmpi_sh_put(int bands, lmp_vec3 direction, const float *radial,
                             const float *factors, float *sh) {
    lmpi_azimuth a = { 1, 0 };
    LMPI_UNROLL for (int m = 0; m < bands; m++) {
        float before = 0, q = lmpi_table_diagonal[m];
        LMPI_UNROLL for (int l = m; l < bands; l++) {
            if (l > m)
                lmpi_sh_step(l, m, direction.z, &before, &q);
            const float scaled = radial ? q * radial[l] : q;
            const float sine = scaled * a.s, cosine = scaled * a.c;
            /* -m first: at m = 0 both are one coefficient, and cosine wins */
            sh[LMP_SH_INDEX(l, -m)] = factors ? sine * factors[l] : sine;
            sh[LMP_SH_INDEX(l, m)] = factors ? cosine * factors[l] : cosine;
        }
        a = lmpi_azimuth_next(a, direction);
    }
}

/* Does lmp_sh_eval for a direction that need not be quite unit. */
void lmpi_sh_values(int bands, lmp_vec3 direction, float *sh);

/* Computes factors[l] Y_lm(axis) of bands low … high-1. */
void lmpi_sh_zonal_bands(int low, int high, const float *factors, lmp_vec3 axis, float *sh);

#endif
