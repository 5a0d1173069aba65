/* SPDX-License-Identifier: MIT */
/* up.h - scenes whose third axis points up. */
#ifndef LAMPION_SCENE_UP_H
#define LAMPION_SCENE_UP_H

#include "app/scene/builder.h"

/* Rotates all that has been made, by a quarter turn around x, so that the axis `up` becomes y. */
void up_stand(scene_builder *builder, int up);

#endif
