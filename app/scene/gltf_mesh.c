/* SPDX-License-Identifier: MIT */
/* gltf_mesh.c - the triangles of the scene's nodes, in world space. */
#include "app/scene/gltf.h"
#include "app/scene/mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MODE_TRIANGLES = 4, MODE_STRIP = 5, MODE_FAN = 6 };

/* --- a primitive's numbers ----------------------------------------------------------------------
 */

/* Reads an attribute if it is there; *numbers is NULL if not. */
static bool read_attribute(const gltf *document, const cJSON *attributes, const char *name,
                           float **numbers, cli_error *error) {
    const long accessor = gltf_index(attributes, name);
    *numbers = NULL;
    return accessor < 0 || gltf_read_floats(document, (size_t)accessor, numbers, error);
}

/* Fills `width` of the floats of every vertex, which begin `offset` bytes into it. */
static void fill(mesh_draft *draft, const float *numbers, int width, size_t offset) {
    for (size_t i = 0; numbers && i < draft->vertex_count; i++)
        memcpy((char *)&draft->vertices[i] + offset, numbers + i * (size_t)width,
               (size_t)width * sizeof *numbers);
}

static bool read_vertices(const gltf *document, const cJSON *attributes, mesh_draft *draft,
                          cli_error *error) {
    static const struct {
        const char *name;
        int width;
        size_t offset;
    } parts[] = { { "POSITION", 3, offsetof(scene_vertex, position) },
                  { "NORMAL", 3, offsetof(scene_vertex, normal) },
                  { "TANGENT", 4, offsetof(scene_vertex, tangent) },
                  { "TEXCOORD_0", 2, offsetof(scene_vertex, uv) } };
    draft->vertex_count = document->accessors[gltf_index(attributes, "POSITION")].count;
    draft->has_normals = gltf_member(attributes, "NORMAL") != NULL;
    draft->has_uvs = gltf_member(attributes, "TEXCOORD_0") != NULL;
    draft->vertices = calloc(draft->vertex_count, sizeof *draft->vertices);
    if (!draft->vertices)
        return cli_fail(error, document->subject, "does not fit into memory");
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        float *numbers;
        /* Tangents belong to the normals that they come with. */
        if (i == 2 && !draft->has_normals)
            continue;
        const bool ok = read_attribute(document, attributes, parts[i].name, &numbers, error);
        if (ok)
            fill(draft, numbers, parts[i].width, parts[i].offset);
        free(numbers);
        if (!ok)
            return false;
    }
    return true;
}

/* The vertices of triangle `i` of a strip or fan: every second of a strip is turned over. */
static void unroll(int mode, size_t i, size_t corner[3]) {
    const size_t odd = mode == MODE_STRIP ? i % 2 : 0;
    corner[0] = mode == MODE_TRIANGLES ? 3 * i : mode == MODE_STRIP ? i : i + 1;
    corner[1] = mode == MODE_FAN ? i + 2 : corner[0] + 1 + odd;
    corner[2] = mode == MODE_FAN ? 0 : corner[0] + 2 - odd;
}

static bool read_corners(const gltf *document, const cJSON *primitive, mesh_draft *draft,
                         cli_error *error) {
    const int mode = (int)gltf_number(primitive, "mode", MODE_TRIANGLES);
    const long accessor = gltf_index(primitive, "indices");
    uint32_t *indices = NULL;
    const size_t count = accessor < 0 ? draft->vertex_count : document->accessors[accessor].count;
    if (accessor >= 0 &&
        !gltf_read_integers(document, (size_t)accessor, draft->vertex_count, &indices, error)) {
        free(indices);
        return false;
    }
    const size_t triangles = mode == MODE_TRIANGLES ? count / 3 : count < 3 ? 0 : count - 2;
    draft->corner_count = 3 * triangles;
    draft->corners = malloc((draft->corner_count + 1) * sizeof *draft->corners);
    for (size_t i = 0; draft->corners && i < triangles; i++) {
        size_t corner[3];
        unroll(mode, i, corner);
        for (int k = 0; k < 3; k++)
            draft->corners[3 * i + (size_t)k] = indices ? indices[corner[k]] : (uint32_t)corner[k];
    }
    free(indices);
    return draft->corners || cli_fail(error, document->subject, "does not fit into memory");
}

/* --- nodes --------------------------------------------------------------------------------------
 */

static bool is_drawn(const cJSON *primitive) {
    return gltf_number(primitive, "mode", MODE_TRIANGLES) >= MODE_TRIANGLES &&
           gltf_member(gltf_member(primitive, "attributes"), "POSITION");
}

static bool add_primitive(const gltf *document, const cJSON *primitive, const char *name,
                          const double world[16], scene_builder *builder, cli_error *error) {
    const long material = gltf_index(primitive, "material");
    const mesh_transform transform = mesh_transform_make(world);
    mesh_draft draft = { .subject = document->subject,
                         .name = name,
                         .material = material < 0 ? (uint32_t)gltf_count(document, GLTF_MATERIALS)
                                                  : (uint32_t)material,
                         .crease_cos = MESH_CREASE_FLAT };
    bool ok = read_vertices(document, gltf_member(primitive, "attributes"), &draft, error) &&
              read_corners(document, primitive, &draft, error);
    for (size_t i = 0; ok && i < draft.vertex_count; i++)
        mesh_transform_vertex(&transform, &draft.vertices[i]);
    if (ok && transform.mirrors)
        mesh_flip(&draft);
    ok = ok && mesh_add(&draft, builder, error);
    mesh_free(&draft);
    return ok;
}

static bool add_mesh(const gltf *document, size_t mesh, const double world[16],
                     scene_builder *builder, cli_error *error) {
    const cJSON *entry = gltf_item(document, GLTF_MESHES, mesh);
    const cJSON *primitives = gltf_member(entry, "primitives"), *primitive;
    const bool several = cJSON_GetArraySize(primitives) > 1;
    char own[SCENE_NAME_SIZE], name[2 * SCENE_NAME_SIZE];
    snprintf(own, sizeof own, "mesh %zu", mesh);
    if (gltf_text(entry, "name")[0])
        scene_clean_name(own, gltf_text(entry, "name"));
    int number = 0;
    cJSON_ArrayForEach(primitive, primitives) {
        snprintf(name, sizeof name, several ? "%s-%d" : "%s", own, number++);
        if (is_drawn(primitive) && !add_primitive(document, primitive, name, world, builder, error))
            return false;
    }
    return true;
}

static void note_undrawn(const gltf *document, scene_builder *builder) {
    for (size_t i = 0; i < gltf_count(document, GLTF_MESHES); i++) {
        const cJSON *mesh = gltf_item(document, GLTF_MESHES, i), *primitive;
        cJSON_ArrayForEach(primitive, gltf_member(mesh, "primitives")) {
            if (!is_drawn(primitive))
                builder_left_out(builder, "points and lines", "primitive", 1);
        }
    }
}

bool gltf_add_meshes(const gltf *document, scene_builder *builder, cli_error *error) {
    note_undrawn(document, builder);
    for (size_t i = 0; i < gltf_count(document, GLTF_NODES); i++) {
        const size_t node = document->order[i];
        const long mesh = gltf_index(gltf_item(document, GLTF_NODES, node), "mesh");
        if (mesh >= 0 && document->nodes[node].shown &&
            !add_mesh(document, (size_t)mesh, document->nodes[node].world, builder, error))
            return false;
    }
    return true;
}
