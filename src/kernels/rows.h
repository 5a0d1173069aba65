/* SPDX-License-Identifier: MIT */
/* rows.h - between planes and rows that lie anywhere: what surfaces reflect by, and their colors.
 */
#ifndef LAMPION_KERNELS_ROWS_H
#define LAMPION_KERNELS_ROWS_H

#include "src/kernels/layout.h"

LMP_INLINE size_t rows_offset(const lmp_kernel_rows *rows, size_t e) {
    return rows->at[e] * rows->stride;
}

#if LMP_LANES > 1

/* Four floats of rows e, e + 4, e + 8 …, a quarter each. */
LMP_INLINE vf rows_quarters(const float *const *row, size_t v) {
    const float *quarters[LMP_LANES / 4];
    LMP_UNROLL for (size_t g = 0; g < LMP_LANES / 4; g++) quarters[g] = row[4 * g] + v;
    return layout_quarters(quarters);
}

LMP_INLINE void rows_load4(const float *const *row, size_t v, size_t e, float *const *planes) {
    vf t[4];
    LMP_UNROLL for (int i = 0; i < 4; i++) t[i] = rows_quarters(row + i, v);
    layout_transpose4(t);
    LMP_UNROLL for (size_t i = 0; i < 4; i++) vf_store(planes[v + i] + e, t[i]);
}

static void kernel_load_rows(size_t values, const float *first, const lmp_kernel_rows *rows,
                             size_t count, float *const *planes) {
    for (size_t e = 0; e < count; e += LMP_LANES) {
        const float *row[LMP_LANES];
        LMP_UNROLL for (size_t i = 0; i < LMP_LANES; i++) row[i] =
            (const float *)(const void *)((const char *)first + rows_offset(rows, e + i));
        for (size_t v = 0; v + 4 <= values; v += 4)
            rows_load4(row, v, e, planes);
        /* The last four again, rather than what is left of them one by one. */
        if (values % 4 != 0)
            rows_load4(row, values - 4, e, planes);
    }
}

#else

static void kernel_load_rows(size_t values, const float *first, const lmp_kernel_rows *rows,
                             size_t count, float *const *planes) {
    for (size_t e = 0; e < count; e++)
        for (size_t v = 0; v < values; v++)
            planes[v][e] =
                ((const float *)(const void *)((const char *)first + rows_offset(rows, e)))[v];
}

#endif

/* A truncated series rings below 0; NaN stays. */
static void kernel_store_colors(const float *const planes[3], size_t count,
                                const lmp_kernel_rows *rows, float *first) {
    size_t e = 0;
#if LMP_LANES > 1
    for (; e + LMP_LANES <= count; e += LMP_LANES) {
        const vf zero = vf_set(0);
        vf t[4];
        LMP_UNROLL for (int i = 0; i < 3; i++) t[i] = vf_max(zero, vf_load(planes[i] + e)) + zero;
        t[3] = zero;
        layout_transpose4(t);
        LMP_UNROLL for (int i = 0; i < LMP_LANES; i++)
            memcpy((char *)first + rows_offset(rows, e + (size_t)i),
                   (const char *)&t[i % 4] + 16 * (i / 4), 3 * sizeof(float));
    }
#endif
    for (; e < count; e++) {
        float *to = (float *)(void *)((char *)first + rows_offset(rows, e));
        for (int i = 0; i < 3; i++)
            to[i] = planes[i][e] <= 0 ? 0 : planes[i][e];
    }
}

#endif
