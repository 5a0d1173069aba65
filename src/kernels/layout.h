/* SPDX-License-Identifier: MIT */
/* layout.h - between planes of lanes, which the kernels compute, and rows, which engines store.
 *
 * A "block" is LMP_LANES elements; its values lie in planes of LMP_LANES floats each. Rows are made
 * four values by four elements at a time: two shuffles a plane, and the 16-byte pieces leave by
 * the store ports, which have room; a transposition down to whole registers would take four. */
#ifndef LAMPION_KERNELS_LAYOUT_H
#define LAMPION_KERNELS_LAYOUT_H

#include "src/kernels/kernels.h"
#include "src/kernels/lanes.h"

#if LMP_LANES > 1

typedef float vf4 __attribute__((vector_size(16)));

#if LMP_LANES == 4
#define LMP_SHUFFLE(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, 4 + (k), 4 + (l))
#elif LMP_LANES == 8
#define LMP_SHUFFLE(a, b, i, j, k, l)                                                              \
    __builtin_shufflevector(a, b, i, j, 8 + (k), 8 + (l), 4 + (i), 4 + (j), 12 + (k), 12 + (l))
#elif LMP_LANES == 16
#define LMP_SHUFFLE(a, b, i, j, k, l)                                                              \
    __builtin_shufflevector(a, b, i, j, 16 + (k), 16 + (l), 4 + (i), 4 + (j), 20 + (k), 20 + (l),  \
                            8 + (i), 8 + (j), 24 + (k), 24 + (l), 12 + (i), 12 + (j), 28 + (k),    \
                            28 + (l))
#endif

/* Of each four lanes a0…a3, b0…b3, c, d: a0 b0 c0 d0, then a1 b1 c1 d1, … It is its own inverse. */
LMP_INLINE void layout_transpose4(vf v[4]) {
    const vf ab0 = LMP_SHUFFLE(v[0], v[1], 0, 1, 0, 1), ab2 = LMP_SHUFFLE(v[0], v[1], 2, 3, 2, 3);
    const vf cd0 = LMP_SHUFFLE(v[2], v[3], 0, 1, 0, 1), cd2 = LMP_SHUFFLE(v[2], v[3], 2, 3, 2, 3);
    v[0] = LMP_SHUFFLE(ab0, cd0, 0, 2, 0, 2);
    v[1] = LMP_SHUFFLE(ab0, cd0, 1, 3, 1, 3);
    v[2] = LMP_SHUFFLE(ab2, cd2, 0, 2, 0, 2);
    v[3] = LMP_SHUFFLE(ab2, cd2, 1, 3, 1, 3);
}

/* Lanes 4g … 4g+3. */
LMP_INLINE void layout_store_quarter(float *to, vf v, int g) {
    vf4 part;
    memcpy(&part, (const char *)&v + 16 * g, sizeof part);
    memcpy(to, &part, sizeof part);
}

#endif

/* Writes `values` planes of a block as rows; `live` elements of it exist. */
static inline void layout_rows(const float *block, size_t values, float *rows, size_t stride,
                               size_t live) {
    size_t v = 0;
#if LMP_LANES > 1
    for (; live == LMP_LANES && v + 16 <= values; v += 16) {
        vf t[16];
        LMP_UNROLL for (int i = 0; i < 16; i++) t[i] = vf_load(block + (v + (size_t)i) * LMP_LANES);
        LMP_UNROLL for (int i = 0; i < 16; i += 4) layout_transpose4(t + i);
        /* A cache line after the other: the store buffer merges neighbours. The row is hidden, for
         * the compilers would hold all sixteen, in vector registers if need be. */
        float *row = rows + v;
        LMP_UNROLL for (int e = 0; e < LMP_LANES; e++) {
            LMP_UNROLL for (int i = 0; i < 4; i++)
                layout_store_quarter(row + 4 * i, t[4 * i + e % 4], e / 4);
            row += stride;
            LMP_OPAQUE(row);
        }
    }
    for (; live == LMP_LANES && v + 4 <= values; v += 4) {
        vf t[4];
        LMP_UNROLL for (int i = 0; i < 4; i++) t[i] = vf_load(block + (v + (size_t)i) * LMP_LANES);
        layout_transpose4(t);
        float *row = rows + v;
        LMP_UNROLL for (int e = 0; e < LMP_LANES; e++) {
            layout_store_quarter(row, t[e % 4], e / 4);
            row += stride;
            LMP_OPAQUE(row);
        }
    }
#endif
    for (; v < values; v++)
        for (size_t e = 0; e < live; e++)
            rows[e * stride + v] = block[v * LMP_LANES + e];
}

/* Writes `values` planes of a block, the values first … of an element, into the output. */
static inline void layout_put(const float *block, size_t first, size_t values,
                              const lmp_kernel_out *out, size_t element, size_t live) {
    if (!out->planar) {
        layout_rows(block, values, out->at + element * out->stride + first, out->stride, live);
        return;
    }
    for (size_t v = 0; v < values; v++)
        memcpy(out->at + (first + v) * out->stride + element, block + v * LMP_LANES,
               live * sizeof(float));
}

/* Reads values first … first+values-1 of a block's elements into planes; lanes past `live` are 0.
 */
static inline void layout_get(float *block, size_t first, size_t values, const lmp_kernel_in *in,
                              size_t element, size_t live) {
    size_t v = 0;
#if LMP_LANES > 1
    for (; !in->planar && live == LMP_LANES && v + 4 <= values; v += 4) {
        vf t[4];
        LMP_UNROLL for (int i = 0; i < 4; i++) LMP_UNROLL for (int g = 0; g < LMP_LANES / 4; g++)
            memcpy((char *)&t[i] + 16 * g,
                   in->at + (element + (size_t)(4 * g + i)) * in->stride + first + v, 16);
        layout_transpose4(t);
        LMP_UNROLL for (int i = 0; i < 4; i++) vf_store(block + (v + (size_t)i) * LMP_LANES, t[i]);
    }
#endif
    for (; v < values; v++) {
        float *plane = block + v * LMP_LANES;
        if (in->planar)
            memcpy(plane, in->at + (first + v) * in->stride + element, live * sizeof(float));
        else
            for (size_t e = 0; e < live; e++)
                plane[e] = in->at[(element + e) * in->stride + first + v];
        memset(plane + live, 0, (LMP_LANES - live) * sizeof(float));
    }
}

/* The elements of a block that exist. */
LMP_INLINE size_t layout_live(size_t count, size_t element) {
    return count - element < LMP_LANES ? count - element : LMP_LANES;
}

#endif
