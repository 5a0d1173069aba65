/* SPDX-License-Identifier: MIT */
/* vectors_tmpl.h - rotation and dot product of many coefficient vectors. */
#ifndef LAMPION_KERNELS_VECTORS_TMPL_H
#define LAMPION_KERNELS_VECTORS_TMPL_H

#include "src/kernels/layout_tmpl.h"
#include "src/kernels/sh.h"

/* The most rows of a matrix that are applied side by side: they share each value's load. */
#define ROTATE_ROWS 8

LMPI_INLINE void rotate_rows(int rows, int side, const float *matrix, const float *from,
                             size_t from_stride, float *to, size_t to_stride) {
    vf sum[ROTATE_ROWS];
    LMPI_UNROLL for (int i = 0; i < rows; i++) sum[i] = matrix[i * side] * vf_load(from);
    for (int j = 1; j < side; j++) {
        const vf value = vf_load(from + (size_t)j * from_stride);
        LMPI_UNROLL for (int i = 0; i < rows; i++) sum[i] = sum[i] + matrix[i * side + j] * value;
    }
    LMPI_UNROLL for (int i = 0; i < rows; i++) vf_store(to + (size_t)i * to_stride, sum[i]);
}

/* Values that are transposed to planes together, at least a band. */
#define ROTATE_VALUES 272

/* Rotates bands first … end-1, whose planes begin at first^2. */
static inline void rotate_bands(int first, int end, const float *matrices, const float *from,
                                size_t from_stride, float *to, size_t to_stride) {
    for (int l = first; l < end; l++) {
        const int side = 2 * l + 1;
        int row = 0;
        for (; row + ROTATE_ROWS <= side; row += ROTATE_ROWS)
            rotate_rows(ROTATE_ROWS, side, matrices + row * side, from, from_stride,
                        to + (size_t)row * to_stride, to_stride);
        LMPI_UNROLL for (int rows = ROTATE_ROWS / 2; rows > 0; rows /= 2) if (side - row >= rows) {
            rotate_rows(rows, side, matrices + row * side, from, from_stride,
                        to + (size_t)row * to_stride, to_stride);
            row += rows;
        }
        matrices += side * side;
        from += (size_t)side * from_stride;
        to += (size_t)side * to_stride;
    }
}

static void kernel_rotate(int bands, const float *matrices, const lmpi_kernel_in *in, size_t count,
                          const lmpi_kernel_out *out) {
    float LMPI_ALIGNED before[ROTATE_VALUES * LMPI_LANES], after[ROTATE_VALUES * LMPI_LANES];
    for (size_t e = 0; e < count; e += LMPI_LANES) {
        const size_t live = layout_live(count, e);
        const int read = in->planar && live == LMPI_LANES;
        const int written = out->planar && live == LMPI_LANES;
        const float *matrix = matrices;
        for (int first = 0, end; first < bands; first = end) {
            const size_t begin = (size_t)(first * first);
            end = first + 1;
            while (end < bands && (end + 1) * (end + 1) - first * first <= ROTATE_VALUES)
                end++;
            const size_t values = (size_t)(end * end) - begin;
            if (!read)
                layout_get(before, begin, values, in, e, live);
            rotate_bands(first, end, matrix, read ? in->at + begin * in->stride + e : before,
                         read ? in->stride : LMPI_LANES,
                         written ? out->at + begin * out->stride + e : after,
                         written ? out->stride : LMPI_LANES);
            if (!written)
                layout_put(after, begin, values, out, e, live);
            for (int l = first; l < end; l++)
                matrix += (2 * l + 1) * (2 * l + 1);
        }
    }
}

/* Partial sums of a dot product: sixteen, of the values v, v + 16, …, then a tree of them, which
 * gives the same bits whether lanes are elements (planes) or values (rows). */
#define DOT_PARTS     16
#define DOT_REGISTERS (DOT_PARTS / LMPI_LANES)

/* Sums the products of a row: halves are added to halves until one register is left. */
LMPI_INLINE vf dot_row(size_t values, const float *a, const float *b) {
    vf part[DOT_REGISTERS];
    LMPI_UNROLL for (int i = 0; i < DOT_REGISTERS; i++) part[i] = vf_set(0);
    size_t v = 0;
    for (; v + DOT_PARTS <= values; v += DOT_PARTS)
        LMPI_UNROLL for (int i = 0; i < DOT_REGISTERS; i++) part[i] =
            part[i] + vf_load(a + v + i * LMPI_LANES) * vf_load(b + v + i * LMPI_LANES);
    LMPI_UNROLL for (int i = 0; i < DOT_REGISTERS && v < values; i++, v += LMPI_LANES) {
        /* A partial sum is never -0, so the zeros past the end leave it alone. */
        const int left = values - v < LMPI_LANES ? (int)(values - v) : LMPI_LANES;
        part[i] =
            part[i] + (left < LMPI_LANES ? vf_load_first(a + v, left) * vf_load_first(b + v, left)
                                         : vf_load(a + v) * vf_load(b + v));
    }
    LMPI_UNROLL for (int half = DOT_REGISTERS / 2; half; half /= 2)
        LMPI_UNROLL for (int i = 0; i < half; i++) part[i] = part[i] + part[i + half];
    return part[0];
}

/* Computes the dot products of a full block of rows: lanes are values, then elements for the rest
 * of the tree. */
static inline vf dot_rows(size_t values, const lmpi_kernel_in *a, const lmpi_kernel_in *b,
                          size_t element) {
    vf part[LMPI_LANES];
    if (LMPI_LANES == 4) {
        /* Short rows are transposed in registers: through memory, a load would wait for its
         * stores. */
        LMPI_UNROLL for (size_t e = 0; e < LMPI_LANES; e++) part[e] =
            dot_row(values, a->at + (element + e) * a->stride, b->at + (element + e) * b->stride);
        layout_transpose4(part);
    } else {
        float LMPI_ALIGNED rows[LMPI_LANES * LMPI_LANES], planes[LMPI_LANES * LMPI_LANES];
        const lmpi_kernel_in parts = { rows, LMPI_LANES, 0 };
        for (size_t e = 0; e < LMPI_LANES; e++)
            vf_store(rows + e * LMPI_LANES, dot_row(values, a->at + (element + e) * a->stride,
                                                    b->at + (element + e) * b->stride));
        layout_get(planes, 0, LMPI_LANES, &parts, 0, LMPI_LANES);
        LMPI_UNROLL for (int i = 0; i < LMPI_LANES; i++) part[i] = vf_load(planes + i * LMPI_LANES);
    }
    LMPI_UNROLL for (int half = LMPI_LANES / 2; half; half /= 2)
        LMPI_UNROLL for (int i = 0; i < half; i++) part[i] = part[i] + part[i + half];
    return part[0];
}

static inline vf dot_planes(size_t values, const float *a, size_t a_stride, const float *b,
                            size_t b_stride) {
    vf part[DOT_PARTS];
    LMPI_UNROLL for (int i = 0; i < DOT_PARTS; i++) part[i] = vf_set(0);
    size_t v = 0;
    for (; v + DOT_PARTS <= values; v += DOT_PARTS)
        LMPI_UNROLL for (int i = 0; i < DOT_PARTS; i++) part[i] =
            part[i] +
            vf_load(a + (v + (size_t)i) * a_stride) * vf_load(b + (v + (size_t)i) * b_stride);
    LMPI_UNROLL for (int i = 0; i < DOT_PARTS - 1; i++) if (v + (size_t)i < values) part[i] =
        part[i] + vf_load(a + (v + (size_t)i) * a_stride) * vf_load(b + (v + (size_t)i) * b_stride);
    LMPI_UNROLL for (int half = DOT_PARTS / 2; half; half /= 2)
        LMPI_UNROLL for (int i = 0; i < half; i++) part[i] = part[i] + part[i + half];
    return part[0];
}

/* Computes one dot product of values a stride apart. */
static inline float dot_strided(size_t values, const float *a, size_t a_stride, const float *b,
                                size_t b_stride) {
    float part[DOT_PARTS] = { 0 };
    for (size_t v = 0; v < values; v++)
        part[v % DOT_PARTS] = part[v % DOT_PARTS] + a[v * a_stride] * b[v * b_stride];
    for (int half = DOT_PARTS / 2; half; half /= 2)
        for (int i = 0; i < half; i++)
            part[i] = part[i] + part[i + half];
    return part[0];
}

static void kernel_dot(size_t values, const lmpi_kernel_in *a, const lmpi_kernel_in *b,
                       size_t count, float *dots) {
    size_t e = 0;
    if (a->planar && b->planar)
        for (; e + LMPI_LANES <= count; e += LMPI_LANES)
            vf_store(dots + e, dot_planes(values, a->at + e, a->stride, b->at + e, b->stride));
    else if (!a->planar && !b->planar)
        for (; e + LMPI_LANES <= count; e += LMPI_LANES)
            vf_store(dots + e, dot_rows(values, a, b, e));
    for (; e < count; e++)
        dots[e] =
            dot_strided(values, a->at + e * (a->planar ? 1 : a->stride), a->planar ? a->stride : 1,
                        b->at + e * (b->planar ? 1 : b->stride), b->planar ? b->stride : 1);
}

#endif
