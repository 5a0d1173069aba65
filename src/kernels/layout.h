/* SPDX-License-Identifier: MIT */
/* layout.h - between planes of lanes, which the kernels compute, and rows, which engines store.
 *
 * A "block" is LMP_LANES elements; its values lie in planes of LMP_LANES floats each. All is done
 * by four values of four elements, two shuffles a register: what has to cross the quarters of a
 * register crosses them on the way from or to memory. AVX2 loads half registers and stores whole
 * ones, where there is one store a cycle; the others load whole ones and store quarters. */
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

/* Quarter g from from[g]. By insertions: put together in memory, a register would wait for its
 * stores. */
LMP_INLINE vf layout_quarters(const float *const from[LMP_LANES / 4]) {
#if LMP_LANES == 16
    __m512 v = _mm512_castps128_ps512(_mm_loadu_ps(from[0]));
    v = _mm512_insertf32x4(v, _mm_loadu_ps(from[1]), 1);
    v = _mm512_insertf32x4(v, _mm_loadu_ps(from[2]), 2);
    return (vf)_mm512_insertf32x4(v, _mm_loadu_ps(from[3]), 3);
#elif LMP_LANES == 8
    return (vf)_mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(from[0])),
                                    _mm_loadu_ps(from[1]), 1);
#else
    return vf_load(from[0]);
#endif
}

/* Quarter g from from[g * step]. */
LMP_INLINE vf layout_load_quarters(const float *from, size_t step) {
    const float *quarters[LMP_LANES / 4];
    LMP_UNROLL for (size_t g = 0; g < LMP_LANES / 4; g++) quarters[g] = from + g * step;
    return layout_quarters(quarters);
}

/* Four planes of a full block as rows. The row is hidden, for the compilers would hold every one,
 * in vector registers if need be. */
LMP_INLINE void layout_rows4(const float *block, size_t plane, float *row, size_t stride) {
    vf t[4];
    LMP_UNROLL for (size_t i = 0; i < 4; i++) t[i] = vf_load(block + i * plane);
    layout_transpose4(t);
    LMP_UNROLL for (int e = 0; e < LMP_LANES; e++) {
        layout_store_quarter(row, t[e % 4], e / 4);
        row += stride;
        LMP_OPAQUE(row);
    }
}

/* Of four planes three, without what follows a row. */
LMP_INLINE void layout_rows3(const float *block, size_t plane, float *row, size_t stride) {
    vf t[4];
    LMP_UNROLL for (size_t i = 0; i < 3; i++) t[i] = vf_load(block + i * plane);
    t[3] = t[2];
    layout_transpose4(t);
    LMP_UNROLL for (int e = 0; e < LMP_LANES; e++) {
        memcpy(row, (const char *)&t[e % 4] + 16 * (e / 4), 3 * sizeof(float));
        row += stride;
        LMP_OPAQUE(row);
    }
}

#if LMP_LANES == 8
#define LAYOUT_GROUP 8
LMP_INLINE void layout_rows_group(const float *block, size_t plane, float *row, size_t stride) {
    LMP_UNROLL for (int quarter = 0; quarter < LMP_LANES; quarter += 4) {
        vf t[4];
        LMP_UNROLL for (size_t i = 0; i < 4; i++) t[i] =
            layout_load_quarters(block + i * plane + quarter, 4 * plane);
        layout_transpose4(t);
        LMP_UNROLL for (int e = 0; e < 4; e++) {
            vf_store(row, t[e]);
            row += stride;
            LMP_OPAQUE(row);
        }
    }
}
#else
#if LMP_LANES == 16
#define LAYOUT_QUARTERS(a, b, i, j)                                                                \
    __builtin_shufflevector(a, b, 4 * (i), 4 * (i) + 1, 4 * (i) + 2, 4 * (i) + 3, 4 * (j),         \
                            4 * (j) + 1, 4 * (j) + 2, 4 * (j) + 3, 16 + 4 * (i), 17 + 4 * (i),     \
                            18 + 4 * (i), 19 + 4 * (i), 16 + 4 * (j), 17 + 4 * (j), 18 + 4 * (j),  \
                            19 + 4 * (j))

/* The same of quarters of registers. */
LMP_INLINE void layout_transpose_quarters(vf v[4]) {
    const vf ab0 = LAYOUT_QUARTERS(v[0], v[1], 0, 2), ab1 = LAYOUT_QUARTERS(v[0], v[1], 1, 3);
    const vf cd0 = LAYOUT_QUARTERS(v[2], v[3], 0, 2), cd1 = LAYOUT_QUARTERS(v[2], v[3], 1, 3);
    v[0] = LAYOUT_QUARTERS(ab0, cd0, 0, 2);
    v[1] = LAYOUT_QUARTERS(ab1, cd1, 0, 2);
    v[2] = LAYOUT_QUARTERS(ab0, cd0, 1, 3);
    v[3] = LAYOUT_QUARTERS(ab1, cd1, 1, 3);
}
#endif

/* A cache line after the other: the store buffer merges neighbors. */
#define LAYOUT_GROUP 16
LMP_INLINE void layout_rows_group(const float *block, size_t plane, float *row, size_t stride) {
    vf t[16];
    LMP_UNROLL for (size_t i = 0; i < 16; i++) t[i] = vf_load(block + i * plane);
    LMP_UNROLL for (int i = 0; i < 16; i += 4) layout_transpose4(t + i);
    LMP_UNROLL for (int e = 0; e < LMP_LANES; e++) {
        LMP_UNROLL for (int i = 0; i < 4; i++)
            layout_store_quarter(row + 4 * i, t[4 * i + e % 4], e / 4);
        row += stride;
        LMP_OPAQUE(row);
    }
}
#endif

/* As many values as there are lanes of a full block, to whole registers. */
LMP_INLINE void layout_square(const float *block, float *row, size_t stride) {
#if LMP_LANES == 16
    vf t[16];
    LMP_UNROLL for (int i = 0; i < 16; i++) t[i] = vf_load(block + i * LMP_LANES);
    LMP_UNROLL for (int i = 0; i < 16; i += 4) layout_transpose4(t + i);
    LMP_UNROLL for (int j = 0; j < 4; j++) {
        vf q[4] = { t[j], t[4 + j], t[8 + j], t[12 + j] };
        layout_transpose_quarters(q);
        LMP_UNROLL for (int g = 0; g < 4; g++) vf_store(row + (size_t)(4 * g + j) * stride, q[g]);
    }
#elif LMP_LANES == 8
    layout_rows_group(block, LMP_LANES, row, stride);
#else
    layout_rows4(block, LMP_LANES, row, stride);
#endif
}

/* The other way, of four values. */
LMP_INLINE void layout_planes4(const float *row, size_t stride, float *block) {
    vf t[4];
    LMP_UNROLL for (int i = 0; i < 4; i++) t[i] =
        layout_load_quarters(row + (size_t)i * stride, 4 * stride);
    layout_transpose4(t);
    LMP_UNROLL for (int i = 0; i < 4; i++) vf_store(block + i * LMP_LANES, t[i]);
}

#endif

/* Writes `values` planes, `plane` floats apart, as rows; `live` elements of them exist. Where the
 * planes are on the stack is hidden: written by pointers and read relative to the stack pointer,
 * they take a Zen 4 up to twice the time. */
LMP_INLINE void layout_rows_of(const float *planes, size_t plane, size_t values, float *rows,
                               size_t stride, size_t live) {
#if LMP_LANES > 1
    LMP_OPAQUE(planes);
    if (live == LMP_LANES && values >= 4) {
        size_t v = 0;
        for (; v + LAYOUT_GROUP <= values; v += LAYOUT_GROUP)
            layout_rows_group(planes + v * plane, plane, rows + v, stride);
        for (; v + 4 <= values; v += 4)
            layout_rows4(planes + v * plane, plane, rows + v, stride);
        /* The last four again, rather than what is left of them one by one. */
        if (v < values)
            layout_rows4(planes + (values - 4) * plane, plane, rows + values - 4, stride);
        return;
    }
    if (live == LMP_LANES && values == 3) {
        layout_rows3(planes, plane, rows, stride);
        return;
    }
#endif
    for (size_t v = 0; v < values; v++)
        for (size_t e = 0; e < live; e++)
            rows[e * stride + v] = planes[v * plane + e];
}

/* The planes of a block. */
static inline void layout_rows(const float *block, size_t values, float *rows, size_t stride,
                               size_t live) {
    layout_rows_of(block, LMP_LANES, values, rows, stride, live);
}

/* A plane's `live` elements, from a block and to one; the lanes past them are 0. */
LMP_INLINE void layout_put_plane(float *to, const float *plane, size_t live) {
    if (live == LMP_LANES)
        vf_store(to, vf_load(plane));
    else
        vf_store_first(to, vf_load(plane), (int)live);
}
LMP_INLINE void layout_get_plane(float *plane, const float *from, size_t live) {
    vf_store(plane, live == LMP_LANES ? vf_load(from) : vf_load_first(from, (int)live));
}

/* Writes `values` planes of a block, the values first … of an element, into the output. */
static inline void layout_put(const float *block, size_t first, size_t values,
                              const lmp_kernel_out *out, size_t element, size_t live) {
    if (!out->planar) {
        layout_rows(block, values, out->at + element * out->stride + first, out->stride, live);
        return;
    }
    float *to = out->at + first * out->stride + element;
    for (size_t v = 0; v < values; v++)
        layout_put_plane(to + v * out->stride, block + v * LMP_LANES, live);
}

/* Reads values first … first+values-1 of a block's elements into planes; lanes past `live` are 0.
 */
static inline void layout_get(float *block, size_t first, size_t values, const lmp_kernel_in *in,
                              size_t element, size_t live) {
    const float *from =
        in->at + (in->planar ? first * in->stride + element : element * in->stride + first);
#if LMP_LANES > 1
    if (!in->planar && live == LMP_LANES && values >= 4) {
        size_t v = 0;
        for (; v + 4 <= values; v += 4)
            layout_planes4(from + v, in->stride, block + v * LMP_LANES);
        if (v < values)
            layout_planes4(from + values - 4, in->stride, block + (values - 4) * LMP_LANES);
        return;
    }
#endif
    for (size_t v = 0; v < values; v++) {
        float *plane = block + v * LMP_LANES;
        if (in->planar)
            layout_get_plane(plane, from + v * in->stride, live);
        else
            for (size_t e = 0; e < LMP_LANES; e++)
                plane[e] = e < live ? from[e * in->stride + v] : 0;
    }
}

/* layout_put of what is added to the output. */
static inline void layout_add(const float *block, size_t first, size_t values,
                              const lmp_kernel_out *out, size_t element, size_t live) {
    enum { SOME = 16 };
    const lmp_kernel_in in = { out->at, out->stride, out->planar };
    float LMP_ALIGNED sums[SOME * LMP_LANES];
    for (size_t v = 0, some; v < values; v += some) {
        some = values - v < SOME ? values - v : SOME;
        layout_get(sums, first + v, some, &in, element, live);
        for (size_t i = 0; i < some * LMP_LANES; i += LMP_LANES)
            vf_store(sums + i, vf_load(sums + i) + vf_load(block + v * LMP_LANES + i));
        layout_put(sums, first + v, some, out, element, live);
    }
}

/* The elements of a block that exist. */
LMP_INLINE size_t layout_live(size_t count, size_t element) {
    return count - element < LMP_LANES ? count - element : LMP_LANES;
}

#endif
