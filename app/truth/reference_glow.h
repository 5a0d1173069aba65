/* SPDX-License-Identifier: MIT */
/* reference_glow.h - the light of emissive meshes, from their own triangles. */
#ifndef LAMPION_TRUTH_REFERENCE_GLOW_H
#define LAMPION_TRUTH_REFERENCE_GLOW_H

#include "app/scene/scene.h"

/* Copies the lights of a scene, with the triangles of emissive meshes in place of the lights that
 * stand for them, as long as these are at most REFERENCE_GLOW_MAX in all. The caller frees *lights.
 * Returns false if memory ran out. */
#define REFERENCE_GLOW_MAX 20000
bool reference_glow_lights(const scene *world, scene_light **lights, size_t *count);

#endif
