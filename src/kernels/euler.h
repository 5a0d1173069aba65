/* SPDX-License-Identifier: MIT */
/* euler.h - a rotation as R = Rz(last) X^-1 Rz(middle) X Rz(first), with X a quarter turn around x:
 * turns around z only mix m with -m, and three quarters of the entries of X's matrices are 0. */
#ifndef LAMPION_KERNELS_EULER_H
#define LAMPION_KERNELS_EULER_H

#include "src/base/tables.h"
#include "src/base/unroll.h"

#include <math.h>

#define LMPI_EULER_BANDS LMPI_TABLE_QUARTER_BANDS

/* Cosines and sines of m times an angle. */
typedef struct lmpi_euler_angle {
    float c[LMPI_EULER_BANDS], s[LMPI_EULER_BANDS];
} lmpi_euler_angle;

typedef struct lmpi_euler_angles {
    lmpi_euler_angle first, middle, last;
} lmpi_euler_angles;

/* The three angles of a row-major matrix, as cosines and sines. They use no function of the C
 * library but the square root, so they are the same everywhere. Near the poles of the angles they
 * may be far from those of a nearby rotation, but their product is not. */
typedef struct lmpi_euler {
    double first[2], middle[2], last[2];
} lmpi_euler;

/* Computes 1 / sqrt of three numbers. */
#ifdef __AVX__
#include <immintrin.h>
/* Kept in registers: one load of all would wait for the stores of each. */
LMPI_INLINE void lmpi_euler_per_root(double a, double b, double c, double per[3]) {
    const __m256d all = _mm256_div_pd(_mm256_set1_pd(1), _mm256_sqrt_pd(_mm256_set_pd(1, c, b, a)));
    const __m128d high = _mm256_extractf128_pd(all, 1), low = _mm256_castpd256_pd128(all);
    per[0] = _mm_cvtsd_f64(low);
    per[1] = _mm_cvtsd_f64(_mm_unpackhi_pd(low, low));
    per[2] = _mm_cvtsd_f64(high);
}
#else
LMPI_INLINE void lmpi_euler_per_root(double a, double b, double c, double per[3]) {
    per[0] = 1 / sqrt(a);
    per[1] = 1 / sqrt(b);
    per[2] = 1 / sqrt(c);
}
#endif

/* Finds the three angles. Where the middle angle is small, the matrix tells the sum of the two
 * others, but not each; where it is near a half turn, their difference. So one of them is taken
 * from the matrix, and the other from the sum or the difference. */
LMPI_INLINE void lmpi_euler_of(const float rotation[9], lmpi_euler *euler) {
    double r[9];
    for (int i = 0; i < 9; i++)
        r[i] = (double)rotation[i];
    const bool up = r[8] >= 0;
    const double both_c = up ? r[0] + r[4] : r[4] - r[0], both_s = up ? r[3] - r[1] : r[3] + r[1];
    const double across2 = r[2] * r[2] + r[5] * r[5];
    const bool none = across2 == 0;
    double per[3];
    lmpi_euler_per_root(both_c * both_c + both_s * both_s, none ? 1 : across2,
                        across2 + r[8] * r[8], per);
    const double c = none ? 1 : r[2] * per[1], s = r[5] * per[1];
    const double sum_c = both_c * per[0], sum_s = both_s * per[0];
    euler->last[0] = c;
    euler->last[1] = s;
    euler->middle[0] = r[8] * per[2];
    euler->middle[1] = across2 * per[1] * per[2];
    euler->first[0] = up ? sum_c * c + sum_s * s : sum_c * c - sum_s * s;
    euler->first[1] = up ? sum_s * c - sum_c * s : sum_c * s + sum_s * c;
}

/* Computes the multiples of the angles. bands is at most LMPI_EULER_BANDS. */
void lmpi_euler_angles_of(int bands, const lmpi_euler *euler, lmpi_euler_angles *angles);

/* Rotates coefficients around z, in place if wanted. The loops of these macros work on `number`, a
 * float or several at once. */
#define LMPI_EULER_Z(number, bands, angle, from, to)                                               \
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

/* Rotates coefficients by a quarter turn around x, not in place. */
#define LMPI_EULER_QUARTER(number, bands, from, to)                                                \
    for (int l = 0, i = 0; l < (bands); l++) {                                                     \
        number *out = (to) + l * (l + 1);                                                          \
        for (int m = -l; m <= l; m++) {                                                            \
            const number *in = (from) + l * (l + 1) + lmpi_table_quarter_first(l, m);              \
            const int count = lmpi_table_quarter_count(l, m);                                      \
            number total = lmpi_table_quarter[i++] * in[0];                                        \
            for (int k = 1; k < count; k++)                                                        \
                total += lmpi_table_quarter[i++] * in[2 * k];                                      \
            out[m] = total;                                                                        \
        }                                                                                          \
    }

#endif
