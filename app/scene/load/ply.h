/* SPDX-License-Identifier: MIT */
/* ply.h - PLY, the Polygon File Format: polygons and strips, with the colors of their vertices. */
#ifndef LAMPION_SCENE_LOAD_PLY_H
#define LAMPION_SCENE_LOAD_PLY_H

#include "app/scene/builder.h"
#include "app/scene/sources.h"

/* Appends the mesh and the material of a PLY file (app/scene/load/origin.h). */
bool ply_add(const void *data, size_t size, source_set *sources, scene_builder *builder,
             base_error *error);

#endif
