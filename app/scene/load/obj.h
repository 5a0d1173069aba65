/* SPDX-License-Identifier: MIT */
/* obj.h - Wavefront OBJ: polygons as fans, with the materials of its MTL files. */
#ifndef LAMPION_SCENE_LOAD_OBJ_H
#define LAMPION_SCENE_LOAD_OBJ_H

#include "app/scene/builder.h"
#include "app/scene/sources.h"

/* Appends the meshes and materials of an OBJ file (app/scene/load/origin.h). */
bool obj_add(const void *data, size_t size, source_set *sources, scene_builder *builder,
             base_error *error);

#endif
