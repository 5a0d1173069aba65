/* SPDX-License-Identifier: MIT */
/* light.h - what a light of a scene is, seen from a point, in double: by the definition of its kind
 * in <lampion/light.h>, not by the library. */
#ifndef LAMPION_REFERENCE_LIGHT_H
#define LAMPION_REFERENCE_LIGHT_H

#include "app/reference/vector.h"
#include "app/scene/scene.h"

/* A cap of directions of one radiance, or a single direction (solid_angle 0). */
typedef struct reference_source {
    reference_vec axis;   /* unit, to its middle */
    double angle;         /* half angle a */
    double one_minus_cos; /* 1 - cos a, 0 … 2 */
    double solid_angle;   /* 2 pi (1 - cos a) */
    double color[3];      /* radiance; of a single direction the irradiance across it */
    double distance;      /* of a single direction: how far its light comes */
} reference_source;

/* The sources that the light consists of, at most REFERENCE_SOURCES_MAX of them; returns how many.
 *
 * A point inside a sphere sees it in all directions. With `grow` it sees the cap that
 * <lampion/light.h> defines there instead, for comparisons with the library. */
#define REFERENCE_SOURCES_MAX 2 /* a sky and its ground */
int reference_light_sources(const scene_light *light, reference_vec point, bool grow,
                            reference_source sources[REFERENCE_SOURCES_MAX]);

/* Whether a ray from `point` meets a sphere light. */
bool reference_light_is_hit(const scene_light *light, reference_vec point, reference_vec direction);

/* How far light comes along `direction`, which must lie in the light's cap: to the surface of a
 * sphere, INFINITY of what has no position. */
double reference_light_distance(const scene_light *light, reference_vec point,
                                reference_vec direction);

#endif
