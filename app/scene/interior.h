/* SPDX-License-Identifier: MIT */
/* interior.h - whether a scene is a room or courtyard, to be seen from inside, or an object, to be
 * seen from outside. */
#ifndef LAMPION_SCENE_INTERIOR_H
#define LAMPION_SCENE_INTERIOR_H

#include "app/scene/grid.h"

/* What scene_interior_find finds out. */
typedef struct scene_interior {
    bool inside;     /* whether the scene is to be seen from inside */
    lmp_vec3 middle; /* of the room or, without one, a point in empty space */
    int points;      /* points of a lattice that have a room around them */
    int level;       /* those of them that stand above level ground */
    float open;      /* degrees: the widest part of the room's horizon without a wall */
    float fronts;    /* fraction of fronts in what is seen from outside */
    float within; /* in doubt after `fronts`: cells seen from the room per cell seen from outside */
    float fronts_before[4]; /* fronts seen from before it, and after quarter turns */
} scene_interior;

/* Examines a scene; in doubt it is to be seen from outside. */
scene_interior scene_interior_find(const scene_grid *grid);

/* Returns the fraction of the upper sky that reaches what a camera before the scene sees, after
 * `quarter` quarter turns. Unless backs are drawn, it is 0 for the inside of closed walls that are
 * seen through their backs. */
float scene_interior_sky(const scene_grid *grid, int quarter, bool backs_drawn);

/* Whether surfaces enclose a point in most directions above and below it. */
bool scene_interior_closes(const scene_grid *grid, lmp_vec3 point);

#endif
