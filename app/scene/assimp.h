/* SPDX-License-Identifier: MIT */
/* assimp.h - every format but glTF, by the library Assimp: from memory, with no file but those that
 * the scene may refer to. */
#ifndef LAMPION_SCENE_ASSIMP_H
#define LAMPION_SCENE_ASSIMP_H

#include "app/scene/builder.h"
#include "app/scene/sources.h"

/* Whether it reads files of this ending, as ".ply". */
bool assimp_knows(const char *ending);

/* Appends the meshes and materials of a file (app/scene/origin.h). */
bool assimp_add(const void *data, size_t size, source_set *sources, scene_builder *builder,
                cli_error *error);

#endif
