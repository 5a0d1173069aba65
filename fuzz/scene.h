/* SPDX-License-Identifier: MIT */
/* scene.h - for readers of scenes: checks that what they made is valid. */
#ifndef LAMPION_FUZZ_SCENE_H
#define LAMPION_FUZZ_SCENE_H

#include "app/scene/builder.h"
#include "app/scene/instance.h"
#include "fuzz/file.h"

#include <stdlib.h>

/* Checks that the program may use every index, count and number; only positions may be too far
 * away, and materials missing, which the importer checks itself. */
static inline void fuzz_scene_check(const scene_builder *builder) {
    const size_t vertices = builder_count(builder, BLOB_VERTICES);
    const uint32_t *indices = builder_items(builder, BLOB_INDICES);
    const scene_mesh *meshes = builder_items(builder, BLOB_MESHES);
    for (size_t i = 0; i < builder_count(builder, BLOB_INDICES); i++)
        if (indices[i] >= vertices)
            abort();
    for (size_t i = 0; i < builder_count(builder, BLOB_MESHES); i++)
        if (meshes[i].material >= builder_count(builder, BLOB_MATERIALS))
            abort();
    const scene_instance *instances = builder_items(builder, BLOB_INSTANCES);
    for (size_t i = 0; i < builder_count(builder, BLOB_INSTANCES); i++)
        if (instances[i].mesh >= builder_count(builder, BLOB_MESHES) ||
            !scene_instance_fits(&instances[i]))
            abort();
}

#endif
