/* SPDX-License-Identifier: MIT */
/* node.h - the tree of a scene's nodes, each a run of instances. */
#ifndef LAMPION_SCENE_NODE_H
#define LAMPION_SCENE_NODE_H

#include "app/scene/scene.h"

/* Returns a node's name, or that of its mesh. */
const char *scene_node_name(const scene *scene, size_t node);

/* Returns the instance after the last one below a node. */
size_t scene_node_end(const scene *scene, size_t node);

/* Returns the node that an instance is a part of. */
size_t scene_node_of(const scene *scene, size_t instance);

/* Finds the bounds of all instances below a node; returns false if there are none. */
bool scene_node_bounds(const scene *scene, size_t node, float minimum[3], float maximum[3]);

#endif
