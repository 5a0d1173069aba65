/* SPDX-License-Identifier: MIT */
/* patches.h - flat patches of an emissive surface as lights. */
#ifndef LAMPION_SCENE_LOAD_PATCHES_H
#define LAMPION_SCENE_LOAD_PATCHES_H

#include <lampion/light.h>

#include <stdbool.h>
#include <stddef.h>

/* A triangle that shines from the side on which its corners are counter-clockwise, or from both. */
typedef struct patch_triangle {
    lmp_vec3 corner[3];
    float radiance[3];
    bool both;
    bool outward; /* of a closed body, which shines outward */
} patch_triangle;

/* Returns the area of one side. */
double patch_triangle_area(const patch_triangle *triangle);

/* Makes lights of triangles that have areas: neighbors in a plane together are a rectangle, a
 * polygon or a disk, to a thousandth of their size, of their mean radiance; else each triangle is a
 * polygon. *made becomes 0 if that takes more than `most` lights. Returns false if memory ran
 * out. */
bool patches_make(const patch_triangle *triangles, size_t count, size_t most, lmp_light *lights,
                  size_t *made);

#endif
