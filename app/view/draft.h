/* SPDX-License-Identifier: MIT */
/* draft.h - a coarser copy of a scene, to be drawn while things move. */
#ifndef LAMPION_VIEW_DRAFT_H
#define LAMPION_VIEW_DRAFT_H

#include "app/scene/scene.h"

/* Vertices of a mesh that lie in one cell of a grid and face the same octant become one; triangles
 * that this flattens are left out. The grid has `cells` cells along the scene's diagonal. The copy
 * shares materials, textures and cameras with the scene, has no lights, and is freed by
 * view_draft_free. */
bool view_draft_make(const scene *world, int cells, scene *draft, cli_error *error);
void view_draft_free(scene *draft);

#endif
