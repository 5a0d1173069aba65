/* SPDX-License-Identifier: MIT */
/* rows_tmpl.h - converts between planes and rows anywhere: the parameters of surfaces, and their
 * colors. */
#ifndef LAMPION_KERNELS_ROWS_TMPL_H
#define LAMPION_KERNELS_ROWS_TMPL_H

#include "src/kernels/convert.h"
#include "src/kernels/layout_tmpl.h"

LMPI_INLINE size_t rows_offset(const lmpi_kernel_rows *rows, size_t e) {
    return rows->at[e] * rows->stride;
}

LMPI_INLINE void rows_load4(const float *const *row, size_t v, size_t e, float *const *planes) {
    vf t[4];
    layout_load4(row, v, t);
    LMPI_UNROLL for (size_t i = 0; i < 4; i++) vf_store(planes[v + i] + e, t[i]);
}

static void kernel_load_rows(size_t values, const float *first, const lmpi_kernel_rows *rows,
                             size_t count, float *const *planes) {
    for (size_t e = 0; e < count; e += LMPI_LANES) {
        const float *row[LMPI_LANES];
        LMPI_UNROLL for (size_t i = 0; i < LMPI_LANES; i++) row[i] =
            (const float *)(const void *)((const char *)first + rows_offset(rows, e + i));
        for (size_t v = 0; v + 4 <= values; v += 4)
            rows_load4(row, v, e, planes);
        /* The last four are read again, which is faster than reading what is left one by one. */
        if (values % 4 != 0)
            rows_load4(row, values - 4, e, planes);
    }
}

/* Stores colors clamped at 0, because a truncated series rings below it; NaN stays. One lane takes
 * the second loop, for WebAssembly may change the sign of a NaN that 0 is added to. */
static void kernel_store_colors(const float *const planes[3], size_t count,
                                const lmpi_kernel_rows *rows, float *first) {
    size_t e = 0;
    for (; LMPI_LANES > 1 && e + LMPI_LANES <= count; e += LMPI_LANES) {
        const vf zero = vf_set(0);
        vf t[4];
        LMPI_UNROLL for (int i = 0; i < 3; i++) t[i] = vf_max(zero, vf_load(planes[i] + e)) + zero;
        t[3] = zero;
        layout_transpose4(t);
        LMPI_UNROLL for (int i = 0; i < LMPI_LANES; i++)
            memcpy((char *)first + rows_offset(rows, e + (size_t)i),
                   (const char *)&t[i % 4] + 16 * (i / 4), 3 * sizeof(float));
    }
    for (; e < count; e++) {
        float *to = (float *)(void *)((char *)first + rows_offset(rows, e));
        for (int i = 0; i < 3; i++)
            to[i] = planes[i][e] <= 0 ? 0 : planes[i][e];
    }
}

#endif
