/* SPDX-License-Identifier: MIT */
/* flatten.h - a scene without instances, for what draws meshes where they are. */
#ifndef LAMPION_SCENE_FLATTEN_H
#define LAMPION_SCENE_FLATTEN_H

#include "app/scene/builder.h"

/* Replaces every instance that moves its mesh by a mesh of its own in the world. */
void builder_flatten(scene_builder *builder);

#endif
