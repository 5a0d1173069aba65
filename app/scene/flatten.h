/* SPDX-License-Identifier: MIT */
/* flatten.h - a scene without instances, for code that draws every mesh where its vertices are. */
#ifndef LAMPION_SCENE_FLATTEN_H
#define LAMPION_SCENE_FLATTEN_H

#include "app/scene/builder.h"

/* Replaces every instance that moves its mesh by a mesh of its own, transformed into the world. */
void builder_flatten(scene_builder *builder);

#endif
