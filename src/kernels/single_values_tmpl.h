/* SPDX-License-Identifier: MIT */
/* single_values_tmpl.h - Y_lm of one direction and few bands, four orders m side by side; what
 * comes out lies in registers as coefficients do, ready to be stored or multiplied with a color. */
#ifndef LAMPION_KERNELS_SINGLE_VALUES_TMPL_H
#define LAMPION_KERNELS_SINGLE_VALUES_TMPL_H

#include "src/base/tables.h"
#include "src/base/tables_few.h"
#include "src/base/unroll.h"
#include "src/kernels/single.h"

#include <string.h>

typedef float single_four __attribute__((vector_size(16)));

#define SINGLE_FOURS (LMPI_SINGLE_BANDS * LMPI_SINGLE_BANDS / 4)

/* Coefficients 4 i … 4 i + 3 in at[i], and the last one of an odd number of bands. */
typedef struct single_values {
    single_four at[SINGLE_FOURS];
    float last;
} single_values;

/* (x + iy)^m for m = 1, 2, 3 and 0, and in `high` cosine and sine of 4, then of 5. The sine of 0 is
 * arbitrary. */
typedef struct single_azimuths {
    single_four cosine, sine, high;
} single_azimuths;

/* A band's values: the azimuths' cosines and sines times q_l^m. */
typedef struct single_band {
    single_four cosine, sine, high;
} single_band;

/* Loads x, y, z, 0. Compilers split a struct in registers by way of memory, but not a double. */
LMPI_INLINE void single_load_vector(const lmp_vec3 *v, single_four *to) {
    typedef double two_doubles __attribute__((vector_size(16)));
    two_doubles both = { 0 };
    double xy;
    memcpy(&xy, v, sizeof xy);
    both[0] = xy;
    memcpy(to, &both, sizeof both);
    (*to)[2] = v->z;
}

/* Multiplies two powers, a cosine and a sine each, by another, whose cosine c holds in every lane;
 * s holds its sine, negated in the first lane of each two. */
LMPI_INLINE void single_rotate_powers(const single_four *of, const single_four *c,
                                      const single_four *s, single_four *to) {
    *to = *of * *c + __builtin_shufflevector(*of, *of, 1, 0, 3, 2) * *s;
}

LMPI_INLINE void single_azimuths_of(int bands, const single_four *direction, single_azimuths *to) {
    const single_four w = *direction, one = { 1, 0, 0, 0 }, signs = { -1, 1, -1, 1 };
    const single_four x = __builtin_shufflevector(w, w, 0, 0, 0, 0);
    const single_four y = signs * __builtin_shufflevector(w, w, 1, 1, 1, 1);
    const single_four start = __builtin_shufflevector(one, w, 0, 1, 4, 5);
    single_four first, second, third;
    single_rotate_powers(&start, &x, &y, &first); /* powers m = 1 and 2 */
    const single_four c = __builtin_shufflevector(first, first, 2, 2, 2, 2);
    const single_four s = signs * __builtin_shufflevector(first, first, 3, 3, 3, 3);
    single_rotate_powers(&first, &c, &s, &second);
    to->cosine = __builtin_shufflevector(__builtin_shufflevector(first, second, 0, 2, 4, 4), one, 0,
                                         1, 2, 4);
    to->sine = __builtin_shufflevector(first, second, 1, 3, 5, 5);
    third = second;
    if (bands > 5)
        single_rotate_powers(&second, &c, &s, &third);
    to->high = __builtin_shufflevector(second, third, 2, 3, 4, 5);
}

/* Computes q_l^m for m = 1, 2, 3 and 0 by the recurrence of tables.h. */
LMPI_INLINE void single_columns_of(int bands, const single_four *direction, single_four *columns) {
    const single_four z = __builtin_shufflevector(*direction, *direction, 2, 2, 2, 2);
    single_four a, b;
    columns[0] = (single_four) { 0, 0, 0, lmpi_table_diagonal[0] };
    LMPI_UNROLL for (int l = 1; l < bands; l++) {
        memcpy(&a, lmpi_table_few_a[l], sizeof a);
        columns[l] = a * z * columns[l - 1];
        if (l > 1) {
            memcpy(&b, lmpi_table_few_b[l], sizeof b);
            columns[l] += b * columns[l - 2];
        }
        if (l < 4)
            columns[l][l - 1] = lmpi_table_diagonal[l];
    }
}

LMPI_INLINE void single_band_of(int l, const single_four *direction, const single_azimuths *by,
                                const float *factors, const single_four *column, single_band *to) {
    const single_four q = factors ? *column * factors[l] : *column;
    to->cosine = q * by->cosine;
    to->sine = q * by->sine;
    if (l < 4)
        return;
    const single_four ones = { 1, 1, 1, 1 };
    single_four high;
    memcpy(&high, lmpi_table_few_high[l - 4], sizeof high);
    if (l == 5)
        high *= __builtin_shufflevector(*direction, ones, 2, 2, 4, 4);
    to->high = (factors ? high * factors[l] : high) * by->high;
}

/* Computes bands 0 and 1. */
LMPI_INLINE void single_low(const single_four *direction, const float *factors, single_four *to) {
    const single_four one = { 1, 1, 1, 1 };
    single_four low;
    memcpy(&low, lmpi_table_few_low, sizeof low);
    if (factors)
        low *= (single_four) { factors[0], factors[1], factors[1], factors[1] };
    *to = low * __builtin_shufflevector(*direction, one, 4, 1, 2, 0);
}

/* Computes band 2, where it is the last: xy, yz, z² - 1/3 and xz, and x² - y². */
LMPI_INLINE void single_second(const single_four *direction, const float *factors,
                               single_values *to) {
    const single_four w = *direction;
    single_four by, more;
    memcpy(&by, lmpi_table_few_second[0], sizeof by);
    memcpy(&more, lmpi_table_few_second[1], sizeof more);
    const single_four first = __builtin_shufflevector(w, w, 0, 1, 2, 0);
    const single_four four = by * (first * __builtin_shufflevector(w, w, 1, 2, 2, 2) + more);
    const single_four squares = w * w;
    const float last = lmpi_table_diagonal[2] * (squares[0] - squares[1]);
    to->at[1] = factors ? four * factors[2] : four;
    to->last = factors ? last * factors[2] : last;
}

/* Arranges the coefficients of four and more bands, except those of single_low. */
LMPI_INLINE void single_arrange(int bands, const single_band *band, single_values *to) {
    const single_band *two = &band[2], *three = &band[3], *four = &band[4], *five = &band[5];
    to->at[1] = __builtin_shufflevector(two->sine, two->cosine, 1, 0, 7, 4);
    to->at[2] = __builtin_shufflevector(three->sine, three->sine, 2, 2, 1, 0);
    to->at[2][0] = two->cosine[1];
    to->at[3] = __builtin_shufflevector(three->cosine, three->cosine, 3, 0, 1, 2);
    if (bands > 4) {
        to->at[4] = __builtin_shufflevector(four->sine, four->sine, 2, 2, 1, 0);
        to->at[4][0] = four->high[1];
        to->at[5] = __builtin_shufflevector(four->cosine, four->cosine, 3, 0, 1, 2);
        to->last = four->high[0];
    }
    if (bands > 5) {
        to->at[6] = __builtin_shufflevector(five->high, five->high, 3, 3, 1, 1);
        to->at[6][0] = four->high[0];
        to->at[6][3] = five->sine[2];
        to->at[7] = __builtin_shufflevector(five->sine, five->cosine, 1, 0, 7, 4);
        to->at[8] = __builtin_shufflevector(five->cosine, five->high, 1, 2, 4, 6);
    }
}

/* Computes Y_lm(direction), times factors[l] if they are not NULL, for two and more bands. */
LMPI_INLINE void single_values_of(int bands, const lmp_vec3 *direction, const float *factors,
                                  single_values *to) {
    single_four w, columns[LMPI_SINGLE_BANDS];
    single_azimuths by;
    single_band band[LMPI_SINGLE_BANDS];
    single_load_vector(direction, &w);
    single_low(&w, factors, &to->at[0]);
    if (bands == 3)
        single_second(&w, factors, to);
    if (bands <= 3)
        return;
    single_columns_of(bands, &w, columns);
    single_azimuths_of(bands, &w, &by);
    LMPI_UNROLL for (int l = 2; l < bands; l++)
        single_band_of(l, &w, &by, factors, &columns[l], &band[l]);
    single_arrange(bands, band, to);
}

LMPI_INLINE void single_values_store(int bands, const single_values *values, float *sh) {
    const int count = bands * bands;
    LMPI_UNROLL for (int i = 0; i < count / 4; i++)
        memcpy(sh + 4 * i, &values->at[i], sizeof values->at[i]);
    if (count % 4 != 0)
        sh[count - 1] = values->last;
}

LMPI_INLINE void single_values_store_times(int bands, const single_values *values, float by,
                                           float *sh) {
    single_values scaled = { .last = bands % 2 != 0 ? by * values->last : 0 };
    LMPI_UNROLL for (int i = 0; i < bands * bands / 4; i++) scaled.at[i] = by * values->at[i];
    single_values_store(bands, &scaled, sh);
}

#endif
