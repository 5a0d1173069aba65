/* SPDX-License-Identifier: MIT */
/* vectors.h - many coefficient vectors: rotation and dot product. */
#ifndef LAMPION_KERNELS_VECTORS_H
#define LAMPION_KERNELS_VECTORS_H

#include "src/kernels/layout.h"

/* Rows of a matrix that are applied side by side. */
#define ROTATE_ROWS 4

LMP_INLINE void rotate_rows(int rows, int side, const float *matrix, const float *from,
                            size_t from_stride, float *to, size_t to_stride) {
    vf sum[ROTATE_ROWS];
    LMP_UNROLL for (int i = 0; i < rows; i++) sum[i] = matrix[i * side] * vf_load(from);
    for (int j = 1; j < side; j++) {
        const vf value = vf_load(from + (size_t)j * from_stride);
        LMP_UNROLL for (int i = 0; i < rows; i++) sum[i] = sum[i] + matrix[i * side + j] * value;
    }
    LMP_UNROLL for (int i = 0; i < rows; i++) vf_store(to + (size_t)i * to_stride, sum[i]);
}

/* Values that are brought to planes together: a band at least. */
#define ROTATE_VALUES 272

/* Bands first … end-1, the planes of first^2 on. */
static inline void rotate_bands(int first, int end, const float *matrices, const float *from,
                                size_t from_stride, float *to, size_t to_stride) {
    for (int l = first; l < end; l++) {
        const int side = 2 * l + 1;
        int row = 0;
        for (; row + ROTATE_ROWS <= side; row += ROTATE_ROWS)
            rotate_rows(ROTATE_ROWS, side, matrices + row * side, from, from_stride,
                        to + (size_t)row * to_stride, to_stride);
        for (; row < side; row++)
            rotate_rows(1, side, matrices + row * side, from, from_stride,
                        to + (size_t)row * to_stride, to_stride);
        matrices += side * side;
        from += (size_t)side * from_stride;
        to += (size_t)side * to_stride;
    }
}

static void kernel_rotate(int bands, const float *matrices, const lmp_kernel_in *in, size_t count,
                          const lmp_kernel_out *out) {
    float LMP_ALIGNED before[ROTATE_VALUES * LMP_LANES], after[ROTATE_VALUES * LMP_LANES];
    for (size_t e = 0; e < count; e += LMP_LANES) {
        const size_t live = layout_live(count, e);
        const int read = in->planar && live == LMP_LANES;
        const int written = out->planar && live == LMP_LANES;
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
                         read ? in->stride : LMP_LANES,
                         written ? out->at + begin * out->stride + e : after,
                         written ? out->stride : LMP_LANES);
            if (!written)
                layout_put(after, begin, values, out, e, live);
            for (int l = first; l < end; l++)
                matrix += (2 * l + 1) * (2 * l + 1);
        }
    }
}

/* Every sum is sixteen partial sums, of the values v, v + 16, …, then a tree of them: the same bits
 * whether lanes are elements (planes) or values (rows). */
#define DOT_PARTS     16
#define DOT_REGISTERS (DOT_PARTS / LMP_LANES)

/* The partial sums of a row, halves added to halves until one register is left. */
LMP_INLINE vf dot_row(size_t values, const float *a, const float *b) {
    vf part[DOT_REGISTERS];
    LMP_UNROLL for (int i = 0; i < DOT_REGISTERS; i++) part[i] = vf_set(0);
    size_t v = 0;
    for (; v + DOT_PARTS <= values; v += DOT_PARTS)
        LMP_UNROLL for (int i = 0; i < DOT_REGISTERS; i++) part[i] =
            part[i] + vf_load(a + v + i * LMP_LANES) * vf_load(b + v + i * LMP_LANES);
    LMP_UNROLL for (int i = 0; i < DOT_REGISTERS && v < values; i++, v += LMP_LANES) {
        /* A partial sum is never -0, so the zeros past the end leave it alone. */
        const int left = values - v < LMP_LANES ? (int)(values - v) : LMP_LANES;
        part[i] =
            part[i] + (left < LMP_LANES ? vf_load_first(a + v, left) * vf_load_first(b + v, left)
                                        : vf_load(a + v) * vf_load(b + v));
    }
    LMP_UNROLL for (int half = DOT_REGISTERS / 2; half; half /= 2)
        LMP_UNROLL for (int i = 0; i < half; i++) part[i] = part[i] + part[i + half];
    return part[0];
}

/* A full block of rows: lanes are values, then elements for what is left of the tree. */
static inline vf dot_rows(size_t values, const lmp_kernel_in *a, const lmp_kernel_in *b,
                          size_t element) {
    vf part[LMP_LANES];
#if LMP_LANES == 4
    /* Short rows are transposed in registers: through memory, a load would wait for its stores. */
    LMP_UNROLL for (size_t e = 0; e < LMP_LANES; e++) part[e] =
        dot_row(values, a->at + (element + e) * a->stride, b->at + (element + e) * b->stride);
    layout_transpose4(part);
#else
    float LMP_ALIGNED rows[LMP_LANES * LMP_LANES], planes[LMP_LANES * LMP_LANES];
    const lmp_kernel_in parts = { rows, LMP_LANES, 0 };
    for (size_t e = 0; e < LMP_LANES; e++)
        vf_store(rows + e * LMP_LANES, dot_row(values, a->at + (element + e) * a->stride,
                                               b->at + (element + e) * b->stride));
    layout_get(planes, 0, LMP_LANES, &parts, 0, LMP_LANES);
    LMP_UNROLL for (int i = 0; i < LMP_LANES; i++) part[i] = vf_load(planes + i * LMP_LANES);
#endif
    LMP_UNROLL for (int half = LMP_LANES / 2; half; half /= 2)
        LMP_UNROLL for (int i = 0; i < half; i++) part[i] = part[i] + part[i + half];
    return part[0];
}

static inline vf dot_planes(size_t values, const float *a, size_t a_stride, const float *b,
                            size_t b_stride) {
    vf part[DOT_PARTS];
    LMP_UNROLL for (int i = 0; i < DOT_PARTS; i++) part[i] = vf_set(0);
    size_t v = 0;
    for (; v + DOT_PARTS <= values; v += DOT_PARTS)
        LMP_UNROLL for (int i = 0; i < DOT_PARTS; i++) part[i] =
            part[i] +
            vf_load(a + (v + (size_t)i) * a_stride) * vf_load(b + (v + (size_t)i) * b_stride);
    LMP_UNROLL for (int i = 0; i < DOT_PARTS - 1; i++) if (v + (size_t)i < values) part[i] =
        part[i] + vf_load(a + (v + (size_t)i) * a_stride) * vf_load(b + (v + (size_t)i) * b_stride);
    LMP_UNROLL for (int half = DOT_PARTS / 2; half; half /= 2)
        LMP_UNROLL for (int i = 0; i < half; i++) part[i] = part[i] + part[i + half];
    return part[0];
}

/* One element: values a stride apart. */
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

static void kernel_dot(size_t values, const lmp_kernel_in *a, const lmp_kernel_in *b, size_t count,
                       float *dots) {
    size_t e = 0;
    if (a->planar && b->planar)
        for (; e + LMP_LANES <= count; e += LMP_LANES)
            vf_store(dots + e, dot_planes(values, a->at + e, a->stride, b->at + e, b->stride));
    else if (!a->planar && !b->planar)
        for (; e + LMP_LANES <= count; e += LMP_LANES)
            vf_store(dots + e, dot_rows(values, a, b, e));
    for (; e < count; e++)
        dots[e] =
            dot_strided(values, a->at + e * (a->planar ? 1 : a->stride), a->planar ? a->stride : 1,
                        b->at + e * (b->planar ? 1 : b->stride), b->planar ? b->stride : 1);
}

#endif
