/* SPDX-License-Identifier: MIT */
/* leak.h - whether a surface holds the light that starts on its inner side. */
#ifndef LAMPION_SCENE_LEAK_H
#define LAMPION_SCENE_LEAK_H

#include <stddef.h>

typedef struct leak_triangle {
    float corner[3][3];
} leak_triangle;

/* Returns the part, 0 to 1, of the light that evenly bright triangles send from one side of theirs
 * and that meets no other of them: 0 in a closed body, 1 on a flat sheet, and in a body with holes
 * their area over its own. The side is that of the fronts, from which corners are counter-clockwise
 * or, with side -1, the backs'. What exceeds `most` is not measured further. Triangles that all
 * lack area hold nothing. */
double leak_part(const leak_triangle *triangles, size_t count, int side, double most);

#endif
