/* SPDX-License-Identifier: MIT */
/* grid.h - a scene as coarse cells, for what need not be known exactly: what is seen from anywhere
 * in it, of how much of which side. */
#ifndef LAMPION_SCENE_GRID_H
#define LAMPION_SCENE_GRID_H

#include "app/scene/scene.h"

enum { GRID_CELLS = 64 }; /* along each axis, one empty at either end */

typedef struct scene_grid {
    float low[3], size[3];                                 /* of a cell */
    float facing[GRID_CELLS * GRID_CELLS * GRID_CELLS][6]; /* area toward -x, +x, -y, … */
} scene_grid;

/* NULL without memory. */
scene_grid *scene_grid_create(const scene *scene);
void scene_grid_destroy(scene_grid *grid);

typedef enum grid_hit { GRID_NOTHING, GRID_FRONT, GRID_BACK } grid_hit;

/* Whether there is nothing in the point's cell. */
bool scene_grid_is_empty(const scene_grid *grid, lmp_vec3 point);

/* What is seen from a point along a direction, past the cell of the point, and how far away it is:
 * in lengths of the direction; of nothing, where the grid ends. Walls thinner than a cell show a
 * front to both sides if they have both. */
grid_hit scene_grid_look(const scene_grid *grid, lmp_vec3 from, lmp_vec3 way, float *distance);

#endif
