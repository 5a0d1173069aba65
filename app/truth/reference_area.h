/* SPDX-License-Identifier: MIT */
/* reference_area.h - lights that are areas, in double: samples spread evenly over their surface. By
 * the definitions of <lampion/light.h>, not by the library or the program's renderers. */
#ifndef LAMPION_TRUTH_REFERENCE_AREA_H
#define LAMPION_TRUTH_REFERENCE_AREA_H

#include "app/truth/reference_vector.h"

#include <lampion/light.h>

#include <stdbool.h>

/* An area: a tube, a disk, or corners in a plane. */
typedef struct reference_area {
    bool tube, disk, two_sided;
    bool whole; /* whether its four corners are those of a parallelogram */
    reference_vec position;
    int count;
    reference_vec corner[LMP_LIGHT_CORNERS_MAX]; /* as seen from the position */
    reference_vec axis;                          /* half of a tube's, or the normal of a disk */
    double radius;
} reference_area;

/* How an area lies as seen from a point. */
typedef struct reference_area_view {
    bool shines;          /* whether any of its light can arrive */
    bool inside;          /* whether the point is inside a tube */
    reference_vec center; /* of a sphere around the area, as seen from the point */
    double radius;
    double solid_angle; /* an estimate */
    reference_vec
        nearest; /* inside a tube: the nearest point of the axis, as seen from the point */
} reference_area_view;

reference_area_view reference_area_see(const reference_area *area, reference_vec point);

/* Samples a direction from the point by two uniform numbers in 0 … 1. */
reference_vec reference_area_draw(const reference_area *area, reference_vec point, double u,
                                  double v);

/* Where a ray meets an area. */
typedef struct reference_area_hit {
    double distance; /* to where its light comes from; INFINITY if none does */
    double density;  /* of sampling the direction, per steradian; 0 if it is never sampled */
} reference_area_hit;

reference_area_hit reference_area_meet(const reference_area *area, reference_vec point,
                                       reference_vec direction);

#endif
