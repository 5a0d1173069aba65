/* SPDX-License-Identifier: MIT */
/* emission.h - sphere lights that stand for emissive meshes. */
#ifndef LAMPION_SCENE_EMISSION_H
#define LAMPION_SCENE_EMISSION_H

#include "app/scene/builder.h"

/* Appends one hidden light for every mesh that glows: the sphere around its glowing triangles, of
 * the same power (area times pi times mean radiance; twice that if double-sided). */
bool emission_add_lights(scene_builder *builder, const char *subject, cli_error *error);

#endif
