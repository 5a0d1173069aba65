/* SPDX-License-Identifier: MIT */
/* emission.h - lights that stand for emissive meshes. */
#ifndef LAMPION_SCENE_LOAD_EMISSION_H
#define LAMPION_SCENE_LOAD_EMISSION_H

#include "app/scene/builder.h"

/* Appends hidden lights for every emissive mesh, with the same power: area times pi times radiance,
 * twice that where it is double-sided and open. They are its flat faces, if these are few, or a
 * tube for a long round body; else the sphere around its triangles. */
bool emission_add_lights(scene_builder *builder, const char *subject, base_error *error);

#endif
