/* SPDX-License-Identifier: MIT */
/* gltf_schema.h - glTF's schema of objects and fields, as tables. */
#ifndef LAMPION_SCENE_GLTF_GLTF_SCHEMA_H
#define LAMPION_SCENE_GLTF_GLTF_SCHEMA_H

#include "app/scene/gltf/gltf_schema_words.h"

/* The schema of a document. */
extern const gltf_object gltf_schema;

#endif
