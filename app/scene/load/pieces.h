/* SPDX-License-Identifier: MIT */
/* pieces.h - which triangles of an emissive mesh hang together. */
#ifndef LAMPION_SCENE_LOAD_PIECES_H
#define LAMPION_SCENE_LOAD_PIECES_H

#include <lampion/light.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A triangle that shines from the side on which its corners are counter-clockwise, or from both. */
typedef struct piece_triangle {
    lmp_vec3 corner[3];
    float radiance[3];
    bool both;
    bool outward; /* of a closed body, which shines outward */
} piece_triangle;

/* Returns the area of one side. */
double piece_triangle_area(const piece_triangle *triangle);

/* Numbers the positions of all corners from 0, equal ones alike: corner[3 i + k] gets the number of
 * triangle i's corner k. Returns false if memory ran out. */
bool pieces_number_corners(const piece_triangle *triangles, size_t count, uint32_t *corner);

/* Returns the root of an item's set in a forest of items, each of which names another of its set or
 * itself, and shortens the way there. */
uint32_t pieces_root(uint32_t *joined, uint32_t item);

/* A run of triangles that share corners, directly or through others of the run. */
typedef struct piece {
    piece_triangle *triangles;
    size_t count;
} piece;

/* Sorts triangles by their pieces, which keep their order, as do the triangles of each. The caller
 * frees *pieces. Returns false if memory ran out. */
bool pieces_sort(piece_triangle *triangles, size_t count, piece **pieces, size_t *piece_count);

#endif
