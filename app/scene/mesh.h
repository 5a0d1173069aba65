/* SPDX-License-Identifier: MIT */
/* mesh.h - from Assimp's node tree to triangles in world space. */
#ifndef LAMPION_SCENE_MESH_H
#define LAMPION_SCENE_MESH_H

#include "app/scene/builder.h"

#include <assimp/scene.h>

typedef struct mesh_options {
    const char *subject;
    bool weld;        /* merge equal vertices: the source has them once a corner */
    float crease_cos; /* missing normals are smooth across edges flatter than this; above 1: flat */
} mesh_options;

/* Appends every mesh of every node, transformed; polygons become fans. Material numbers are kept.
 */
bool mesh_add_tree(const struct aiScene *imported, const mesh_options *options,
                   scene_builder *builder, cli_error *error);

#endif
