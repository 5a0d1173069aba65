/* SPDX-License-Identifier: MIT */
/* assimp_material.h - Assimp's materials as metallic-roughness. */
#ifndef LAMPION_SCENE_LOAD_ASSIMP_MATERIAL_H
#define LAMPION_SCENE_LOAD_ASSIMP_MATERIAL_H

#include "app/scene/builder.h"
#include "app/scene/sources.h"

#include <assimp/scene.h>

/* Appends all materials with their textures. */
bool assimp_add_materials(const struct aiScene *imported, source_set *sources,
                          scene_builder *builder, base_error *error);

#endif
