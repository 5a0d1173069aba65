/* SPDX-License-Identifier: MIT */
/* ground.h - level ground that is not drawn itself but receives shadows: the background is darkened
 * where the scene hides light from a diffuse plane under it. */
#ifndef LAMPION_RENDER_SHADOW_GROUND_H
#define LAMPION_RENDER_SHADOW_GROUND_H

#include "app/render/surfaces.h"

/* Turns pixels of a rectangle that see nothing but the ground under the scene into white diffuse
 * surfaces without emission. */
void shadow_ground_lay(const scene *scene, const render_camera *camera,
                       const render_rectangle *pixels, render_tile *tile);

#endif
