/* SPDX-License-Identifier: MIT */
/* euler.h - a rotation taken apart, R = Rz(last) X^-1 Rz(middle) X Rz(first), X a quarter turn
 * around x: turns around z mix m with -m alone, and of the matrices of X three quarters are 0. */
#ifndef LAMPION_SH_EULER_H
#define LAMPION_SH_EULER_H

#include "src/base/tables.h"
#include "src/base/unroll.h"

#include <lampion/sh.h>

#define LMP_EULER_BANDS LMP_TABLE_QUARTER_BANDS

/* Cosines and sines of m times an angle. */
typedef struct lmp_euler_angle {
    float c[LMP_EULER_BANDS], s[LMP_EULER_BANDS];
} lmp_euler_angle;

typedef struct lmp_euler_angles {
    lmp_euler_angle first, middle, last;
} lmp_euler_angles;

/* The three angles of a matrix, row-major, as cosine and sine; no function of the C library but the
 * root is asked, so they are the same everywhere. Near the poles of the angles their parts may be
 * far from those of a rotation nearby, but not what they make together. */
typedef struct lmp_euler {
    double first[2], middle[2], last[2];
} lmp_euler;
lmp_euler lmp_euler_of(const double r[9]);

/* At most LMP_EULER_BANDS. */
void lmp_euler_angles_of(int bands, const lmp_euler *euler, lmp_euler_angles *angles);

/* The loops below work on `number`, a float or several at once. Coefficients rotated around z; in
 * place, too. */
#define LMP_EULER_Z(number, bands, angle, from, to)                                                \
    for (int l = 0; l < (bands); l++) {                                                            \
        const number *in = (from) + LMP_SH_INDEX(l, 0);                                            \
        number *out = (to) + LMP_SH_INDEX(l, 0);                                                   \
        out[0] = in[0];                                                                            \
        for (int m = 1; m <= l; m++) {                                                             \
            const number plus = in[m], minus = in[-m];                                             \
            out[m] = (angle)->c[m] * plus - (angle)->s[m] * minus;                                 \
            out[-m] = (angle)->s[m] * plus + (angle)->c[m] * minus;                                \
        }                                                                                          \
    }

/* Coefficients after a quarter turn around x, not in place. */
#define LMP_EULER_QUARTER(number, bands, from, to)                                                 \
    for (int l = 0, i = 0; l < (bands); l++) {                                                     \
        number *out = (to) + LMP_SH_INDEX(l, 0);                                                   \
        for (int m = -l; m <= l; m++) {                                                            \
            const number *in = (from) + LMP_SH_INDEX(l, lmp_table_quarter_first(l, m));            \
            const int count = lmp_table_quarter_count(l, m);                                       \
            number total = lmp_table_quarter[i++] * in[0];                                         \
            for (int k = 1; k < count; k++)                                                        \
                total += lmp_table_quarter[i++] * in[2 * k];                                       \
            out[m] = total;                                                                        \
        }                                                                                          \
    }

#endif
