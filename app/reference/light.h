/* SPDX-License-Identifier: MIT */
/* light.h - the cap of directions that a glowing sphere fills, seen from a point, in double. */
#ifndef LAMPION_REFERENCE_LIGHT_H
#define LAMPION_REFERENCE_LIGHT_H

#include "app/reference/vector.h"
#include "app/scene/scene.h"

typedef struct reference_cap {
    reference_vec axis;
    double angle;         /* half angle a */
    double one_minus_cos; /* 1 - cos a */
    double solid_angle;   /* 2 pi (1 - cos a) */
} reference_cap;

/* Inside the sphere all directions see it: the cap is the whole sphere. With `grow`, it is the cap
 * that <lampion/light.h> defines there instead, for comparisons with the library. */
reference_cap reference_cap_of(const scene_light *light, reference_vec point, bool grow);

/* Whether a ray from `point` meets the sphere. */
bool reference_light_is_hit(const scene_light *light, reference_vec point, reference_vec direction);

/* Distance to the sphere's surface along `direction`, which must lie in the cap. */
double reference_light_distance(const scene_light *light, reference_vec point,
                                reference_vec direction);

#endif
