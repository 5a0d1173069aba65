/* SPDX-License-Identifier: MIT */
/* column.h - the recurrence all of sh and light share: one m at a time, l upward. */
#ifndef LAMPION_SH_COLUMN_H
#define LAMPION_SH_COLUMN_H

#include "src/base/tables.h"
#include "src/base/unroll.h"

#include <lampion/sh.h>

/* C_m + i S_m = (x + iy)^m, the azimuthal part of Y_l,±m: no angles and no poles. */
typedef struct lmp_azimuth {
    float c, s;
} lmp_azimuth;

static inline lmp_azimuth lmp_azimuth_next(lmp_azimuth a, lmp_vec3 direction) {
    return (lmp_azimuth) { direction.x * a.c - direction.y * a.s,
                           direction.x * a.s + direction.y * a.c };
}

/* q[l] = q_l^m(z) for l = m … bands-1; Y_l,±m = q_l^m {C_m, S_m}. */
static inline void lmp_sh_column(int bands, int m, float z, float *q) {
    const float *a = lmp_table_a + lmp_table_index(m, m);
    const float *b = lmp_table_b + lmp_table_index(m, m);
    float before = 0;
    q[m] = lmp_table_diagonal[m];
    for (int l = m + 1; l < bands; l++) {
        q[l] = a[l - m] * z * q[l - 1] + b[l - m] * before;
        before = q[l - 1];
    }
}

/* Y_lm(direction), its q times radial[l] and the product times factors[l], where they are not NULL:
 * straight-line code for a constant number of bands. */
LMP_INLINE void lmp_sh_put(int bands, lmp_vec3 direction, const float *radial, const float *factors,
                           float *sh) {
    lmp_azimuth a = { 1, 0 };
    LMP_UNROLL for (int m = 0; m < bands; m++) {
        float before = 0, q = lmp_table_diagonal[m];
        LMP_UNROLL for (int l = m; l < bands; l++) {
            if (l > m) {
                const size_t i = lmp_table_index(l, m);
                const float next = lmp_table_a[i] * direction.z * q + lmp_table_b[i] * before;
                before = q;
                q = next;
            }
            const float scaled = radial ? q * radial[l] : q;
            const float sine = scaled * a.s, cosine = scaled * a.c;
            /* -m first: at m = 0 both are one coefficient, and cosine wins */
            sh[LMP_SH_INDEX(l, -m)] = factors ? sine * factors[l] : sine;
            sh[LMP_SH_INDEX(l, m)] = factors ? cosine * factors[l] : cosine;
        }
        a = lmp_azimuth_next(a, direction);
    }
}

/* lmp_sh_eval of a direction that need not be quite unit. */
void lmp_sh_values(int bands, lmp_vec3 direction, float *sh);

/* factors[l] Y_lm(axis) of bands low … high-1. */
void lmp_sh_zonal_bands(int low, int high, const float *factors, lmp_vec3 axis, float *sh);

#endif
