/* SPDX-License-Identifier: MIT */
/* reference_light.h - a light of a scene as seen from a point, in double: by the definition of its
 * kind in <lampion/light.h>, not by the library. */
#ifndef LAMPION_TRUTH_REFERENCE_LIGHT_H
#define LAMPION_TRUTH_REFERENCE_LIGHT_H

#include "app/scene/scene.h"
#include "app/truth/reference_area.h"
#include "app/truth/reference_vector.h"

/* A cap of directions with uniform radiance, a single direction (solid_angle 0), or an area, for
 * which the cap is that of a sphere around it and the solid angle an estimate. */
typedef struct reference_source {
    bool is_area;
    reference_area area;
    reference_vec axis;   /* unit, to the cap's middle */
    double angle;         /* half angle a */
    double one_minus_cos; /* 1 - cos a, 0 … 2 */
    double solid_angle;   /* 2 pi (1 - cos a) */
    double color[3];      /* radiance, or the irradiance perpendicular to a single direction */
    double distance;      /* for a single direction: how far its light travels */
} reference_source;

/* Finds the sources that a light consists of, at most REFERENCE_SOURCES_MAX; returns how many.
 *
 * A point inside a sphere sees it in all directions. With `grow` it sees the cap that
 * <lampion/sphere.h> defines there instead, for comparisons with the library. */
#define REFERENCE_SOURCES_MAX 2 /* a sky and its ground */
int reference_light_sources(const scene_light *light, reference_vec point, bool grow,
                            reference_source sources[REFERENCE_SOURCES_MAX]);

/* Whether a ray from `point` meets a sphere, or the side of an area that shines. */
bool reference_light_is_hit(const scene_light *light, reference_vec point, reference_vec direction);

/* Returns how far light travels along `direction`, which must lie in the light's cap: from the
 * surface of a sphere or an area; INFINITY for a light without a position, and where an area is
 * missed. */
double reference_light_distance(const scene_light *light, reference_vec point,
                                reference_vec direction);

#endif
