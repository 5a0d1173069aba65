/* SPDX-License-Identifier: MIT */
/* joined.h - vertices that belong together: sets of numbers, joined two by two (union-find). In
 * joined[i] is another member of the set of i, or i, its leader and lowest number. */
#ifndef LAMPION_SCENE_JOINED_H
#define LAMPION_SCENE_JOINED_H

#include "app/scene/scene.h"

/* Finds for each vertex the first one at its position. Returns false if memory ran out. */
bool joined_positions(const scene_vertex *vertices, uint32_t count, uint32_t *first);

/* Joins the sets of two members. */
void joined_join(uint32_t *joined, uint32_t a, uint32_t b);

/* Numbers the sets from 0: joined[i] becomes the number of the set of i. Returns how many there
 * are. */
uint32_t joined_number(uint32_t *joined, uint32_t count);

/* Returns how many slots a hash table of so many entries has: a power of two. */
size_t joined_slots(size_t count);

#endif
