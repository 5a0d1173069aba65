/* SPDX-License-Identifier: MIT */
/* off.h - OFF, the Object File Format: polygons of numbered vertices, as text. */
#ifndef LAMPION_SCENE_LOAD_OFF_H
#define LAMPION_SCENE_LOAD_OFF_H

#include "app/scene/builder.h"
#include "app/scene/sources.h"

/* Appends the mesh of an OFF file (app/scene/load/origin.h). */
bool off_add(const void *data, size_t size, source_set *sources, scene_builder *builder,
             base_error *error);

#endif
