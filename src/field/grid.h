/* SPDX-License-Identifier: MIT */
/* grid.h - how a field lies in memory.
 *
 * Nodes lie in bricks of 4 x 2 x 2, as many as the widest kernel has lanes: a kernel computes a
 * brick, and the corners of a cell are close. Nodes that only fill the last bricks lie outside the
 * grid and are computed with the others. Lists of near lights are kept per block of 2 x 2 x 2
 * cells.
 *
 * A large field has a coarser one with the same lights and twice the cells and reach. Its nodes are
 * evaluated as points of the coarser field: interpolated, plus what near lights add. A node thus
 * sums only the lights near it; distant lights are summed at an eighth of the nodes. */
#ifndef LAMPION_FIELD_GRID_H
#define LAMPION_FIELD_GRID_H

#include "src/base/host.h"
#include "src/base/precondition.h"

#include <lampion/field.h>

#include <stdatomic.h>

/* The state of a brick's nodes: stale, of lights that have been replaced; stale and wanted; or up
 * to date. */
enum { FIELD_STALE, FIELD_WANTED, FIELD_READY };

enum {
    FIELD_BRICK = 16,
    FIELD_BLOCK = 2,     /* cells along the edge of a block */
    FIELD_TASKS = 32,    /* tasks that compute bricks, at most; each has scratch for one brick */
    FIELD_PASS = 256,    /* and for so many lights near it, which the kernel takes at once */
    FIELD_COARSE = 2048, /* nodes from which on a coarser field pays */
    FIELD_NODES = 1 << 24
};

#define FIELD_NONE UINT32_MAX

/* Some lights of one block's list, in 64 bytes, because a list is read as fast as it comes from
 * memory. Only the first entry of a list may be partly filled. */
enum { FIELD_ENTRY = 14 };
typedef struct field_entry {
    uint32_t next, count, lights[FIELD_ENTRY];
} field_entry;

/* A light as the kernels read it, dark if it is not interpolated. radiance holds the intensity of a
 * Dirac, whose radius is LMPI_DIRAC. */
typedef struct field_sphere {
    lmp_vec3 center;
    float radius;
    lmp_rgb radiance;
} field_sphere;

/* Returns how far from the sphere's center points may lie within a distance of it. */
static inline float lmpi_field_around(const field_sphere *sphere, float distance) {
    return (sphere->radius > 0 ? sphere->radius : 0) + distance;
}

struct lmp_field {
    lmp_host host; /* resolved; first, for lmpi_release_object */
    lmp_field_info info;
    lmp_field *coarse;  /* NULL if there is none */
    size_t values;      /* 3 bands² */
    size_t stride;      /* floats from a node's values to its derivatives by x, by y, by z */
    float per_cell[3];  /* 1 / the edges of a cell */
    uint32_t bricks[3]; /* along each axis */
    size_t brick_count;
    uint32_t blocks[3]; /* of cells */
    size_t block_count;
    size_t task_count;
    float *nodes;   /* per node its values, then their derivatives by x, y, z */
    float *changes; /* what the lights changed last add to a coarser field's nodes */
    float *scratch;
    atomic_uchar *states; /* per brick */
    lmp_light *lights;
    field_sphere *spheres;
    uint8_t *everywhere; /* per light, whether it is in the list of lights near everywhere */
    /* First entries of the lists of blocks, and last of the lights near everywhere. `free` chains
     * entries that were used before; all from `untouched` on are free as well. */
    uint32_t *lists;
    field_entry *entries;
    size_t entry_count;
    uint32_t free, untouched, free_count;
    uint64_t changed; /* lights changed since all nodes were recomputed */
};

/* Returns the bytes of a task's scratch: the kernel's output for a brick, and the lights it takes.
 */
static inline size_t lmpi_field_scratch(const lmp_field *field) {
    return FIELD_BRICK * field->info.node_bytes + FIELD_PASS * sizeof(field_sphere);
}

/* --- layout ----------------------------------------------------------------------------------- */

static inline uint32_t lmpi_field_node(const lmp_field *field, uint32_t x, uint32_t y, uint32_t z) {
    const uint32_t brick = (z / 2 * field->bricks[1] + y / 2) * field->bricks[0] + x / 4;
    return brick * FIELD_BRICK + (z % 2 * 2 + y % 2) * 4 + x % 4;
}

/* Returns the index of a cell's block. */
static inline uint32_t lmpi_field_block(const lmp_field *field, const uint32_t cell[3]) {
    return (cell[2] / FIELD_BLOCK * field->blocks[1] + cell[1] / FIELD_BLOCK) * field->blocks[0] +
           cell[0] / FIELD_BLOCK;
}

/* --- places ----------------------------------------------------------------------------------- */

/* Where a point lies in the grid: its cell, and how far along its edges. */
typedef struct field_place {
    uint32_t cell[3];
    float fraction[3];
} field_place;

/* Finds a point's place; returns false if it lies outside the grid. Inline, because every point is
 * looked up several times. */
static inline bool lmpi_field_find(const lmp_field *field, lmp_vec3 point, field_place *place) {
    const lmp_vec3 origin = field->info.desc.origin;
    const float at[3] = { (point.x - origin.x) * field->per_cell[0],
                          (point.y - origin.y) * field->per_cell[1],
                          (point.z - origin.z) * field->per_cell[2] };
    for (int a = 0; a < 3; a++) {
        const int last = field->info.desc.nodes[a] - 2;
        if (!(at[a] >= 0 && at[a] <= (float)(last + 1)))
            return false;
        const int cell = (int)at[a] < last ? (int)at[a] : last;
        place->cell[a] = (uint32_t)cell;
        place->fraction[a] = at[a] - (float)cell;
    }
    return true;
}

static inline bool lmpi_field_same_cell(const uint32_t a[3], const uint32_t b[3]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* A box that encloses points. */
typedef struct field_box {
    lmp_vec3 low, high;
} field_box;

static inline void lmpi_field_box_grow(field_box *box, lmp_vec3 at) {
    lmp_vec3 *low = &box->low, *high = &box->high;
    low->x = at.x < low->x ? at.x : low->x;
    low->y = at.y < low->y ? at.y : low->y;
    low->z = at.z < low->z ? at.z : low->z;
    high->x = at.x > high->x ? at.x : high->x;
    high->y = at.y > high->y ? at.y : high->y;
    high->z = at.z > high->z ? at.z : high->z;
}

/* Returns how far `at` lies outside low … high. Without branches, which lights in random order
 * would mispredict. */
static inline float lmpi_field_gap(float low, float at, float high) {
    const float below = low - at, above = at - high, gap = below > above ? below : above;
    return gap > 0 ? gap : 0;
}

static inline float lmpi_field_distance2(const field_box *box, lmp_vec3 at) {
    const float x = lmpi_field_gap(box->low.x, at.x, box->high.x);
    const float y = lmpi_field_gap(box->low.y, at.y, box->high.y);
    const float z = lmpi_field_gap(box->low.z, at.z, box->high.z);
    return x * x + y * y + z * z;
}

#endif
