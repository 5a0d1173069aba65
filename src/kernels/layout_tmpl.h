/* SPDX-License-Identifier: MIT */
/* layout_tmpl.h - converts between planes of lanes, which the kernels compute, and rows, which
 * engines store.
 *
 * A "block" is LMPI_LANES elements; its values lie in planes of LMPI_LANES floats each. All is done
 * by groups of four values of four elements, with two shuffles per register: what has to cross the
 * quarters of a register crosses them on the way from or to memory. AVX2 loads half registers and
 * stores whole ones, where there is one store a cycle; the others load whole ones and store
 * quarters. */
#ifndef LAMPION_KERNELS_LAYOUT_TMPL_H
#define LAMPION_KERNELS_LAYOUT_TMPL_H

#include "src/kernels/arrays.h"
#include "src/kernels/lanes.h"

#if LMPI_LANES > 1

/* Transposes groups of four lanes: a0…a3, b0…b3, c, d become a0 b0 c0 d0, then a1 b1 c1 d1, … It is
 * its own inverse. */
LMPI_INLINE void layout_transpose4(vf v[4]) {
    const vf ab0 = LMPI_SHUFFLE(v[0], v[1], 0, 1, 0, 1), ab2 = LMPI_SHUFFLE(v[0], v[1], 2, 3, 2, 3);
    const vf cd0 = LMPI_SHUFFLE(v[2], v[3], 0, 1, 0, 1), cd2 = LMPI_SHUFFLE(v[2], v[3], 2, 3, 2, 3);
    v[0] = LMPI_SHUFFLE(ab0, cd0, 0, 2, 0, 2);
    v[1] = LMPI_SHUFFLE(ab0, cd0, 1, 3, 1, 3);
    v[2] = LMPI_SHUFFLE(ab2, cd2, 0, 2, 0, 2);
    v[3] = LMPI_SHUFFLE(ab2, cd2, 1, 3, 1, 3);
}

/* Stores lanes 4g … 4g+3. */
LMPI_INLINE void layout_store_quarter(float *to, vf v, int g) {
    vf4 part;
    memcpy(&part, (const char *)&v + 16 * g, sizeof part);
    memcpy(to, &part, sizeof part);
}

/* Loads quarter g from from[g]. */
LMPI_INLINE vf layout_quarters(const float *const from[LMPI_LANES / 4]) {
    vf4 quarters[LMPI_LANES / 4];
    LMPI_UNROLL for (int g = 0; g < LMPI_LANES / 4; g++)
        memcpy(&quarters[g], from[g], sizeof *quarters);
    return vf_join(quarters);
}

/* Loads quarter g from from[g * step]. */
LMPI_INLINE vf layout_load_quarters(const float *from, size_t step) {
    const float *quarters[LMPI_LANES / 4];
    LMPI_UNROLL for (size_t g = 0; g < LMPI_LANES / 4; g++) quarters[g] = from + g * step;
    return layout_quarters(quarters);
}

/* Writes four registers as rows. The row's address is hidden, because compilers would otherwise
 * hold every one, in vector registers if need be. */
LMPI_INLINE void layout_write4(const vf *values, float *row, size_t stride) {
    vf t[4] = { values[0], values[1], values[2], values[3] };
    layout_transpose4(t);
    LMPI_UNROLL for (int e = 0; e < LMPI_LANES; e++) {
        layout_store_quarter(row, t[e % 4], e / 4);
        row += stride;
        LMPI_OPAQUE(row);
    }
}

/* Writes three registers as rows, and leaves what follows a row alone: of rows that touch, a store
 * of four values writes the first of the next row, which that row then replaces. */
LMPI_INLINE void layout_write3(const vf *values, float *row, size_t stride) {
    vf t[4] = { values[0], values[1], values[2], values[2] };
    layout_transpose4(t);
    if (stride == 3) {
        LMPI_UNROLL for (int e = 0; e < LMPI_LANES - 1; e++)
            layout_store_quarter(row + 3 * e, t[e % 4], e / 4);
        memcpy(row + 3 * (LMPI_LANES - 1), (const char *)&t[3] + 4 * (LMPI_LANES - 4),
               3 * sizeof(float));
        return;
    }
    LMPI_UNROLL for (int e = 0; e < LMPI_LANES; e++) {
        memcpy(row, (const char *)&t[e % 4] + 16 * (e / 4), 3 * sizeof(float));
        row += stride;
        LMPI_OPAQUE(row);
    }
}

/* Writes three registers or more as rows, without the memory of a block. */
LMPI_INLINE void layout_write(int count, const vf *values, float *rows, size_t stride) {
    if (count == 3)
        layout_write3(values, rows, stride);
    LMPI_UNROLL for (int v = 0; v + 4 <= count; v += 4) layout_write4(values + v, rows + v, stride);
    /* The last four are written again, which is faster than writing what is left one by one. */
    if (count > 4 && count % 4 != 0)
        layout_write4(values + count - 4, rows + count - 4, stride);
}

/* Writes three or four planes of a full block as rows. */
LMPI_INLINE void layout_rows4(const float *block, size_t plane, float *row, size_t stride) {
    vf t[4];
    LMPI_UNROLL for (size_t i = 0; i < 4; i++) t[i] = vf_load(block + i * plane);
    layout_write4(t, row, stride);
}
LMPI_INLINE void layout_rows3(const float *block, size_t plane, float *row, size_t stride) {
    vf t[3];
    LMPI_UNROLL for (size_t i = 0; i < 3; i++) t[i] = vf_load(block + i * plane);
    layout_write3(t, row, stride);
}

/* Writes eight values of each element, by whole registers. */
LMPI_INLINE void layout_rows8(const float *block, size_t plane, float *row, size_t stride) {
    LMPI_UNROLL for (int quarter = 0; quarter < LMPI_LANES; quarter += 4) {
        vf t[4];
        LMPI_UNROLL for (size_t i = 0; i < 4; i++) t[i] =
            layout_load_quarters(block + i * plane + quarter, 4 * plane);
        layout_transpose4(t);
        LMPI_UNROLL for (int e = 0; e < 4; e++) {
            vf_store(row, t[e]);
            row += stride;
            LMPI_OPAQUE(row);
        }
    }
}

/* Writes sixteen values of each element, one cache line after another: the store buffer merges
 * neighbors. */
LMPI_INLINE void layout_rows16(const float *block, size_t plane, float *row, size_t stride) {
    vf t[16];
    LMPI_UNROLL for (size_t i = 0; i < 16; i++) t[i] = vf_load(block + i * plane);
    LMPI_UNROLL for (int i = 0; i < 16; i += 4) layout_transpose4(t + i);
    LMPI_UNROLL for (int e = 0; e < LMPI_LANES; e++) {
        LMPI_UNROLL for (int i = 0; i < 4; i++)
            layout_store_quarter(row + 4 * i, t[4 * i + e % 4], e / 4);
        row += stride;
        LMPI_OPAQUE(row);
    }
}

/* Values that are written together: AVX2 stores whole registers, the others cache lines. */
#define LAYOUT_GROUP (LMPI_LANES == 8 ? 8 : 16)
LMPI_INLINE void layout_rows_group(const float *block, size_t plane, float *row, size_t stride) {
    if (LMPI_LANES == 8)
        layout_rows8(block, plane, row, stride);
    else
        layout_rows16(block, plane, row, stride);
}

#if LMPI_LANES == 16
#define LAYOUT_QUARTERS(a, b, i, j)                                                                \
    __builtin_shufflevector(a, b, 4 * (i), 4 * (i) + 1, 4 * (i) + 2, 4 * (i) + 3, 4 * (j),         \
                            4 * (j) + 1, 4 * (j) + 2, 4 * (j) + 3, 16 + 4 * (i), 17 + 4 * (i),     \
                            18 + 4 * (i), 19 + 4 * (i), 16 + 4 * (j), 17 + 4 * (j), 18 + 4 * (j),  \
                            19 + 4 * (j))

/* Does layout_transpose4 with quarters of registers for lanes. */
LMPI_INLINE void layout_transpose_quarters(vf v[4]) {
    const vf ab0 = LAYOUT_QUARTERS(v[0], v[1], 0, 2), ab1 = LAYOUT_QUARTERS(v[0], v[1], 1, 3);
    const vf cd0 = LAYOUT_QUARTERS(v[2], v[3], 0, 2), cd1 = LAYOUT_QUARTERS(v[2], v[3], 1, 3);
    v[0] = LAYOUT_QUARTERS(ab0, cd0, 0, 2);
    v[1] = LAYOUT_QUARTERS(ab1, cd1, 0, 2);
    v[2] = LAYOUT_QUARTERS(ab0, cd0, 1, 3);
    v[3] = LAYOUT_QUARTERS(ab1, cd1, 1, 3);
}

/* Writes as many values as there are lanes of a full block, by whole registers. */
LMPI_INLINE void layout_square(const float *block, float *row, size_t stride) {
    vf t[16];
    LMPI_UNROLL for (int i = 0; i < 16; i++) t[i] = vf_load(block + i * LMPI_LANES);
    LMPI_UNROLL for (int i = 0; i < 16; i += 4) layout_transpose4(t + i);
    LMPI_UNROLL for (int j = 0; j < 4; j++) {
        vf q[4] = { t[j], t[4 + j], t[8 + j], t[12 + j] };
        layout_transpose_quarters(q);
        LMPI_UNROLL for (int g = 0; g < 4; g++) vf_store(row + (size_t)(4 * g + j) * stride, q[g]);
    }
}
#else
LMPI_INLINE void layout_square(const float *block, float *row, size_t stride) {
    if (LMPI_LANES == 8)
        layout_rows_group(block, LMPI_LANES, row, stride);
    else
        layout_rows4(block, LMPI_LANES, row, stride);
}
#endif

/* Loads four values of each lane's row from rows[lane] + at on, one register per value. */
LMPI_INLINE void layout_load4(const float *const rows[LMPI_LANES], size_t at, vf v[4]) {
    LMPI_UNROLL for (int i = 0; i < 4; i++) {
        const float *quarters[LMPI_LANES / 4];
        LMPI_UNROLL for (int g = 0; g < LMPI_LANES / 4; g++) quarters[g] = rows[4 * g + i] + at;
        v[i] = layout_quarters(quarters);
    }
    layout_transpose4(v);
}

/* Reads rows of four values into the planes of a block. */
LMPI_INLINE void layout_planes4(const float *row, size_t stride, float *block) {
    vf t[4];
    LMPI_UNROLL for (int i = 0; i < 4; i++) t[i] =
        layout_load_quarters(row + (size_t)i * stride, 4 * stride);
    layout_transpose4(t);
    LMPI_UNROLL for (int i = 0; i < 4; i++) vf_store(block + i * LMPI_LANES, t[i]);
}

/* Writes planes of a full block as rows where that pays; returns whether it did. */
LMPI_INLINE int layout_full_rows(const float *planes, size_t plane, size_t values, float *rows,
                                 size_t stride) {
    if (values == 3) {
        layout_rows3(planes, plane, rows, stride);
        return 1;
    }
    if (values < 4)
        return 0;
    size_t v = 0;
    for (; v + LAYOUT_GROUP <= values; v += LAYOUT_GROUP)
        layout_rows_group(planes + v * plane, plane, rows + v, stride);
    for (; v + 4 <= values; v += 4)
        layout_rows4(planes + v * plane, plane, rows + v, stride);
    /* The last four are written again, which is faster than writing what is left one by one. */
    if (v < values)
        layout_rows4(planes + (values - 4) * plane, plane, rows + values - 4, stride);
    return 1;
}

/* Reads rows into the planes of a full block where that pays; returns whether it did. */
LMPI_INLINE int layout_full_planes(const float *rows, size_t stride, size_t values, float *block) {
    if (values < 4)
        return 0;
    size_t v = 0;
    for (; v + 4 <= values; v += 4)
        layout_planes4(rows + v, stride, block + v * LMPI_LANES);
    if (v < values)
        layout_planes4(rows + values - 4, stride, block + (values - 4) * LMPI_LANES);
    return 1;
}

#else

/* With one lane, rows and planes are the same. */
LMPI_INLINE void layout_write(int count, const vf *values, float *rows, size_t stride) {
    (void)count, (void)values, (void)rows, (void)stride;
}
LMPI_INLINE void layout_transpose4(vf v[4]) {
    (void)v;
}
LMPI_INLINE void layout_square(const float *block, float *row, size_t stride) {
    (void)stride;
    *row = *block;
}
LMPI_INLINE void layout_load4(const float *const rows[1], size_t at, vf v[4]) {
    memcpy(v, rows[0] + at, 4 * sizeof *v);
}
LMPI_INLINE void layout_planes4(const float *row, size_t stride, float *block) {
    (void)stride;
    memcpy(block, row, 4 * sizeof *block);
}
LMPI_INLINE int layout_full_rows(const float *planes, size_t plane, size_t values, float *rows,
                                 size_t stride) {
    (void)planes, (void)plane, (void)values, (void)rows, (void)stride;
    return 0;
}
LMPI_INLINE int layout_full_planes(const float *rows, size_t stride, size_t values, float *block) {
    (void)rows, (void)stride, (void)values, (void)block;
    return 0;
}

#endif

/* Writes `values` planes, `plane` floats apart, as rows; `live` elements of them exist. The planes'
 * address is hidden: on the stack, written by pointers and read relative to the stack pointer, they
 * take a Zen 4 up to twice the time. */
LMPI_INLINE void layout_rows_of(const float *planes, size_t plane, size_t values, float *rows,
                                size_t stride, size_t live) {
    if (LMPI_LANES > 1)
        LMPI_OPAQUE(planes);
    if (live == LMPI_LANES && layout_full_rows(planes, plane, values, rows, stride))
        return;
    for (size_t v = 0; v < values; v++)
        for (size_t e = 0; e < live; e++)
            rows[e * stride + v] = planes[v * plane + e];
}

/* Writes the planes of a block as rows. */
static inline void layout_rows(const float *block, size_t values, float *rows, size_t stride,
                               size_t live) {
    layout_rows_of(block, LMPI_LANES, values, rows, stride, live);
}

/* Copy a plane's `live` elements from a block, and to one; lanes past them are 0. */
LMPI_INLINE void layout_put_plane(float *to, const float *plane, size_t live) {
    if (live == LMPI_LANES)
        vf_store(to, vf_load(plane));
    else
        vf_store_first(to, vf_load(plane), (int)live);
}
LMPI_INLINE void layout_get_plane(float *plane, const float *from, size_t live) {
    vf_store(plane, live == LMPI_LANES ? vf_load(from) : vf_load_first(from, (int)live));
}

/* Writes `values` planes of a block to the output, from value `first` of the elements on. */
static inline void layout_put(const float *block, size_t first, size_t values,
                              const lmpi_kernel_out *out, size_t element, size_t live) {
    if (!out->planar) {
        layout_rows(block, values, out->at + element * out->stride + first, out->stride, live);
        return;
    }
    float *to = out->at + first * out->stride + element;
    for (size_t v = 0; v < values; v++)
        layout_put_plane(to + v * out->stride, block + v * LMPI_LANES, live);
}

/* Reads values first … first+values-1 of a block's elements into planes; lanes past `live` are 0.
 */
static inline void layout_get(float *block, size_t first, size_t values, const lmpi_kernel_in *in,
                              size_t element, size_t live) {
    const float *from =
        in->at + (in->planar ? first * in->stride + element : element * in->stride + first);
    if (!in->planar && live == LMPI_LANES && layout_full_planes(from, in->stride, values, block))
        return;
    for (size_t v = 0; v < values; v++) {
        float *plane = block + v * LMPI_LANES;
        if (in->planar)
            layout_get_plane(plane, from + v * in->stride, live);
        else
            for (size_t e = 0; e < LMPI_LANES; e++)
                plane[e] = e < live ? from[e * in->stride + v] : 0;
    }
}

/* Does layout_put with values that are added to the output. It is not inlined, because it would be
 * repeated for each number of bands that has a code of its own. */
static LMPI_NOINLINE void layout_add(const float *block, size_t first, size_t values,
                                     const lmpi_kernel_out *out, size_t element, size_t live) {
    enum { SOME = 16 };
    const lmpi_kernel_in in = { out->at, out->stride, out->planar };
    float LMPI_ALIGNED sums[SOME * LMPI_LANES];
    for (size_t v = 0, some; v < values; v += some) {
        some = values - v < SOME ? values - v : SOME;
        layout_get(sums, first + v, some, &in, element, live);
        for (size_t i = 0; i < some * LMPI_LANES; i += LMPI_LANES)
            vf_store(sums + i, vf_load(sums + i) + vf_load(block + v * LMPI_LANES + i));
        layout_put(sums, first + v, some, out, element, live);
    }
}

/* Returns how many elements of a block exist. */
LMPI_INLINE size_t layout_live(size_t count, size_t element) {
    return count - element < LMPI_LANES ? count - element : LMPI_LANES;
}

#endif
