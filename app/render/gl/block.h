/* SPDX-License-Identifier: MIT */
/* block.h - what the shaders' blocks hold of a scene; no graphics API has a part in it. */
#ifndef LAMPION_GPU_BLOCK_H
#define LAMPION_GPU_BLOCK_H

#include "app/scene/scene.h"
#include "shaders/shared.h"

/* Material `number` of its scene. */
void gpu_fill_material(const scene_material *material, size_t number, shared_material *block);

/* What it is all over; without a table. */
shared_reflector gpu_reflector(const scene_material *material);

/* Lights, each at its own index, and one more in `block` if some are ambient; returns how many the
 * shaders have to take. */
size_t gpu_take_lights(const scene_light *lights, size_t count, shared_light *block);

#endif
