/* SPDX-License-Identifier: MIT */
/* assimp.h - every format without a reader of our own, by the library Assimp: from memory, with no
 * file but those that the scene may refer to. */
#ifndef LAMPION_SCENE_LOAD_ASSIMP_H
#define LAMPION_SCENE_LOAD_ASSIMP_H

#include "app/scene/builder.h"
#include "app/scene/sources.h"

/* Appends the meshes and materials of a file (app/scene/load/origin.h). */
bool assimp_add(const void *data, size_t size, source_set *sources, scene_builder *builder,
                base_error *error);

#endif
