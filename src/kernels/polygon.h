/* SPDX-License-Identifier: MIT */
/* polygon.h - flat lights with corners, as the kernels take them. */
#ifndef LAMPION_KERNELS_POLYGON_H
#define LAMPION_KERNELS_POLYGON_H

#include <lampion/base.h>

#define LMPI_POLYGON_CORNERS 8

/* Points that stand for a light that looks small. */
#define LMPI_POLYGON_POINTS 4

/* A light by its corners, 4, 6 or 8, of which the last two may be the same. They are clockwise
 * around its normal, so that they are counter-clockwise as its front is seen. Vectors begin at
 * `position`, and but for it lengths are multiples of 1 / per_unit, a power of two near the light's
 * radius: powers of them then fit floats. */
typedef struct lmpi_kernel_polygon {
    lmp_vec3 position;
    double per_unit;
    int count, two_sided;
    double normal[3], area[3], per_area; /* of length 1; along the normal; 1 / its length */
    double corner[LMPI_POLYGON_CORNERS][3], edge[LMPI_POLYGON_CORNERS][3]; /* to the next one */
    double centroid[3], radius;                      /* the distance of the farthest corner */
    double point[LMPI_POLYGON_POINTS][3], each;      /* each stands for so much area */
    double far_for_irradiance, far_for_lobes_a_band; /* distances beyond which points serve */
    lmp_rgb radiance;
} lmpi_kernel_polygon;

#endif
