/* SPDX-License-Identifier: MIT */
/* pieces.h - which triangles of an emissive mesh hang together. */
#ifndef LAMPION_SCENE_LOAD_PIECES_H
#define LAMPION_SCENE_LOAD_PIECES_H

#include "app/scene/load/patches.h"

#include <stdint.h>

/* Numbers the positions of all corners from 0, equal ones alike: corner[3 i + k] gets the number of
 * triangle i's corner k. Returns false if memory ran out. */
bool pieces_number_corners(const patch_triangle *triangles, size_t count, uint32_t *corner);

/* Returns the root of an item's set in a forest of items, each of which names another of its set or
 * itself, and shortens the way there. */
uint32_t pieces_root(uint32_t *joined, uint32_t item);

/* A run of triangles that share corners, directly or through others of the run. */
typedef struct piece {
    patch_triangle *triangles;
    size_t count;
} piece;

/* Sorts triangles by their pieces, which keep their order, as do the triangles of each. The caller
 * frees *pieces. Returns false if memory ran out. */
bool pieces_sort(patch_triangle *triangles, size_t count, piece **pieces, size_t *piece_count);

#endif
