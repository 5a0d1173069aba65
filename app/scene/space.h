/* SPDX-License-Identifier: MIT */
/* space.h - free space in a scene: for balls among its triangles, and for viewers inside it. */
#ifndef LAMPION_SCENE_SPACE_H
#define LAMPION_SCENE_SPACE_H

#include "app/scene/scene.h"

typedef struct space_ball {
    lmp_vec3 center;
    float radius;
    size_t number;                     /* the caller's */
    float above, below;                /* distances to the next triangle */
    bool above_is_back, below_is_back; /* whether that triangle shows its back */
    bool fits; /* no triangle cuts the ball, and neither of them shows its back */
} space_ball;

/* Fills in all members but centers, radii and numbers, and reorders the balls. */
void space_fit(const scene *world, space_ball *balls, size_t count);

/* Distances from a point to the nearest triangles that show it their front, in both directions of
 * each axis. */
typedef struct space_room {
    float back[3], ahead[3]; /* INFINITY: nothing, or a back */
} space_room;

space_room space_room_at(const scene *world, lmp_vec3 middle);

#endif
