/* SPDX-License-Identifier: MIT */
/* gltf_schema_material.h - the schema of images, textures and materials. */
#ifndef LAMPION_SCENE_GLTF_GLTF_SCHEMA_MATERIAL_H
#define LAMPION_SCENE_GLTF_GLTF_SCHEMA_MATERIAL_H

#include "app/scene/gltf/gltf_schema_words.h"

extern const gltf_object gltf_schema_image, gltf_schema_sampler, gltf_schema_texture,
    gltf_schema_material;

#endif
