/* SPDX-License-Identifier: MIT */
/* round.h - long round bodies, such as neon tubes, as lights. */
#ifndef LAMPION_SCENE_LOAD_ROUND_H
#define LAMPION_SCENE_LOAD_ROUND_H

#include "app/scene/load/patches.h"

/* Makes a tube around the triangles of a closed body, without its radiance, if their corners and
 * surface are within 2 % of it. The ends may be flat where the body is 30 times as long as it is
 * thick: the tube then ends a radius past them. */
bool round_make_tube(const piece_triangle *triangles, size_t count, lmp_light *tube);

#endif
