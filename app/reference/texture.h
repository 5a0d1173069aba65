/* SPDX-License-Identifier: MIT */
/* texture.h - texture look-ups in double: base level, bilinear. */
#ifndef LAMPION_REFERENCE_TEXTURE_H
#define LAMPION_REFERENCE_TEXTURE_H

#include "app/scene/scene.h"

/* The RGBA value at those of the two pairs `uv` that the use names, colors linear; white where
 * there is no texture. */
void reference_texture_at(const scene *scene, const scene_texture_use *use, const double uv[4],
                          double rgba[4]);

#endif
