/* SPDX-License-Identifier: MIT */
/* texture_at.h - texture look-ups in double: base level, bilinear. */
#ifndef LAMPION_SCENE_TEXTURE_AT_H
#define LAMPION_SCENE_TEXTURE_AT_H

#include "app/scene/scene.h"

/* Looks up the RGBA value at `uv`, colors linear; white without a texture. */
void texture_at(const scene *scene, const scene_texture_use *use, const double uv[2],
                double rgba[4]);
/* Looks up the alpha channel alone, which needs no transfer curve: rays ask for it at each leaf
 * that they meet. */
double texture_alpha_at(const scene *scene, const scene_texture_use *use, const double uv[2]);
/* Averages the RGBA value over the triangle between three coordinates `uv`, by about one look-up
 * per texel, 64 along a side at most. */
void texture_mean_at(const scene *scene, const scene_texture_use *use, double (*uv)[2],
                     double rgba[4]);

#endif
