/* SPDX-License-Identifier: MIT */
/* ground.h - level ground that is not drawn itself, but receives shadows: what is seen past
 * everything is darkened where the scene hides the light of a matte plane under it. */
#ifndef LAMPION_SHADOW_GROUND_H
#define LAMPION_SHADOW_GROUND_H

#include "app/render/frame/surfaces.h"

/* Makes white matte surfaces, which emit nothing, of the pixels of a rectangle that see nothing but
 * the ground under the scene. */
void shadow_ground_lay(const scene *scene, const render_camera *camera,
                       const render_rectangle *pixels, render_tile *tile);

#endif
