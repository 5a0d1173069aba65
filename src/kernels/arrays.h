/* SPDX-License-Identifier: MIT */
/* arrays.h - the arrays that kernels read and write.
 *
 * Element arrays (`const float *`) are planar and readable up to the next multiple of
 * LMPI_KERNEL_LANES_MAX elements; what is read past `count` must be finite, and is not used. */
#ifndef LAMPION_KERNELS_ARRAYS_H
#define LAMPION_KERNELS_ARRAYS_H

#include <lampion/base.h>

#define LMPI_KERNEL_LANES_MAX 16

/* Value v of element e lies at at[e * stride + v], or at at[v * stride + e] if planar; here alone
 * strides are in floats. */
typedef struct lmpi_kernel_out {
    float *at;
    size_t stride;
    int planar;
} lmpi_kernel_out;

typedef struct lmpi_kernel_in {
    const float *at;
    size_t stride;
    int planar;
} lmpi_kernel_in;

typedef struct lmpi_kernel_vec3 {
    const float *x, *y, *z;
} lmpi_kernel_vec3;

/* Floats of a cache line. */
#define LMPI_KERNEL_LINE 16

/* The most values of an element that a kernel streams, those of 10 bands. */
#define LMPI_KERNEL_STREAM_VALUES_MAX 100

#endif
