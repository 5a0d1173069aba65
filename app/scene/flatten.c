/* SPDX-License-Identifier: MIT */
#include "app/scene/flatten.h"

#include "app/scene/instance.h"

#include <string.h>

/* Appends the mesh of an instance, transformed into the world. */
static void append_moved(scene_builder *builder, scene_instance placed) {
    const scene_mesh mesh = ((scene_mesh *)builder_items(builder, BLOB_MESHES))[placed.mesh];
    const size_t first_index = builder_count(builder, BLOB_INDICES);
    const size_t first_vertex = builder_count(builder, BLOB_VERTICES);
    uint32_t *indices = builder_append(builder, BLOB_INDICES, mesh.index_count);
    const uint32_t *from = builder_items(builder, BLOB_INDICES);
    uint32_t least = UINT32_MAX, most = 0;
    for (uint32_t i = 0; indices && i < mesh.index_count; i++) {
        const uint32_t index = from[mesh.first_index + i];
        least = index < least ? index : least;
        most = index > most ? index : most;
    }
    scene_vertex *vertices =
        indices ? builder_append(builder, BLOB_VERTICES, (size_t)most - least + 1) : NULL;
    if (!vertices)
        return;
    const scene_vertex *old = builder_items(builder, BLOB_VERTICES);
    const size_t count = (size_t)most - least + 1;
    memcpy(vertices, old + least, count * sizeof *vertices);
    scene_instance_vertices(&placed, vertices, count);
    const bool mirrors = scene_instance_mirrors(&placed);
    for (uint32_t i = 0; i < mesh.index_count; i++) {
        const uint32_t corner = mirrors && i % 3 > 0 ? i - i % 3 + 3 - i % 3 : i;
        indices[i] = (uint32_t)first_vertex + from[mesh.first_index + corner] - least;
    }
    builder_mesh(builder, mesh.name, mesh.material, first_index);
}

void builder_flatten(scene_builder *builder) {
    const size_t count = builder_count(builder, BLOB_INSTANCES);
    builder->centers_meshes = false; /* the meshes are to stay at their positions in the scene */
    for (size_t i = 0; i < count; i++) {
        scene_instance *instances = builder_items(builder, BLOB_INSTANCES);
        if (scene_instance_is_identity(&instances[i]))
            continue;
        append_moved(builder, instances[i]);
        if (builder->out_of_memory)
            return;
        instances[i] = scene_instance_identity((uint32_t)builder_count(builder, BLOB_MESHES) - 1);
    }
}
