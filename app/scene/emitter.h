/* SPDX-License-Identifier: MIT */
/* emitter.h - lights that are areas, prepared for rays. */
#ifndef LAMPION_SCENE_EMITTER_H
#define LAMPION_SCENE_EMITTER_H

#include <lampion/light.h>

typedef enum scene_emitter_form {
    SCENE_EMITTER_OUTLINE, /* a parallelogram or another polygon */
    SCENE_EMITTER_DISK,
    SCENE_EMITTER_TUBE
} scene_emitter_form;

/* A flat area lies in the parallelogram center ± x ± y, all of which it fills unless it has
 * corners. */
typedef struct scene_emitter {
    scene_emitter_form form;
    bool two_sided;
    lmp_vec3 center;
    lmp_vec3 normal;     /* unit; of a tube, along its axis */
    lmp_vec3 x, y;       /* of a flat area */
    lmp_vec3 of_x, of_y; /* give a point's coordinates along x and y, as scalar products */
    int corner_count;    /* of one that fills it in part; else 0 */
    float corner[LMP_LIGHT_CORNERS_MAX][2]; /* in these coordinates */
    float half, radius;                     /* half the axis of a tube, and its radius */
    float extent;                           /* the distance of the farthest point from the center */
    float facing;                           /* the most of the area that faces one direction */
    float surface; /* of the parallelogram, of a disk, or of a whole tube */
} scene_emitter;

/* Prepares a light that is an area. */
void scene_emitter_set(const lmp_light *light, scene_emitter *area);

/* Whether a flat area covers the point center + u x + v y. */
bool scene_emitter_covers(const scene_emitter *flat, float u, float v);

/* Returns the distance to the area along a ray, in lengths of its direction; NaN for a miss. One
 * side of a one-sided area is not hit, and a tube is hit from inside, too. */
float scene_emitter_distance(const scene_emitter *area, const float origin[3],
                             const float direction[3]);

#endif
