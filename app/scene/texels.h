/* SPDX-License-Identifier: MIT */
/* texels.h - the images of a scene decoded, in sandboxed children side by side. */
#ifndef LAMPION_SCENE_TEXELS_H
#define LAMPION_SCENE_TEXELS_H

#include "app/scene/scene.h"

/* Decodes all images of a scene that has been opened. One that cannot be decoded is left out: its
 * materials are shown without it. */
bool scene_decode_images(scene *scene, cli_error *error);

#endif
