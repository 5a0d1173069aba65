/* SPDX-License-Identifier: MIT */
/* leaves.h - foliage in files that say nothing of transmission: core glTF cannot express it, and
 * leaves lit from behind would be black. */
#ifndef LAMPION_SCENE_LOAD_LEAVES_H
#define LAMPION_SCENE_LOAD_LEAVES_H

#include "app/scene/scene.h"

/* Sets SCENE_LEAF on masked, double-sided, non-metallic materials with a mostly green base color,
 * unless any material of the scene specifies transmission itself. Images must have been decoded.
 * *count receives the number of leaves. Returns false if memory ran out. */
bool scene_find_leaves(scene *scene, size_t *count, base_error *error);

#endif
