/* SPDX-License-Identifier: MIT */
/* convert.h - kernels that convert between planes and callers' storage: rows anywhere, halves. */
#ifndef LAMPION_KERNELS_CONVERT_H
#define LAMPION_KERNELS_CONVERT_H

#include "src/kernels/arrays.h"

/* Rows anywhere in memory: that of element e begins at[e] * stride bytes after the first. at is
 * readable like planes, and what is read past `count` must name rows, too. */
typedef struct lmpi_kernel_rows {
    const size_t *at;
    size_t stride;
} lmpi_kernel_rows;

typedef struct lmpi_convert_kernels {
    /* load_rows reads `values` planes, at least 4, from as many floats per row; store_colors writes
     * rows of three planes, clamped at 0. */
    void (*load_rows)(size_t values, const float *first, const lmpi_kernel_rows *rows, size_t count,
                      float *const *planes);
    void (*store_colors)(const float *const planes[3], size_t count, const lmpi_kernel_rows *rows,
                         float *first);
    /* Convert floats to binary16 and back (src/base/half.h). */
    void (*pack_half)(const float *values, size_t count, uint16_t *halves);
    void (*unpack_half)(const uint16_t *halves, size_t count, float *values);
} lmpi_convert_kernels;

#endif
