/* SPDX-License-Identifier: MIT */
/* stage.h - what the built-in scenes have besides solids: materials, lights and a camera. */
#ifndef LAMPION_SCENE_BUILTIN_STAGE_H
#define LAMPION_SCENE_BUILTIN_STAGE_H

#include "app/scene/builder.h"

/* Appends a material and returns its index. */
uint32_t stage_material(scene_builder *builder, const char *name, lmp_rgb base_color,
                        float roughness, float metallic);

void stage_light(scene_builder *builder, lmp_light light);

/* Appends a camera; fov is vertical, in radians. */
void stage_camera(scene_builder *builder, const char *name, lmp_vec3 eye, lmp_vec3 target,
                  float fov, float aspect);

#endif
