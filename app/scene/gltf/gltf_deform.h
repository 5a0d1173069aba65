/* SPDX-License-Identifier: MIT */
/* gltf_deform.h - morph targets and skins in the pose of the file, without animation. */
#ifndef LAMPION_SCENE_GLTF_GLTF_DEFORM_H
#define LAMPION_SCENE_GLTF_GLTF_DEFORM_H

#include "app/scene/gltf/gltf.h"
#include "app/scene/mesh.h"

/* Adds a primitive's morph targets to its vertices, with the weights of the node, else of the
 * mesh. */
bool gltf_morph(const gltf *document, json_t *node, json_t *primitive, mesh_draft *draft,
                base_error *error);

/* Whether a node deforms its mesh, so that it cannot share it with other nodes. */
bool gltf_deforms(json_t *node);

/* Transforms the vertices to the world: by the joints of the node's skin, and those without joints
 * by `world`. */
bool gltf_to_world(const gltf *document, json_t *node, json_t *attributes, const double world[16],
                   mesh_draft *draft, base_error *error);

#endif
