/* SPDX-License-Identifier: MIT */
/* up.h - scenes whose third axis points up. */
#ifndef LAMPION_SCENE_LOAD_UP_H
#define LAMPION_SCENE_LOAD_UP_H

#include "app/scene/builder.h"

/* Resolves which axis of the file points up: `up` or, with AUTO, what the reader found, else y. If
 * it is z, rotates everything in the builder by a quarter turn around x, so that it becomes y. */
void up_stand(scene_builder *builder, int up);

#endif
