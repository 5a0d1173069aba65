/* SPDX-License-Identifier: MIT */
/* block.h - the contents of the shaders' blocks for a scene, independent of any graphics API. */
#ifndef LAMPION_RENDER_GL_BLOCK_H
#define LAMPION_RENDER_GL_BLOCK_H

#include "app/scene/scene.h"
#include "shaders/program/shared.h"

/* Fills the block of a scene's material `number`. */
void gpu_fill_material(const scene_material *material, size_t number, shared_material *block);

/* Whether a material has neither maps nor colors of vertices nor layers, and hides all behind it:
 * SURFACE_PLAIN draws it. */
bool gpu_material_is_plain(const scene_material *material);

/* Returns the material constants of a material that no table replaces. */
shared_material_constants gpu_material_constants(const scene_material *material);

/* Fills `block` with the lights, each at its own index, followed by one for all ambient light if
 * there is any; returns how many lights the shaders read. */
size_t gpu_take_lights(const scene_light *lights, size_t count, shared_light *block);

/* Fills texels with LMP_AREA_TEXELS of each light that is an area, and its number among all. */
void gpu_take_areas(const scene_light *lights, size_t count, vec4 *texels);

#endif
