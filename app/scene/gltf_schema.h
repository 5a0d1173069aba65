/* SPDX-License-Identifier: MIT */
/* gltf_schema.h - what glTF's schema says of the fields of its objects, as tables. */
#ifndef LAMPION_SCENE_GLTF_SCHEMA_H
#define LAMPION_SCENE_GLTF_SCHEMA_H

#include "app/scene/gltf_schema_words.h"

/* The document itself. */
extern const gltf_object gltf_schema;

#endif
