/* SPDX-License-Identifier: MIT */
/* euler.h - a rotation taken apart, R = Rz(last) X^-1 Rz(middle) X Rz(first), X a quarter turn
 * around x: turns around z mix m with -m alone, and of the matrices of X three quarters are 0. */
#ifndef LAMPION_KERNELS_EULER_H
#define LAMPION_KERNELS_EULER_H

#include "src/base/tables.h"
#include "src/base/unroll.h"

#include <math.h>
#ifdef __AVX__
#include <immintrin.h>
#endif

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

/* 1 / sqrt of three numbers. */
LMP_INLINE void lmp_euler_per_root(double a, double b, double c, double per[3]) {
#ifdef __AVX__
    /* In registers: a load of all would wait for the stores of each. */
    const __m256d all = _mm256_div_pd(_mm256_set1_pd(1), _mm256_sqrt_pd(_mm256_set_pd(1, c, b, a)));
    const __m128d high = _mm256_extractf128_pd(all, 1), low = _mm256_castpd256_pd128(all);
    per[0] = _mm_cvtsd_f64(low);
    per[1] = _mm_cvtsd_f64(_mm_unpackhi_pd(low, low));
    per[2] = _mm_cvtsd_f64(high);
#else
    per[0] = 1 / sqrt(a);
    per[1] = 1 / sqrt(b);
    per[2] = 1 / sqrt(c);
#endif
}

/* Where the middle angle is small, what the matrix says of the two others is noise, but not what it
 * says of their sum; where it is near a half turn, of their difference. One of them is taken from
 * the matrix, the other from there. */
LMP_INLINE void lmp_euler_of(const float rotation[9], lmp_euler *euler) {
    double r[9];
    for (int i = 0; i < 9; i++)
        r[i] = (double)rotation[i];
    const bool up = r[8] >= 0;
    const double both_c = up ? r[0] + r[4] : r[4] - r[0], both_s = up ? r[3] - r[1] : r[3] + r[1];
    const double across2 = r[2] * r[2] + r[5] * r[5];
    const bool none = across2 == 0;
    double per[3];
    lmp_euler_per_root(both_c * both_c + both_s * both_s, none ? 1 : across2, across2 + r[8] * r[8],
                       per);
    const double c = none ? 1 : r[2] * per[1], s = r[5] * per[1];
    const double sum_c = both_c * per[0], sum_s = both_s * per[0];
    euler->last[0] = c;
    euler->last[1] = s;
    euler->middle[0] = r[8] * per[2];
    euler->middle[1] = across2 * per[1] * per[2];
    euler->first[0] = up ? sum_c * c + sum_s * s : sum_c * c - sum_s * s;
    euler->first[1] = up ? sum_s * c - sum_c * s : sum_c * s + sum_s * c;
}

/* At most LMP_EULER_BANDS. */
void lmp_euler_angles_of(int bands, const lmp_euler *euler, lmp_euler_angles *angles);

/* The loops below work on `number`, a float or several at once. Coefficients rotated around z; in
 * place, too. */
#define LMP_EULER_Z(number, bands, angle, from, to)                                                \
    for (int l = 0; l < (bands); l++) {                                                            \
        const number *in = (from) + l * (l + 1);                                                   \
        number *out = (to) + l * (l + 1);                                                          \
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
        number *out = (to) + l * (l + 1);                                                          \
        for (int m = -l; m <= l; m++) {                                                            \
            const number *in = (from) + l * (l + 1) + lmp_table_quarter_first(l, m);               \
            const int count = lmp_table_quarter_count(l, m);                                       \
            number total = lmp_table_quarter[i++] * in[0];                                         \
            for (int k = 1; k < count; k++)                                                        \
                total += lmp_table_quarter[i++] * in[2 * k];                                       \
            out[m] = total;                                                                        \
        }                                                                                          \
    }

#endif
