/* SPDX-License-Identifier: MIT */
/* texels.h - decoding of a scene's images, in sandboxed children side by side. */
#ifndef LAMPION_SCENE_LOAD_TEXELS_H
#define LAMPION_SCENE_LOAD_TEXELS_H

#include "app/scene/scene.h"

/* Decodes all images of an opened scene. Materials lose an image that cannot be decoded. */
bool scene_decode_images(scene *scene, base_error *error);

/* Copies the materials and the list of unsupported features out of the scene's block, so that they
 * can be changed. */
bool scene_own_lists(scene *scene, base_error *error);

#endif
