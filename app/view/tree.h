/* SPDX-License-Identifier: MIT */
/* tree.h - the tree of a scene's triangles, built beside the window, and what a ray picks by it.
 * Rays of the pointer, of shadows and of images on the CPU share it. */
#ifndef LAMPION_VIEW_TREE_H
#define LAMPION_VIEW_TREE_H

#include "app/scene/trace/trace.h"
#include "app/view/camera.h"

typedef struct view_tree view_tree;

/* Begins to build the tree of a scene, which must outlive it, on another thread. Returns NULL on
 * failure. */
view_tree *view_tree_begin(const scene *scene, base_error *error);
void view_tree_end(view_tree *tree);

/* Whether the tree is there already. */
bool view_tree_is_built(view_tree *tree);

/* Returns the tree once it is built; NULL if memory ran out. */
const trace_bvh *view_tree_wait(view_tree *tree);

/* The nearest surface that a ray meets and the image shows: its mesh and instance, or -1. */
typedef struct view_hit {
    int mesh;
    long instance;
    float distance;
    lmp_vec3 point;
    lmp_vec3 normal; /* unit, of the triangle, on the side the ray comes from */
    lmp_vec3 smooth; /* unit, interpolated between its corners, on the same side; without its map */
} view_hit;

/* Finds the surface under the ray; the first call waits for the tree. */
view_hit view_pick_surface(const view_ray *ray, view_tree *tree);

#endif
