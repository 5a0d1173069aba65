/* SPDX-License-Identifier: MIT */
/* interior.h - whether a scene is a room or a courtyard, whose inside is what there is to see, or
 * something to look at from outside. */
#ifndef LAMPION_SCENE_INTERIOR_H
#define LAMPION_SCENE_INTERIOR_H

#include "app/scene/grid.h"

/* What is found out about a scene. */
typedef struct scene_interior {
    bool inside;     /* it is to be seen from inside */
    lmp_vec3 middle; /* of the room, or where one would be: in empty space */
    int points;      /* of a lattice, that a room is around */
    float open;      /* degrees: the widest part of the room's horizon without a wall */
    float fronts;    /* of what is seen from outside: the part that shows its front */
    float within;    /* where `fronts` leave a doubt: what the room sees for each such part that
                      * is seen from outside */
    float fronts_before[4]; /* as a camera before it sees it, and by quarters of a circle on */
} scene_interior;

/* In doubt, the outside. */
scene_interior scene_interior_find(const scene_grid *grid);

/* Whether what stands there sees something in most directions above it, and below. */
bool scene_interior_closes(const scene_grid *grid, lmp_vec3 point);

#endif
