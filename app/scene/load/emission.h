/* SPDX-License-Identifier: MIT */
/* emission.h - lights that stand for emissive meshes. */
#ifndef LAMPION_SCENE_LOAD_EMISSION_H
#define LAMPION_SCENE_LOAD_EMISSION_H

#include "app/scene/builder.h"

/* Appends hidden lights for every emissive mesh, with the same power: area times pi times radiance,
 * which is the mean over a triangle where there is an emission map, and twice that where it is
 * double-sided and open. Each piece of a mesh, whose triangles hang together, is its flat faces, if
 * these are few, or a tube if it is long and round; else a rectangle before it, or the sphere
 * around it. Of many pieces the strongest have the power of all. A mesh becomes at most `most`
 * lights, 1 to SCENE_MESH_LIGHTS_MAX, or with 0 a number that suits how many meshes shine. */
bool emission_add_lights(scene_builder *builder, size_t most, const char *subject,
                         base_error *error);

#endif
