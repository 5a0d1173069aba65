/* SPDX-License-Identifier: MIT */
/* refine_tmpl.h - Adini's interpolation (field_tmpl.h) at the nodes of a grid of half the cells: on
 * corners, and in the middle of edges, sides and cells, where its weights are few. Lanes are
 * coefficients.
 *
 * Along an edge h from 0 to 1, a value with slopes has in the middle
 *
 *     (f0 + f1)/2 + h/8 (f0' - f1')     and the slope     3/2 (f1 - f0)/h - (f0' + f1')/4
 *
 * The first term is linear in the other axes, too; the bend, the second one, is linear in the other
 * two alone, and the sum has one of each axis. So a brick is done by lines along x, where all that
 * the other axes need of a line is known, then across them. */
#ifndef LAMPION_KERNELS_REFINE_TMPL_H
#define LAMPION_KERNELS_REFINE_TMPL_H

#include "src/kernels/field.h"
#include "src/kernels/lanes.h"

/* Factors of the edges: h/8, 1/h, and for y and z h/8 of one times 1/h of the other. */
typedef struct refine_edges {
    float bend[3], per[3], y_by_z, z_by_y;
} refine_edges;

/* A place on a line along x: the linear part there, its bend and their sum, and the derivative by
 * x; the derivatives by y and z, which are linear, and their derivatives by x. */
typedef struct refine_line {
    vf linear, bend, value, slope;
    vf y, z, y_slope, z_slope;
} refine_line;

/* Evaluates a line on node a, or in the middle of the edge to node b. */
LMPI_INLINE refine_line refine_along(int middle, const refine_edges *edges, const float *a,
                                     const float *b, size_t stride) {
    const vf f0 = vf_load(a), x0 = vf_load(a + stride);
    const vf y0 = vf_load(a + 2 * stride), y1 = vf_load(b + 2 * stride);
    const vf z0 = vf_load(a + 3 * stride), z1 = vf_load(b + 3 * stride);
    refine_line line = {
        f0, vf_set(0), f0, x0, y0, z0, edges->per[0] * (y1 - y0), edges->per[0] * (z1 - z0)
    };
    if (middle) {
        const vf f1 = vf_load(b), x1 = vf_load(b + stride);
        line.linear = 0.5f * (f0 + f1);
        line.bend = edges->bend[0] * (x0 - x1);
        line.value = line.linear + line.bend;
        line.slope = 1.5f * edges->per[0] * (f1 - f0) - 0.25f * (x0 + x1);
        line.y = 0.5f * (y0 + y1);
        line.z = 0.5f * (z0 + z1);
    }
    return line;
}

/* Where one vector of a brick's coefficients is written, or what it is added to. */
typedef struct refine_nodes {
    float *at;
    size_t stride;
    int adds;
} refine_nodes;

/* Writes a row of a node: the value is row 0, the derivatives are the others. */
LMPI_INLINE void refine_put(refine_nodes nodes, int node, int row, vf value) {
    float *const to = nodes.at + (size_t)(4 * node + row) * nodes.stride;
    vf_store(to, nodes.adds ? vf_load(to) + value : value);
}

/* Returns the derivative, in the middle between two lines, of the bend along x and of what lies
 * between the lines. */
LMPI_INLINE vf refine_steep(int middle, float per, const refine_line *a, const refine_line *b,
                            vf a_by, vf b_by) {
    vf rise = 1.5f * (b->linear - a->linear);
    if (middle)
        rise = rise + (b->bend - a->bend);
    return per * rise - 0.25f * (a_by + b_by);
}

/* Computes the four nodes of a brick that share one x, between lines j + 2 k. */
LMPI_INLINE void refine_across(int middle, const refine_edges *edges, const refine_line line[4],
                               int node, refine_nodes nodes) {
    const float by = edges->bend[1], bz = edges->bend[2];
    const vf y0 = line[0].y - line[1].y, y1 = line[2].y - line[3].y;
    const vf z0 = line[0].z - line[2].z, z1 = line[1].z - line[3].z;
    const vf y_by_z = edges->y_by_z * (y1 - y0), z_by_y = edges->z_by_y * (z1 - z0);
    vf dy0 = line[0].y, dz0 = line[0].z, dy = 0.5f * (line[0].y + line[2].y) + z_by_y;
    vf dz = 0.5f * (line[0].z + line[1].z) + y_by_z;
    if (middle) {
        const vf j0 = line[1].bend - line[0].bend, j1 = line[3].bend - line[2].bend;
        const vf k0 = line[2].bend - line[0].bend, k1 = line[3].bend - line[1].bend;
        dy0 = dy0 + edges->per[1] * j0;
        dz0 = dz0 + edges->per[2] * k0;
        dy = dy + 0.5f * edges->per[1] * (j0 + j1);
        dz = dz + 0.5f * edges->per[2] * (k0 + k1);
    }
    refine_put(nodes, node, 0, line[0].value);
    refine_put(nodes, node, 1, line[0].slope);
    refine_put(nodes, node, 2, dy0);
    refine_put(nodes, node, 3, dz0);

    const vf steep_y0 =
        refine_steep(middle, edges->per[1], &line[0], &line[1], line[0].y, line[1].y);
    const vf value_y = line[0].value + line[1].value, slope_y = line[0].slope + line[1].slope;
    const vf ys0 = line[0].y_slope - line[1].y_slope, ys1 = line[2].y_slope - line[3].y_slope;
    refine_put(nodes, node + 4, 0, 0.5f * value_y + by * y0);
    refine_put(nodes, node + 4, 1, 0.5f * slope_y + by * ys0);
    refine_put(nodes, node + 4, 2, steep_y0);
    refine_put(nodes, node + 4, 3, dz);

    const vf steep_z0 =
        refine_steep(middle, edges->per[2], &line[0], &line[2], line[0].z, line[2].z);
    const vf zs0 = line[0].z_slope - line[2].z_slope, zs1 = line[1].z_slope - line[3].z_slope;
    refine_put(nodes, node + 8, 0, 0.5f * (line[0].value + line[2].value) + bz * z0);
    refine_put(nodes, node + 8, 1, 0.5f * (line[0].slope + line[2].slope) + bz * zs0);
    refine_put(nodes, node + 8, 2, dy);
    refine_put(nodes, node + 8, 3, steep_z0);

    const vf steep_y1 =
        refine_steep(middle, edges->per[1], &line[2], &line[3], line[2].y, line[3].y);
    const vf steep_z1 =
        refine_steep(middle, edges->per[2], &line[1], &line[3], line[1].z, line[3].z);
    const vf value = value_y + (line[2].value + line[3].value);
    const vf slope = slope_y + (line[2].slope + line[3].slope);
    refine_put(nodes, node + 12, 0,
               0.25f * value + (0.5f * by * (y0 + y1) + 0.5f * bz * (z0 + z1)));
    refine_put(nodes, node + 12, 1,
               0.25f * slope + (0.5f * by * (ys0 + ys1) + 0.5f * bz * (zs0 + zs1)));
    refine_put(nodes, node + 12, 2, 0.5f * (steep_y0 + steep_y1) + z_by_y);
    refine_put(nodes, node + 12, 3, 0.5f * (steep_z0 + steep_z1) + y_by_z);
}

/* Fetches a part of the nodes that come next, in the order of memory. A brick has 4 stride lines of
 * 64 bytes: LMPI_LANES for each vector of coefficients and each of the four x. */
LMPI_INLINE void refine_fetch(const float *next, size_t part) {
    const char *line = (const char *)next + part * LMPI_LANES * 64;
    LMPI_UNROLL for (int i = 0; i < LMPI_LANES; i++) __builtin_prefetch(line + 64 * i, 1);
}

LMPI_INLINE void refine_brick(const lmpi_kernel_brick *brick, const refine_edges *edges, size_t at,
                              refine_nodes nodes) {
    LMPI_UNROLL for (int p = 0; p < 4; p++) {
        refine_line line[4];
        LMPI_UNROLL for (int i = 0; i < 4; i++) line[i] =
            refine_along(p % 2, edges, brick->from[3 * i + p / 2] + at,
                         brick->from[3 * i + p / 2 + 1] + at, brick->stride);
        refine_fetch(brick->next, 4 * at / LMPI_LANES + (size_t)p);
        refine_across(p % 2, edges, line, p, nodes);
    }
}

LMPI_INLINE void refine_all(int adds, const lmpi_kernel_brick *brick, float *nodes) {
    const lmp_vec3 h = brick->cell;
    const refine_edges edges = { { 0.125f * h.x, 0.125f * h.y, 0.125f * h.z },
                                 { 1 / h.x, 1 / h.y, 1 / h.z },
                                 0.125f * h.y / h.z,
                                 0.125f * h.z / h.y };
    for (size_t at = 0; at < brick->stride; at += LMPI_LANES)
        refine_brick(brick, &edges, at, (refine_nodes) { nodes + at, brick->stride, adds });
}

static void kernel_refine(const lmpi_kernel_brick *brick, float *nodes) {
    refine_all(0, brick, nodes);
}

static void kernel_refine_add(const lmpi_kernel_brick *brick, float *nodes) {
    refine_all(1, brick, nodes);
}

#endif
