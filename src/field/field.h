/* SPDX-License-Identifier: MIT */
/* field.h - how a field lies in memory.
 *
 * Nodes lie in bricks of 4 x 2 x 2, as many as the widest kernel has lanes: a kernel computes a
 * brick, and the corners of a cell are close. Nodes that fill the last bricks lie outside the grid
 * and are computed with the others. Cells are listed with what is near them in blocks of 2 x 2 x 2.
 *
 * A large field has a coarser one, of twice the cells and reach and the same lights, and its nodes
 * are points of that: interpolated, and what lights near there add. A node so meets the lights near
 * it alone, and those far away where there are an eighth of the nodes. */
#ifndef LAMPION_FIELD_FIELD_H
#define LAMPION_FIELD_FIELD_H

#include "src/base/host.h"
#include "src/base/precondition.h"
#include "src/kernels/kernels.h"

#include <lampion/field.h>

#include <stdatomic.h>

/* What a brick's nodes are: of lights gone by, the same but asked for, or as they should be. */
enum { FIELD_STALE, FIELD_WANTED, FIELD_READY };

enum {
    FIELD_BRICK = 16,
    FIELD_BLOCK = 2,     /* cells along the edge of a block */
    FIELD_TASKS = 32,    /* that compute bricks, at most: each has room for one, and */
    FIELD_PASS = 256,    /* for so many lights near it, which the kernel takes at once */
    FIELD_COARSE = 2048, /* nodes from which on a coarser field pays */
    FIELD_NODES = 1 << 24
};

#define FIELD_NONE UINT32_MAX

/* Some lights of one block's list: 64 bytes, for a list is read as fast as it comes from memory.
 * All but a list's first are full. */
enum { FIELD_ENTRY = 14 };
typedef struct field_entry {
    uint32_t next, count, lights[FIELD_ENTRY];
} field_entry;

/* A light as the kernels read it, dark if it is not interpolated; of a Dirac, whose radius is
 * LMP_DIRAC, the intensity. */
typedef struct field_sphere {
    lmp_vec3 center;
    float radius;
    lmp_rgb radiance;
} field_sphere;

/* How far from its center something of it is within a distance. */
static inline float lmp_field_around(const field_sphere *sphere, float distance) {
    return (sphere->radius > 0 ? sphere->radius : 0) + distance;
}

struct lmp_field {
    lmp_host host; /* resolved; first, for lmp_release_object */
    lmp_field_info info;
    lmp_field *coarse;  /* or NULL */
    size_t values;      /* 3 bands² */
    size_t stride;      /* floats from a node's values to its derivatives by x, by y, by z */
    float per_cell[3];  /* 1 / its edges */
    uint32_t bricks[3]; /* along each axis */
    size_t brick_count;
    uint32_t blocks[3]; /* of cells */
    size_t block_count;
    size_t task_count;
    float *nodes;   /* of each its values, then their derivatives by x, y, z */
    float *changes; /* of a coarser field's nodes, by the lights that changed last */
    float *scratch;
    atomic_uchar *states; /* of each brick */
    lmp_light *lights;
    field_sphere *spheres;
    uint8_t *everywhere; /* of each light: it is in the list of that name */
    /* Lists of blocks, then of the lights that are near everywhere; and of entries that were used,
     * besides which all from `untouched` on are free, too. */
    uint32_t *lists;
    field_entry *entries;
    size_t entry_count;
    uint32_t free, untouched, free_count;
    uint64_t changed; /* lights, since the nodes were computed */
};

/* A desc with every default filled in, or false if a member is outside its range. */
bool lmp_field_resolve(lmp_field_desc *desc);

/* A dark field. desc is resolved. */
lmp_result lmp_field_allocate(const lmp_host *host, const lmp_field_desc *desc, lmp_field **field);

/* Lists a light as one more. */
void lmp_field_push_light(lmp_field *field, const lmp_light *light);

/* Bytes of a task's scratch: what the kernel gives a brick, and the lights that it takes. */
static inline size_t lmp_field_scratch(const lmp_field *field) {
    return FIELD_BRICK * field->info.node_bytes + FIELD_PASS * sizeof(field_sphere);
}

/* --- nodes (nodes.c) -------------------------------------------------------------------------- */

/* Every brick is now in that state, of coarser fields, too. */
void lmp_field_set_states(lmp_field *field, unsigned char state);

/* Adds what the spheres give to the nodes that are computed; dark ones are taken away. */
void lmp_field_add_spheres(const lmp_host *host, lmp_field *field, const field_sphere *spheres,
                           size_t count);

/* Computes a brick anew, if it has been computed, and one of each coarser field. */
void lmp_field_refresh(lmp_field *field, uint64_t turn);

/* --- places ----------------------------------------------------------------------------------- */

/* Where a point lies in the grid: its cell, and how far along its edges. */
typedef struct field_place {
    uint32_t cell[3];
    float fraction[3];
} field_place;

/* False of a point outside. Inline, for every point is looked for several times. */
static inline bool lmp_field_find(const lmp_field *field, lmp_vec3 point, field_place *place) {
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

static inline bool lmp_field_same_cell(const uint32_t a[3], const uint32_t b[3]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* A box, and how far a point lies from it, squared. */
typedef struct field_box {
    lmp_vec3 low, high;
} field_box;

/* Without branches, which lights in no order would mislead. */
static inline float lmp_field_gap(float low, float at, float high) {
    const float below = low - at, above = at - high, gap = below > above ? below : above;
    return gap > 0 ? gap : 0;
}

static inline float lmp_field_distance2(const field_box *box, lmp_vec3 at) {
    const float x = lmp_field_gap(box->low.x, at.x, box->high.x);
    const float y = lmp_field_gap(box->low.y, at.y, box->high.y);
    const float z = lmp_field_gap(box->low.z, at.z, box->high.z);
    return x * x + y * y + z * z;
}

/* --- near lights (near.c) --------------------------------------------------------------------- */

/* Puts a light into the lists of the blocks that it is near to, takes it from them, or does both
 * for one that was that sphere when it was listed; empties all. */
void lmp_field_list(lmp_field *field, uint32_t light);
void lmp_field_unlist(lmp_field *field, uint32_t light);
void lmp_field_relist(lmp_field *field, uint32_t light, const field_sphere *was);
void lmp_field_unlist_all(lmp_field *field);

/* A bit for each light: those listed for some of the points given. */
typedef struct field_set {
    uint64_t bits[LMP_FIELD_LIGHTS_MAX / 64];
    size_t words;
} field_set;
void lmp_field_set_clear(const lmp_field *field, field_set *set);
void lmp_field_set_add(const lmp_field *field, uint32_t block, field_set *set);
void lmp_field_set_add_all(const lmp_field *field, field_set *set);
/* The first light of the set from `light` on, or FIELD_NONE. */
uint32_t lmp_field_set_next(const field_set *set, uint32_t light);

/* The index of a cell's block. */
static inline uint32_t lmp_field_block(const lmp_field *field, const uint32_t cell[3]) {
    return (cell[2] / FIELD_BLOCK * field->blocks[1] + cell[1] / FIELD_BLOCK) * field->blocks[0] +
           cell[0] / FIELD_BLOCK;
}

/* The fraction of a light that the field lacks at a point inside the grid. */
float lmp_field_lacks(const lmp_field *field, uint32_t light, lmp_vec3 point);

/* Adds the lights listed at a point, or all if it lies outside the grid; whether it lies inside. */
bool lmp_field_set_find(const lmp_field *field, lmp_vec3 point, field_set *set);

/* --- points (points.c) ------------------------------------------------------------------------ */

/* Coefficients of as many points as a brick has nodes. */
#define FIELD_ROWS (FIELD_BRICK * 3 * LMP_FIELD_BANDS_MAX * LMP_FIELD_BANDS_MAX)

/* Up to FIELD_BRICK of them, as the kernel takes them: of nodes laid out as the field's. */
typedef struct field_cells {
    uint32_t corners[8 * FIELD_BRICK];
    float fraction[3][FIELD_BRICK] __attribute__((aligned(64)));
} field_cells;
void lmp_field_set_place(const lmp_field *field, const field_place *place, size_t at,
                         field_cells *cells);
lmp_kernel_cells lmp_field_cells(const lmp_field *field, const float *nodes,
                                 const field_cells *cells);

/* Blocks of cells, once for neighbors in one. */
enum { FIELD_BLOCKS = 64 };
typedef struct field_blocks {
    size_t count;
    uint32_t at[FIELD_BLOCKS];
} field_blocks;

/* Interpolated coefficients of up to FIELD_BRICK points, of any cell where they lie outside the
 * grid; and rows of field->values with what near lights add. blocks, or NULL, receives those of
 * points inside, if need be one more a point. */
void lmp_field_interpolate(const lmp_field *field, const lmp_vec3 *points, size_t count,
                           field_blocks *blocks, const lmp_kernel_out *out);
void lmp_field_rows(const lmp_field *field, const lmp_vec3 *points, size_t count, float *rows);

/* --- surfaces (sort.c) ------------------------------------------------------------------------ */

/* Surfaces that are sorted together. */
enum { FIELD_SORTED = 1024 };

/* Sorts indices below FIELD_SORTED by the key of each, equal ones as they are. */
void lmp_field_sort(const uint32_t *keys, size_t count, uint16_t *order);

/* --- layout ----------------------------------------------------------------------------------- */

static inline uint32_t lmp_field_node(const lmp_field *field, uint32_t x, uint32_t y, uint32_t z) {
    const uint32_t brick = (z / 2 * field->bricks[1] + y / 2) * field->bricks[0] + x / 4;
    return brick * FIELD_BRICK + (z % 2 * 2 + y % 2) * 4 + x % 4;
}

#endif
