/* SPDX-License-Identifier: MIT */
/* flat.h - lights that are areas, as the kernels take them. */
#ifndef LAMPION_KERNELS_FLAT_H
#define LAMPION_KERNELS_FLAT_H

#include <lampion/base.h>

/* Points that stand for a light that looks small. */
#define LMPI_FLAT_POINTS 4

/* What polygons and disks, which are flat, share. Vectors begin at `position`, and but for it
 * lengths are multiples of 1 / per_unit, a power of two near the light's radius: powers of them
 * then fit floats. */
typedef struct lmpi_kernel_flat {
    lmp_vec3 position;
    double per_unit;
    int two_sided;
    double normal[3], area[3], per_area; /* of length 1; along the normal; 1 / its length */
    double corner[3], centroid[3];       /* a point of the plane; the middle */
    double radius;                       /* the distance of the farthest point from the middle */
    double point[LMPI_FLAT_POINTS][3], each;         /* each stands for so much area */
    double far_for_irradiance, far_for_lobes_a_band; /* distances beyond which points serve */
    lmp_rgb radiance;
} lmpi_kernel_flat;

/* A light by its corners, 4, 6 or 8, of which the last two may be the same. They are clockwise
 * around its normal, so that they are counter-clockwise as its front is seen. */
#define LMPI_POLYGON_CORNERS 8
typedef struct lmpi_kernel_polygon {
    lmpi_kernel_flat flat;
    int count;
    double corner[LMPI_POLYGON_CORNERS][3], edge[LMPI_POLYGON_CORNERS][3]; /* to the next one */
} lmpi_kernel_polygon;

/* A light by points around its edge, in the same order, each with the vector along the edge as long
 * as the part of the edge that it stands for. */
#define LMPI_DISK_NODES 32
typedef struct lmpi_kernel_disk {
    lmpi_kernel_flat flat;
    double node[LMPI_DISK_NODES][3], along[LMPI_DISK_NODES][3];
} lmpi_kernel_disk;

/* A light around a line: half of the line is half * axis, of which the latter is unit. */
typedef struct lmpi_kernel_tube {
    lmp_vec3 position;
    double per_unit; /* as of flat lights */
    double axis[3], half, radius;
    lmp_rgb radiance;
} lmpi_kernel_tube;

/* What a kernel leaves to its caller. */
enum { LMPI_LEFT_DIFFUSE = 1, LMPI_LEFT_LOBES = 2 };

#endif
