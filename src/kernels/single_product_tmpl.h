/* SPDX-License-Identifier: MIT */
/* single_product_tmpl.h - products of two functions of few bands: both as sums of cosines and sines
 * along eight circles of height, a lane each, multiplied there and integrated by Gauss's rule. */
#ifndef LAMPION_KERNELS_SINGLE_PRODUCT_TMPL_H
#define LAMPION_KERNELS_SINGLE_PRODUCT_TMPL_H

#include "src/base/tables.h"
#include "src/base/tables_few.h"
#include "src/kernels/lanes.h"
#include "src/kernels/single.h"

typedef float product_four __attribute__((vector_size(16)));
typedef float product_eight __attribute__((vector_size(32)));

/* A series per lane: c[0] / 2 + Σ c[m] cos(m phi) + s[m] sin(m phi). */
typedef struct product_series {
    product_eight c[LMPI_SINGLE_BANDS], s[LMPI_SINGLE_BANDS];
} product_series;

LMPI_INLINE void product_series_of(int bands, const float *sh, product_series *to) {
    LMPI_UNROLL for (int m = 0; m < bands; m++) {
        product_eight c = { 0 }, s = { 0 };
        LMPI_UNROLL for (int l = m; l < bands; l++) {
            product_eight q;
            memcpy(&q, lmpi_table_product_in[lmpi_table_product_index(l, m)], sizeof q);
            c = l == m ? q * sh[l * l + l + m] : c + q * sh[l * l + l + m];
            s = l == m ? q * sh[l * l + l - m] : s + q * sh[l * l + l - m];
        }
        to->c[m] = c;
        to->s[m] = s;
    }
}

/* Adds twice the terms of orders i and j < i of two series: of i - j, and of i + j where there is
 * one. */
LMPI_INLINE void product_pair(int bands, int i, int j, const product_series *a,
                              const product_series *b, product_series *to) {
    const product_eight cosines = a->c[i] * b->c[j] + a->c[j] * b->c[i];
    const product_eight sines = a->s[i] * b->s[j] + a->s[j] * b->s[i];
    const product_eight mixed = a->s[i] * b->c[j] + a->c[j] * b->s[i];
    const product_eight other = a->c[i] * b->s[j] + a->s[j] * b->c[i];
    to->c[i - j] += cosines + sines;
    to->s[i - j] += mixed - other;
    if (i + j < bands) {
        to->c[i + j] += cosines - sines;
        to->s[i + j] += mixed + other;
    }
}

/* Computes twice the product's series. */
LMPI_INLINE void product_of_series(int bands, const product_series *a, const product_series *b,
                                   product_series *to) {
    to->c[0] = a->c[0] * b->c[0] * 0.5f;
    LMPI_UNROLL for (int m = 1; m < bands; m++) {
        to->c[m] = a->c[0] * b->c[m] + a->c[m] * b->c[0];
        to->s[m] = a->c[0] * b->s[m] + a->s[m] * b->c[0];
    }
    LMPI_UNROLL for (int i = 1; i < bands; i++) {
        const product_eight cosines = a->c[i] * b->c[i], sines = a->s[i] * b->s[i];
        to->c[0] += cosines + sines;
        if (2 * i < bands) {
            to->c[2 * i] += cosines - sines;
            to->s[2 * i] += a->s[i] * b->c[i] + a->c[i] * b->s[i];
        }
        LMPI_UNROLL for (int j = 1; j < bands; j++) {
            if (j < i)
                product_pair(bands, i, j, a, b, to);
        }
    }
}

/* Sums and differences of the upper and the lower half of the circles: coefficients of even l - m
 * are made of sums, those of odd l - m of differences. */
typedef struct product_halves {
    product_four c[LMPI_SINGLE_BANDS][2], s[LMPI_SINGLE_BANDS][2];
} product_halves;

LMPI_INLINE void product_fold(const product_eight *of, product_four to[2]) {
    const product_eight v = *of;
    const product_four above = __builtin_shufflevector(v, v, 0, 1, 2, 3);
    const product_four below = __builtin_shufflevector(v, v, 4, 5, 6, 7);
    to[0] = above + below;
    to[1] = above - below;
}

/* Returns the terms of coefficient i, one lane per height. */
LMPI_INLINE product_four product_terms(int i, const product_halves *of) {
    int l = 0;
    LMPI_UNROLL for (int k = 1; k < LMPI_SINGLE_BANDS; k++) l += k * k <= i;
    const int m = i - l * l - l, odd = (l + m) & 1;
    product_four factors;
    memcpy(&factors, lmpi_table_product_out[i], sizeof factors);
    return factors * (m < 0 ? of->s[-m][odd] : of->c[m][odd]);
}

LMPI_INLINE void product_integrate(int bands, const product_halves *of, float *sh) {
    const int count = bands * bands;
    LMPI_UNROLL for (int i = 0; i + 4 <= count; i += 4) {
        const product_four a = product_terms(i, of), b = product_terms(i + 1, of);
        const product_four c = product_terms(i + 2, of), d = product_terms(i + 3, of);
        const product_four ab =
            __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
        const product_four cd =
            __builtin_shufflevector(c, d, 0, 4, 1, 5) + __builtin_shufflevector(c, d, 2, 6, 3, 7);
        const product_four sums = __builtin_shufflevector(ab, cd, 0, 1, 4, 5) +
                                  __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
        memcpy(sh + i, &sums, sizeof sums);
    }
    if (count % 4 != 0) {
        const product_four last = product_terms(count - 1, of);
        sh[count - 1] = (last[0] + last[2]) + (last[1] + last[3]);
    }
}

/* Multiplies functions of two bands: Y_0 times a function is that function, scaled, and no other
 * terms remain. */
LMPI_INLINE void product_of_two_bands(const float *a, const float *b, float *c) {
    const float y0 = 0.282094792f;
    c[0] = y0 * ((a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]));
    LMPI_UNROLL for (int i = 1; i < 4; i++) c[i] = y0 * (a[0] * b[i] + a[i] * b[0]);
}

LMPI_INLINE void straight_multiply(int bands, const float *a, const float *b, float *c) {
    if (bands == 1) {
        c[0] = 0.282094792f * (a[0] * b[0]);
        return;
    }
    if (bands == 2) {
        product_of_two_bands(a, b, c);
        return;
    }
    product_series of_a, of_b, product;
    product_halves halves;
    product_series_of(bands, a, &of_a);
    product_series_of(bands, b, &of_b);
    product_of_series(bands, &of_a, &of_b, &product);
    LMPI_UNROLL for (int m = 0; m < bands; m++) {
        product_fold(&product.c[m], halves.c[m]);
        if (m > 0)
            product_fold(&product.s[m], halves.s[m]);
    }
    product_integrate(bands, &halves, c);
}

#endif
