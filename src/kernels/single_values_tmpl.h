/* SPDX-License-Identifier: MIT */
/* single_values_tmpl.h - Y_lm of one direction and few bands, four coefficients side by side, each
 * four a product of two or three known ones; what comes out lies in registers as coefficients do,
 * ready to be stored or multiplied with a color. */
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

/* The band of the first of four coefficients, and that of the three others. */
static const int single_bands[SINGLE_FOURS][2] = { { 0, 1 }, { 2, 2 }, { 2, 3 }, { 3, 3 }, { 4, 4 },
                                                   { 4, 4 }, { 4, 5 }, { 5, 5 }, { 5, 5 } };

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

LMPI_INLINE void single_load_four(const float from[4], single_four *to) {
    memcpy(to, from, sizeof *to);
}

/* Computes coefficients over their scales (tables_few.h) up to those of four bands: products of
 * two or three of x, y, z and sums of their squares. */
LMPI_INLINE void single_products(int bands, const single_four *direction, single_values *to) {
    const single_four w = *direction, squares = w * w, one = { 1, 1, 1, 1 };
    single_four second, third;
    to->at[0] = __builtin_shufflevector(w, one, 4, 1, 2, 0);
    if (bands == 2)
        return;
    single_load_four(lmpi_table_few_less[0], &second);
    /* xy, yz, z² and xz */
    to->at[1] =
        __builtin_shufflevector(w, w, 0, 1, 2, 0) * __builtin_shufflevector(w, w, 1, 2, 2, 2) -
        second;
    to->last = squares[0] - squares[1];
    if (bands == 3)
        return;
    single_load_four(lmpi_table_few_less[1], &second);
    single_load_four(lmpi_table_few_less[2], &third);
    /* 1, y, z, y times x², x², xy, z² less y², y², 0, 1; and z, x, z, x times z², z², x², x² less
     * 1, 1, y², y²; with factors */
    second *= __builtin_shufflevector(squares, one, 1, 1, 4, 4);
    third *= __builtin_shufflevector(one, squares, 0, 0, 5, 5);
    to->at[2] =
        __builtin_shufflevector(w, one, 4, 1, 2, 1) *
        (__builtin_shufflevector(w, w, 0, 0, 0, 2) * __builtin_shufflevector(w, w, 0, 0, 1, 2) -
         second);
    to->at[3] = __builtin_shufflevector(w, w, 2, 0, 2, 0) *
                (__builtin_shufflevector(squares, squares, 2, 2, 0, 0) - third);
}

/* Continues single_products for bands 4 and 5: products of what it made, of z² less roots, and of
 * the cosine c of four times the azimuth. */
LMPI_INLINE void single_more_products(int bands, const single_four *direction, single_values *to) {
    const single_four w = *direction, z = __builtin_shufflevector(w, w, 2, 2, 2, 2), zz = z * z;
    const single_four *at = to->at;
    single_four roots, more;
    single_load_four(lmpi_table_few_less[3], &roots);
    const single_four four = zz - roots; /* for m = 2, 1, and 0 twice */
    const float c = at[2][0] * at[2][0] - 4 * (at[1][0] * at[1][0]);
    const single_four xy_z = __builtin_shufflevector(at[1], w, 0, 6, 0, 1);
    to->at[4] = xy_z * __builtin_shufflevector(at[2], four, 0, 1, 4, 5);
    const single_four low = __builtin_shufflevector(four, at[1], 2, 7, 2, 7);
    const single_four high = __builtin_shufflevector(at[2], w, 0, 6, 0, 6);
    to->at[5] = __builtin_shufflevector(low, high, 0, 1, 4, 5) *
                __builtin_shufflevector(four, at[3], 3, 1, 0, 7);
    to->last = c;
    if (bands == 5)
        return;
    single_load_four(lmpi_table_few_less[4], &roots);
    single_load_four(lmpi_table_few_less[5], &more);
    const single_four five = zz - roots; /* for m = 2, 1, 0, 3 */
    const single_four twice = five * (zz - more);
    const single_four s = __builtin_shufflevector(to->at[4], to->at[4], 0, 0, 0, 0);
    const single_four both = { c, c, s[0], five[3] };
    const single_four turned = { 0, 4 * w[0], 0, 0 }, back = { 0, 0, 0, 4 * w[1] };
    const single_four of = { 1, w[1], w[2], at[2][1] };
    to->at[6] = of * both + turned * s;
    to->at[7] = __builtin_shufflevector(w, at[2], 6, 1, 2, 0) *
                __builtin_shufflevector(five, twice, 0, 5, 6, 5);
    to->at[8] = __builtin_shufflevector(at[3], w, 2, 3, 6, 4) *
                    __builtin_shufflevector(five, both, 0, 3, 4, 5) -
                back * s;
}

/* Multiplies coefficients by their scales, and by factors[l] if they are not NULL. */
LMPI_INLINE void single_scale(int bands, const float *factors, single_values *values) {
    const single_four zero = { 0 };
    LMPI_UNROLL for (int i = 0; i < bands * bands / 4; i++) {
        single_four scale;
        single_load_four(lmpi_table_few_scale + 4 * i, &scale);
        if (factors) {
            const single_four first = factors[single_bands[i][0]] - zero;
            const single_four others = factors[single_bands[i][1]] - zero;
            scale *= __builtin_shufflevector(first, others, 0, 5, 6, 7);
        }
        values->at[i] *= scale;
    }
    const float last = lmpi_table_few_scale[bands * bands - 1];
    values->last *= factors ? last * factors[bands - 1] : last;
}

/* Computes Y_lm(direction), times factors[l] if they are not NULL, for two and more bands. */
LMPI_INLINE void single_values_of(int bands, const lmp_vec3 *direction, const float *factors,
                                  single_values *to) {
    single_four w;
    to->last = 0;
    single_load_vector(direction, &w);
    single_products(bands, &w, to);
    if (bands > 4)
        single_more_products(bands, &w, to);
    single_scale(bands, factors, to);
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
