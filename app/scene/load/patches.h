/* SPDX-License-Identifier: MIT */
/* patches.h - flat patches of an emissive surface as lights. */
#ifndef LAMPION_SCENE_LOAD_PATCHES_H
#define LAMPION_SCENE_LOAD_PATCHES_H

#include "app/scene/load/pieces.h"

/* Makes lights of triangles that have areas: neighbors in a plane together are a rectangle, a
 * polygon or a disk, to a thousandth of their size, of their mean radiance; else each triangle is a
 * polygon. *made becomes 0 if that takes more than `most` lights. Returns false if memory ran
 * out. */
bool patches_make(const piece_triangle *triangles, size_t count, size_t most, lmp_light *lights,
                  size_t *made);

#endif
