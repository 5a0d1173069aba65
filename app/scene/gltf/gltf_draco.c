/* SPDX-License-Identifier: MIT */
/* gltf_draco.c - primitives with KHR_draco_mesh_compression: their accessors get bytes of their
 * own, and the element counts of the mesh. */
#include "app/scene/gltf/draco.h"
#include "app/scene/gltf/gltf.h"

#include <stdlib.h>

/* Allocates the bytes of `count` elements of the accessor, which then owns them. */
static void *give_bytes(gltf_accessor *a, size_t count, size_t size) {
    void *const bytes = calloc(count + 1, size);
    if (!bytes)
        return NULL;
    free(a->owned);
    a->owned = bytes;
    a->bytes = bytes;
    a->count = count;
    a->stride = size;
    a->view = -1;
    a->sparse.count = 0;
    return bytes;
}

static bool unpack_corners(const draco_mesh *mesh, gltf_accessor *a) {
    a->component = GLTF_UNSIGNED_INT;
    uint32_t *const corners = give_bytes(a, 3 * draco_mesh_triangles(mesh), sizeof *corners);
    return corners && draco_mesh_corners(mesh, corners);
}

static bool unpack_attribute(const draco_mesh *mesh, json_t *id, gltf_accessor *a) {
    if (!json_is_number(id) ||
        !(json_number_value(id) >= 0.0 && json_number_value(id) <= UINT32_MAX))
        return false;
    const size_t size = (size_t)a->width * gltf_element_size("SCALAR", a->component);
    void *const numbers = give_bytes(a, draco_mesh_vertices(mesh), size);
    return numbers && draco_mesh_attribute(mesh, (uint32_t)json_number_value(id), a->width,
                                           (int)a->component, numbers);
}

/* Whether readers without the extension find all of the compressed data. */
static bool is_there_plain(const gltf *document, json_t *primitive, json_t *packed) {
    json_t *compressed = json_object_get(packed, "attributes"), *item;
    const char *name;
    json_object_foreach (compressed, name, item) {
        const long accessor = gltf_index(json_object_get(primitive, "attributes"), name);
        if (accessor >= 0 && document->accessors[accessor].view < 0)
            return false;
    }
    return document->accessors[gltf_index(primitive, "indices")].view >= 0;
}

static const char *unpack(gltf *document, json_t *primitive, json_t *packed) {
    const gltf_bytes from = gltf_view_bytes(document, (size_t)gltf_index(packed, "bufferView"));
    const long indices = gltf_index(primitive, "indices");
    json_t *compressed = json_object_get(packed, "attributes"), *item;
    const char *name;
    if (indices < 0 || gltf_number(primitive, "mode", 4.0) != 4.0)
        return "is compressed by Draco and is not an indexed list of triangles";
    draco_mesh *const mesh = draco_mesh_decode(from.bytes, from.size);
    if (!mesh)
        return is_there_plain(document, primitive, packed)
                   ? NULL
                   : "is compressed by Draco, and cannot be decoded";
    bool ok = unpack_corners(mesh, &document->accessors[indices]);
    json_object_foreach (compressed, name, item) {
        const long accessor = gltf_index(json_object_get(primitive, "attributes"), name);
        ok = ok && (accessor < 0 || unpack_attribute(mesh, item, &document->accessors[accessor]));
    }
    draco_mesh_free(mesh);
    return ok ? NULL : "has attributes that its Draco data lack";
}

bool gltf_load_draco(gltf *document, base_error *error) {
    for (size_t i = 0; i < gltf_count(document, GLTF_MESHES); i++) {
        json_t *primitives = gltf_primitives(document, i), *primitive;
        size_t number;
        json_array_foreach (primitives, number, primitive) {
            json_t *packed = gltf_extension(primitive, "KHR_draco_mesh_compression");
            const char *wrong = packed ? unpack(document, primitive, packed) : NULL;
            if (wrong)
                return gltf_fail(document, GLTF_MESHES, i, wrong, error);
        }
    }
    return true;
}
