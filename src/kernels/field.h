/* SPDX-License-Identifier: MIT */
/* field.h - kernels that compute the nodes of a field, and interpolate it at points. */
#ifndef LAMPION_KERNELS_FIELD_H
#define LAMPION_KERNELS_FIELD_H

#include "src/kernels/arrays.h"

/* Points in the cells of a grid, and the grid's nodes: per node a row of values, then rows of their
 * derivatives by x, by y and by z. Each row is `stride` floats, a multiple of
 * LMPI_KERNEL_LANES_MAX: all of them are read, so that a vector of 64 bytes lies in one cache line.
 */
typedef struct lmpi_kernel_cells {
    const float *nodes;
    size_t stride;
    lmp_vec3 cell;             /* edges of a cell */
    const uint32_t *corners;   /* 8 nodes per point; x varies fastest, then y, then z */
    lmpi_kernel_vec3 fraction; /* per point, 0 … 1 along the edges */
} lmpi_kernel_cells;

/* A brick of nodes at half the cells, laid out like lmpi_kernel_cells: 4 along x by 2 by 2, x
 * varying fastest; and the nodes of the two cells that they lie in, 3 along x by 2 by 2. */
typedef struct lmpi_kernel_brick {
    const float *from[12];
    size_t stride;
    lmp_vec3 cell; /* edges of the large cells */
    /* Nodes that the next call writes, or this brick's own: they are fetched while this brick is
     * computed, because nodes are far more than caches hold, and are not written in the order of
     * memory. */
    const float *next;
} lmpi_kernel_brick;

/* The most bands of a field. */
#define LMPI_KERNEL_FIELD_BANDS_MAX 10

typedef struct lmpi_field_kernels {
    /* Interpolates `values` values at points (Adini). */
    void (*interpolate)(size_t values, const lmpi_kernel_cells *cells, size_t count,
                        const lmpi_kernel_out *out);
    /* Interpolates a brick's 16 nodes (Adini), with their derivatives. */
    void (*refine)(const lmpi_kernel_brick *brick, float *nodes);
    /* Does refine, and adds the result to what the nodes hold. */
    void (*refine_add)(const lmpi_kernel_brick *brick, float *nodes);
} lmpi_field_kernels;

#endif
