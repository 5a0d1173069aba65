/* SPDX-License-Identifier: MIT */
/* nodes.h - vectors of coefficients, and the kernels of fields on nodes that hold them. */
#ifndef LAMPION_NODES_H
#define LAMPION_NODES_H

#include "src/kernels/dispatch.h"
#include "tests/kernels/inputs.h"

#include <lampion/sh.h>

/* Returns value v of element e, the same for both layouts. */
static float coefficient(size_t e, size_t v) {
    set_seed(e * 7919 + v);
    grid(1);
    return grid(1.0f / 1024);
}

static float *make_vectors(size_t values, size_t count, int planar, size_t stride, size_t shift) {
    float *at = malloc((planar ? values : count) * stride * sizeof *at + 64);
    assert_non_null(at);
    for (size_t e = 0; e < count; e++)
        for (size_t v = 0; v < values; v++)
            at[planar ? v * stride + e : e * stride + v] = coefficient(e + shift, v);
    return at;
}

/* Runs on nodes whose coefficients are those of vectors. Groups of five points have their corners
 * anywhere, so that four share what is read and one does not. */
static void run_interpolate(const lmpi_kernels *k, int bands, const inputs *in, size_t count,
                            const lmpi_kernel_out *out) {
    enum { NODES = 9 };
    const size_t values = 3 * LMP_SH_COUNT(bands);
    const size_t stride = (values + 15) / 16 * 16;
    float *nodes = make_vectors(4 * stride, NODES, 0, 4 * stride, 0);
    _Alignas(64) float fraction[3][COUNT + 16];
    uint32_t corners[8 * COUNT];
    for (size_t i = 0; i < 8 * COUNT; i++)
        corners[i] = (uint32_t)((i % 8 * 5 + i / 40) % NODES);
    for (int a = 0; a < 3; a++)
        for (size_t i = 0; i < COUNT + 16; i++)
            fraction[a][i] = fminf(fabsf(in->axis[a][i]), 1);
    const lmpi_kernel_cells cells = {
        nodes, stride, { 0.5f, 0.25f, 2 }, corners, { fraction[0], fraction[1], fraction[2] }
    };
    k->field.interpolate(values, &cells, count, out);
    free(nodes);
}

/* Runs so that element e is node e % 16 of a brick between nodes whose coefficients are those of
 * vectors. */
static void run_refine(const lmpi_kernels *k, int bands, size_t count, const lmpi_kernel_out *out) {
    const size_t values = 3 * LMP_SH_COUNT(bands);
    const size_t stride = (values + 15) / 16 * 16, node = 4 * stride;
    float *from = make_vectors(node, 12, 0, node, 0), *nodes = malloc(16 * node * sizeof *nodes);
    assert_non_null(nodes);
    for (size_t e = 0; e < count; e++) {
        lmpi_kernel_brick brick = { .stride = stride, .cell = { 0.5f, 0.25f, 2 }, .next = nodes };
        for (size_t i = 0; i < 12; i++)
            brick.from[i] = from + (e / 16 + 5 * i) % 12 * node;
        if (e % 16 == 0)
            k->field.refine(&brick, nodes);
        for (size_t v = 0; v < 4 * values; v++)
            out->at[out->planar ? v * out->stride + e : e * out->stride + v] =
                nodes[e % 16 * node + v / values * stride + v % values];
    }
    free(nodes);
    free(from);
}

static void run_nodes(const lmpi_kernels *k, bool refines, int bands, const inputs *in,
                      size_t count, const lmpi_kernel_out *out) {
    if (refines)
        run_refine(k, bands, count, out);
    else
        run_interpolate(k, bands, in, count, out);
}

#endif
