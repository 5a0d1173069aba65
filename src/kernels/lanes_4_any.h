/* SPDX-License-Identifier: MIT */
/* lanes_4_any.h - four lanes in plain C (lanes_4.h): what NEON and WebAssembly share. */
#ifndef LAMPION_KERNELS_LANES_4_ANY_H
#define LAMPION_KERNELS_LANES_4_ANY_H

#include <math.h>

#define LMPI_STREAMS 0

LMPI_INLINE void vf4_per_root(const vf4 *of, vf4 *per) {
    for (int i = 0; i < 4; i++)
        (*per)[i] = 1 / sqrtf((*of)[i]);
}

LMPI_INLINE vf pair_products(const int16_t *const *from, vf columns) {
    int16_t weights[2 * LMPI_LANES];
    int32_t sums[LMPI_LANES];
    memcpy(weights, &columns, sizeof weights);
    for (int i = 0; i < LMPI_LANES; i++) {
        const int16_t *row = from[i / 4 * 4] + 2 * (i % 4);
        sums[i] = row[0] * weights[2 * i] + row[1] * weights[2 * i + 1];
    }
    vf products;
    memcpy(&products, sums, sizeof sums);
    return products;
}

#define TEXEL_PARTS     3
#define TEXEL_LANES     4
#define TEXEL_NUMBER(i) (i)
typedef vf texel_lanes;
#define TEXEL_NUMBERS (TEXEL_PARTS * TEXEL_LANES)

#include "src/kernels/lanes_any.h"

#endif
