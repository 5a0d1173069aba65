/* SPDX-License-Identifier: MIT */
/* grid.h - a scene as coarse cells, for approximate visibility: how much of which sides of its
 * surfaces is seen from any point. */
#ifndef LAMPION_SCENE_GRID_H
#define LAMPION_SCENE_GRID_H

#include "app/scene/scene.h"

enum {
    GRID_CELLS = 64, /* along each axis, of which one at either end is empty */
    GRID_ALL = GRID_CELLS * GRID_CELLS * GRID_CELLS
};

typedef struct scene_grid {
    float low[3], size[3];              /* of the grid, and of a cell */
    unsigned char filled[GRID_ALL / 8]; /* a bit per cell: most are empty, and not touched */
    float facing[GRID_ALL][6];          /* area toward -x, +x, -y, … */
} scene_grid;

/* Makes the grid of a scene; returns NULL if memory ran out. */
scene_grid *scene_grid_create(const scene *scene);
void scene_grid_destroy(scene_grid *grid);

typedef enum grid_hit { GRID_NOTHING, GRID_FRONT, GRID_BACK } grid_hit;

/* Whether the cell of the point is empty. */
bool scene_grid_is_empty(const scene_grid *grid, lmp_vec3 point);

/* Whether the first surface straight below the point is level ground, by its mean over a cell. */
bool scene_grid_is_level_below(const scene_grid *grid, lmp_vec3 point);

/* Returns what is seen from a point along a direction, past the point's own cell. *distance is in
 * lengths of the direction; where nothing is hit, it is that to the end of the grid. Walls thinner
 * than a cell show a front to both sides if they have both. */
grid_hit scene_grid_look(const scene_grid *grid, lmp_vec3 from, lmp_vec3 way, float *distance);

#endif
