/* SPDX-License-Identifier: MIT */
/* outline.h - whether corners bound an area in a plane. */
#ifndef LAMPION_SCENE_OUTLINE_H
#define LAMPION_SCENE_OUTLINE_H

#include <lampion/light.h>

/* Returns what is wrong with up to LMP_LIGHT_CORNERS_MAX corners that have no area, are not in a
 * plane or make sides that cross: text to follow the light's name; NULL for nothing. */
const char *scene_outline_wrong(const lmp_vec3 *corner, int count);

#endif
