/* SPDX-License-Identifier: MIT */
/* area.h - how large lights are that are areas; seen.h says what is seen of them. */
#ifndef LAMPION_LIGHT_AREA_H
#define LAMPION_LIGHT_AREA_H

#include <lampion/light.h>

/* How large an area is: the most of it that faces one direction, all that shines, and the distance
 * of its farthest point from its position. */
typedef struct lmpi_area_size {
    double facing, shining, radius;
} lmpi_area_size;

lmpi_area_size lmpi_area_measure(const lmp_light *light);

#endif
