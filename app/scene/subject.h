/* SPDX-License-Identifier: MIT */
/* subject.h - what of a scene a camera before it frames. */
#ifndef LAMPION_SCENE_SUBJECT_H
#define LAMPION_SCENE_SUBJECT_H

#include "app/scene/scene.h"

/* Finds the whole scene, or what is small and together in wide surroundings: a model on ground that
 * reaches to the horizon, or under a dome, by its instances; or by the parts of a mesh, on level
 * ground alone. */
scene_subject scene_subject_find(const scene *s);

#endif
