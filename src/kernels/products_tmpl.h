/* SPDX-License-Identifier: MIT */
/* products_tmpl.h - sums of products of 16-bit coefficients and 16-bit weights, by the instructions
 * that each build has for them: integers, whose sums are exact, so that every build agrees. */
#ifndef LAMPION_KERNELS_PRODUCTS_TMPL_H
#define LAMPION_KERNELS_PRODUCTS_TMPL_H

#include "src/kernels/layout_tmpl.h"

/* Weights are 0 … SPLINE_ONE for 0 … 1. */
#define SPLINE_ONE 32767.0f

/* --- pairs of a preintegrated lobe ------------------------------------------------------------ */

#if LMPI_LANES > 1

/* Weights of the pairs of four columns: the pairs of element 4q + k have theirs in quarter q of
 * at[k]. pair_products(from, at[k]) gives, for elements k, k + 4, …, four sums of two products
 * each, of a row's coefficients and their weights. */
typedef struct pair_weights {
    vf at[4];
} pair_weights;

/* Sets the weights: low of the first slice, high of the second, 16 bits each. */
LMPI_INLINE void pair_weights_of(const vi low[4], const vi high[4], pair_weights *weights) {
    for (int k = 0; k < 4; k++) {
        const vi both = low[k] | high[k] << 16;
        memcpy(&weights->at[k], &both, sizeof both);
    }
    layout_transpose4(weights->at);
}

/* Returns the weighted sum of a row's columns and slices, in integers, whose sum is exact. */
LMPI_INLINE vi pair_sum(const pair_weights *weights, const int16_t *const *from) {
    vf products[4];
    vi sums[4];
    LMPI_UNROLL for (int k = 0; k < 4; k++) products[k] = pair_products(from + k, weights->at[k]);
    layout_transpose4(products);
    memcpy(sums, products, sizeof sums);
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

#else

/* Weights of a single element, whose pairs are read one by one and not packed. */
typedef struct pair_weights {
    vi low[4], high[4];
} pair_weights;

LMPI_INLINE void pair_weights_of(const vi low[4], const vi high[4], pair_weights *weights) {
    memcpy(weights->low, low, sizeof weights->low);
    memcpy(weights->high, high, sizeof weights->high);
}

LMPI_INLINE vi pair_sum(const pair_weights *weights, const int16_t *const *from) {
    vi sum = 0;
    for (int j = 0; j < 4; j++)
        sum += from[0][2 * j] * weights->low[j] + from[0][2 * j + 1] * weights->high[j];
    return sum;
}

#endif

/* --- texels of a preintegrated BRDF ----------------------------------------------------------- */

/* Four texels are TEXEL_PARTS registers of TEXEL_LANES. TEXEL_NUMBER(i) is the index in a row of
 * their number i; indices from 12 on belong to the next texel and mean nothing. texel_rows sums
 * four rows' texels, weighted: integers, whose sums are exact, so that every build agrees.
 * texel_columns spreads the weights of four columns to the numbers of their texels. */

#endif
