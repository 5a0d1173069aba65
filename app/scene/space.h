/* SPDX-License-Identifier: MIT */
/* space.h - where there is room in a scene: for balls among its triangles, and for people inside
 * it.
 */
#ifndef LAMPION_SCENE_SPACE_H
#define LAMPION_SCENE_SPACE_H

#include "app/scene/scene.h"

typedef struct space_ball {
    lmp_vec3 center;
    float radius;
    size_t number;                     /* the caller's */
    float above, below;                /* distance of what is next */
    bool above_is_back, below_is_back; /* and whether its back is what shows */
    bool fits;                         /* no triangle cuts it, and neither is */
} space_ball;

/* Fills in all but centers, radii and numbers. The balls are put in another order. */
void space_fit(const scene *world, space_ball *balls, size_t count);

/* The nearest triangles that show their front to a point, along both ways of each axis. */
typedef struct space_room {
    float back[3], ahead[3]; /* distances; INFINITY: nothing, or a back */
} space_room;

space_room space_room_at(const scene *world, lmp_vec3 middle);

#endif
