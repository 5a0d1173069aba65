/* SPDX-License-Identifier: MIT */
/* preview.h - a coarser copy of a scene, to be drawn while things move. */
#ifndef LAMPION_VIEW_PREVIEW_H
#define LAMPION_VIEW_PREVIEW_H

#include "app/scene/scene.h"

/* Merges vertices of a mesh that lie in one cell of a grid and face the same octant; triangles that
 * become degenerate are dropped. The grid has `cells` cells along the scene's diagonal. The copy
 * shares materials, textures and cameras with the scene, has no lights, and is freed by
 * view_preview_free. */
bool view_preview_make(const scene *world, int cells, scene *preview, base_error *error);
void view_preview_free(scene *preview);

#endif
