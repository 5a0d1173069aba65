/* SPDX-License-Identifier: MIT */
/* Meshes that Draco compressed: reads every corner and every number of what is decoded. */
#include "app/scene/gltf/draco.h"
#include "fuzz/file.h"

#include <stdlib.h>

static void read_attributes(const draco_mesh *mesh) {
    const size_t vertices = draco_mesh_vertices(mesh);
    for (uint32_t id = 0; id < 4; id++)
        for (int width = 1; width <= 4; width++)
            for (int component = 5120; component <= 5126; component++) {
                void *const numbers = malloc(4 * (size_t)width * vertices + 1);
                if (numbers)
                    draco_mesh_attribute(mesh, id, width, component, numbers);
                free(numbers);
            }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    draco_mesh *const mesh = draco_mesh_decode(data, size);
    if (!mesh)
        return 0;
    const size_t corners = 3 * draco_mesh_triangles(mesh);
    uint32_t *const to = malloc(corners * sizeof *to + 1);
    if (to && draco_mesh_corners(mesh, to))
        for (size_t i = 0; i < corners; i++)
            if (to[i] >= draco_mesh_vertices(mesh))
                abort();
    read_attributes(mesh);
    free(to);
    draco_mesh_free(mesh);
    return 0;
}
