/* SPDX-License-Identifier: MIT */
/* gltf_deform.h - morph targets and skins as they stand without animation. */
#ifndef LAMPION_SCENE_GLTF_DEFORM_H
#define LAMPION_SCENE_GLTF_DEFORM_H

#include "app/scene/gltf.h"
#include "app/scene/mesh.h"

/* Adds a primitive's morph targets to its vertices, weighted as the node or else the mesh says. */
bool gltf_morph(const gltf *document, const cJSON *node, const cJSON *primitive, mesh_draft *draft,
                cli_error *error);

/* Whether a node deforms its mesh in a way of its own. */
bool gltf_deforms(const cJSON *node);

/* Takes the vertices into the world: by the joints of the node's skin that each one hangs on, and
 * where none holds it by `world`. */
bool gltf_to_world(const gltf *document, const cJSON *node, const cJSON *attributes,
                   const double world[16], mesh_draft *draft, cli_error *error);

#endif
