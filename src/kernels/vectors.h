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

static void kernel_rotate(int bands, const float *matrices, const lmp_kernel_in *in, size_t count,
                          const lmp_kernel_out *out) {
    float LMP_ALIGNED before[2 * LMP_BANDS_MAX * LMP_LANES], after[2 * LMP_BANDS_MAX * LMP_LANES];
    for (size_t e = 0; e < count; e += LMP_LANES) {
        const size_t live = layout_live(count, e);
        const float *matrix = matrices;
        for (int l = 0; l < bands; l++) {
            const int side = 2 * l + 1;
            const size_t first = (size_t)(l * l), values = (size_t)side;
            const int read = in->planar && live == LMP_LANES;
            const int written = out->planar && live == LMP_LANES;
            const float *from = read ? in->at + first * in->stride + e : before;
            float *to = written ? out->at + first * out->stride + e : after;
            const size_t from_stride = read ? in->stride : LMP_LANES;
            const size_t to_stride = written ? out->stride : LMP_LANES;
            if (!read)
                layout_get(before, first, values, in, e, live);
            int row = 0;
            for (; row + ROTATE_ROWS <= side; row += ROTATE_ROWS)
                rotate_rows(ROTATE_ROWS, side, matrix + row * side, from, from_stride,
                            to + (size_t)row * to_stride, to_stride);
            for (; row < side; row++)
                rotate_rows(1, side, matrix + row * side, from, from_stride,
                            to + (size_t)row * to_stride, to_stride);
            if (!written)
                layout_put(after, first, values, out, e, live);
            matrix += side * side;
        }
    }
}

/* Every sum is sixteen partial sums, of the values v, v + 16, …, then a tree of them: the same bits
 * whether lanes are elements (planes) or values (rows). */
#define DOT_PARTS 16

static inline float dot_row(size_t values, const float *a, const float *b) {
    vf part[DOT_PARTS / LMP_LANES];
    LMP_UNROLL for (int i = 0; i < DOT_PARTS / LMP_LANES; i++) part[i] = vf_set(0);
    size_t v = 0;
    for (; v + DOT_PARTS <= values; v += DOT_PARTS)
        LMP_UNROLL for (int i = 0; i < DOT_PARTS / LMP_LANES; i++) part[i] =
            part[i] + vf_load(a + v + i * LMP_LANES) * vf_load(b + v + i * LMP_LANES);
    float sum[DOT_PARTS];
    memcpy(sum, part, sizeof sum);
    for (int i = 0; v < values; v++, i++)
        sum[i] = sum[i] + a[v] * b[v];
    for (int half = DOT_PARTS / 2; half; half /= 2)
        for (int i = 0; i < half; i++)
            sum[i] = sum[i] + sum[i + half];
    return sum[0];
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
    for (; e < count; e++) {
        const float *from_a = a->at + e * (a->planar ? 1 : a->stride);
        const float *from_b = b->at + e * (b->planar ? 1 : b->stride);
        if (a->planar || b->planar)
            dots[e] = dot_strided(values, from_a, a->planar ? a->stride : 1, from_b,
                                  b->planar ? b->stride : 1);
        else
            dots[e] = dot_row(values, from_a, from_b);
    }
}

#endif
