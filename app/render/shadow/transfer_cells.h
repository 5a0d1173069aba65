/* SPDX-License-Identifier: MIT */
/* transfer_cells.h - surfels by their positions: a hash of cubic cells. */
#ifndef LAMPION_RENDER_SHADOW_TRANSFER_CELLS_H
#define LAMPION_RENDER_SHADOW_TRANSFER_CELLS_H

#include "app/render/shadow/transfer_surfels.h"

/* A cube of space, by its place in the grid, and its surfels. */
typedef struct transfer_cell {
    int32_t x, y, z;
    uint32_t begin, end;
} transfer_cell;

static inline uint32_t transfer_hash(int32_t x, int32_t y, int32_t z) {
    const uint32_t hash =
        (uint32_t)x * 0x9e3779b1u ^ (uint32_t)y * 0x85ebca6bu ^ (uint32_t)z * 0xc2b2ae35u;
    return hash ^ hash >> 15;
}

typedef struct transfer_cells {
    const transfer_surfels *surfels; /* those of a cell one after another, near cells near */
    float size;                      /* the edge of a cell */
    uint32_t mask;                   /* of hashes */
    transfer_cell *table; /* a cell is at its hash, or in the first place after it that was free;
                           * free places have no surfels */
} transfer_cells;

/* Puts surfels, which must outlive the cells, into an order for searches up to TRANSFER_NEAR
 * spacings away. Returns false if memory ran out; free the cells in any case. */
#define TRANSFER_NEAR 2.2f
bool transfer_cells_create(transfer_surfels *surfels, transfer_cells *cells);
void transfer_cells_free(transfer_cells *cells);

/* Finds the surfels within TRANSFER_NEAR spacings of a point whose normals have at least `cosine`
 * with the normal given: up to `capacity` of them, the nearest first, where distances off the
 * surface count more. Returns how many. */
size_t transfer_cells_find(const transfer_cells *cells, lmp_vec3 point, lmp_vec3 normal,
                           float cosine, size_t capacity, uint32_t *found);

#endif
