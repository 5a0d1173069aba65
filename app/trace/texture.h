/* SPDX-License-Identifier: MIT */
/* texture.h - texture look-ups in double: base level, bilinear. */
#ifndef LAMPION_TRACE_TEXTURE_H
#define LAMPION_TRACE_TEXTURE_H

#include "app/scene/scene.h"

/* The RGBA value at `uv`, colors linear; white where there is no texture. */
void trace_texture_at(const scene *scene, const scene_texture_use *use, const double uv[2],
                      double rgba[4]);
/* Its last channel alone, which needs no curve: rays ask for it at each leaf that they meet. */
double trace_texture_alpha(const scene *scene, const scene_texture_use *use, const double uv[2]);

#endif
