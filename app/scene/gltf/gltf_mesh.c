/* SPDX-License-Identifier: MIT */
/* gltf_mesh.c - the meshes of the scene's nodes, and their instances. */
#include "app/base/sandbox.h"
#include "app/scene/gltf/gltf_deform.h"
#include "app/scene/instance.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MODE_TRIANGLES = 4, MODE_STRIP = 5, MODE_FAN = 6 };

/* --- a primitive's numbers -------------------------------------------------------------------- */

/* Reads an attribute; *numbers is NULL if it is absent. */
static bool read_attribute(const gltf *document, json_t *attributes, const char *name,
                           float **numbers, base_error *error) {
    const long accessor = gltf_index(attributes, name);
    *numbers = NULL;
    return accessor < 0 || gltf_read_floats(document, (size_t)accessor, numbers, error);
}

/* Stores `width` floats of every vertex, `offset` bytes into it. */
static void fill(mesh_draft *draft, const float *numbers, int width, size_t offset) {
    for (size_t i = 0; numbers && i < draft->vertex_count; i++)
        memcpy((char *)&draft->vertices[i] + offset, numbers + i * (size_t)width,
               (size_t)width * sizeof *numbers);
}

/* Reads `width` floats of an attribute, if present, into every vertex at `offset` bytes. */
static bool fill_attribute(const gltf *document, json_t *attributes, const char *name, int width,
                           size_t offset, mesh_draft *draft, base_error *error) {
    float *numbers;
    const bool ok = read_attribute(document, attributes, name, &numbers, error);
    if (ok)
        fill(draft, numbers, width, offset);
    free(numbers);
    return ok;
}

static bool read_coordinates(const gltf *document, json_t *primitive, mesh_draft *draft,
                             base_error *error) {
    json_t *attributes = json_object_get(primitive, "attributes");
    const long material = gltf_primitive_material(document, primitive);
    long sets[2] = { -1, -1 };
    if (material >= 0)
        gltf_material_sets(gltf_item(document, GLTF_MATERIALS, (size_t)material), sets);
    for (size_t k = 0; k < 2 && sets[k] >= 0; k++) {
        char name[32];
        snprintf(name, sizeof name, "TEXCOORD_%ld", sets[k]);
        if (!json_object_get(attributes, name))
            builder_unsupported(document->builder, "missing texture coordinates", "primitive", 1);
        if (!fill_attribute(document, attributes, name, 2,
                            offsetof(scene_vertex, uv) + k * sizeof draft->vertices->uv[0], draft,
                            error))
            return false;
    }
    /* without textures, coordinates still orient an anisotropic material */
    return sets[0] >= 0 || fill_attribute(document, attributes, "TEXCOORD_0", 2,
                                          offsetof(scene_vertex, uv), draft, error);
}

static uint16_t as_color(float x) {
    return (uint16_t)(65535.0f * fminf(fmaxf(x, 0.0f), 1.0f) + 0.5f);
}

static bool read_colors(const gltf *document, json_t *attributes, mesh_draft *draft,
                        base_error *error) {
    const long accessor = gltf_index(attributes, "COLOR_0");
    const int width = accessor < 0 ? 0 : document->accessors[accessor].width;
    float *numbers;
    const bool ok = read_attribute(document, attributes, "COLOR_0", &numbers, error);
    for (size_t i = 0; ok && i < draft->vertex_count; i++)
        for (int k = 0; k < 4; k++)
            draft->vertices[i].color[k] =
                k < width ? as_color(numbers[i * (size_t)width + (size_t)k]) : 65535;
    free(numbers);
    return ok;
}

static bool read_vertices(const gltf *document, json_t *primitive, mesh_draft *draft,
                          base_error *error) {
    json_t *attributes = json_object_get(primitive, "attributes");
    draft->vertex_count = document->accessors[gltf_index(attributes, "POSITION")].count;
    draft->has_normals = json_object_get(attributes, "NORMAL") != NULL;
    draft->vertices = calloc(draft->vertex_count, sizeof *draft->vertices);
    if (!draft->vertices)
        return base_fail(error, document->subject, "does not fit into memory");
    return fill_attribute(document, attributes, "POSITION", 3, offsetof(scene_vertex, position),
                          draft, error) &&
           fill_attribute(document, attributes, "NORMAL", 3, offsetof(scene_vertex, normal), draft,
                          error) &&
           /* tangents are valid only with the normals they come with */
           (!draft->has_normals || fill_attribute(document, attributes, "TANGENT", 4,
                                                  offsetof(scene_vertex, tangent), draft, error)) &&
           read_coordinates(document, primitive, draft, error) &&
           read_colors(document, attributes, draft, error);
}

/* Finds the vertices of triangle `i` of a list, strip or fan: every second triangle of a strip is
 * reversed. */
static void unroll(int mode, size_t i, size_t corner[3]) {
    const size_t odd = mode == MODE_STRIP ? i % 2 : 0;
    corner[0] = mode == MODE_TRIANGLES ? 3 * i : mode == MODE_STRIP ? i : i + 1;
    corner[1] = mode == MODE_FAN ? i + 2 : corner[0] + 1 + odd;
    corner[2] = mode == MODE_FAN ? 0 : corner[0] + 2 - odd;
}

static bool read_corners(const gltf *document, json_t *primitive, mesh_draft *draft,
                         base_error *error) {
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
    return draft->corners || base_fail(error, document->subject, "does not fit into memory");
}

/* --- nodes ------------------------------------------------------------------------------------ */

static bool is_drawn(json_t *primitive) {
    return gltf_number(primitive, "mode", MODE_TRIANGLES) >= MODE_TRIANGLES &&
           json_object_get(json_object_get(primitive, "attributes"), "POSITION");
}

/* State that the nodes share. */
typedef struct mesh_reader {
    const gltf *document;
    scene_builder *builder;
    struct {
        bool there;
        size_t first, count; /* of the scene's meshes */
    } * shared;              /* for each mesh of the document */
    base_error *error;
} mesh_reader;

static bool add_primitive(const mesh_reader *r, json_t *node, json_t *primitive, const char *name,
                          const double world[16]) {
    json_t *attributes = json_object_get(primitive, "attributes");
    const long material = gltf_primitive_material(r->document, primitive);
    mesh_draft draft = { .subject = r->document->subject,
                         .name = name,
                         .material = material < 0
                                         ? (uint32_t)gltf_count(r->document, GLTF_MATERIALS)
                                         : (uint32_t)material,
                         .crease_cos = MESH_CREASE_FLAT };
    const bool ok = read_vertices(r->document, primitive, &draft, r->error) &&
                    read_corners(r->document, primitive, &draft, r->error) &&
                    gltf_morph(r->document, node, primitive, &draft, r->error) &&
                    gltf_to_world(r->document, node, attributes, world, &draft, r->error) &&
                    mesh_add(&draft, r->builder, r->error);
    mesh_free(&draft);
    return ok;
}

static bool add_primitives(const mesh_reader *r, json_t *node, const double world[16]) {
    const size_t mesh = (size_t)gltf_index(node, "mesh");
    json_t *entry = gltf_item(r->document, GLTF_MESHES, mesh);
    json_t *primitives = gltf_primitives(r->document, mesh), *primitive;
    const bool several = json_array_size(primitives) > 1;
    char own[SCENE_NAME_SIZE], name[2 * SCENE_NAME_SIZE];
    snprintf(own, sizeof own, "mesh %zu", mesh);
    if (gltf_text(entry, "name")[0])
        scene_clean_name(own, gltf_text(entry, "name"));
    size_t number;
    json_array_foreach (primitives, number, primitive) {
        snprintf(name, sizeof name, several ? "%s-%zu" : "%s", own, number);
        if (is_drawn(primitive) && !add_primitive(r, node, primitive, name, world))
            return false;
    }
    return true;
}

/* --- instances -------------------------------------------------------------------------------- */

/* Adds the mesh of a node, placed by a matrix. A node that deforms its mesh, or a matrix that does
 * not fit an instance, gets meshes of its own. */
static bool add_mesh(const mesh_reader *r, json_t *node, const double world[16]) {
    static const double same[16] = { [0] = 1, [5] = 1, [10] = 1, [15] = 1 };
    const size_t mesh = (size_t)gltf_index(node, "mesh");
    const size_t next = builder_count(r->builder, BLOB_MESHES);
    if (json_object_get(node, "skin") || !scene_instance_set(&(scene_instance) { 0 }, world)) {
        const bool ok = add_primitives(r, node, world);
        builder_instances(r->builder, next);
        return ok;
    }
    size_t first = next;
    const bool own = gltf_deforms(node), known = !own && r->shared[mesh].there;
    if (!known && !add_primitives(r, node, same))
        return false;
    size_t count = builder_count(r->builder, BLOB_MESHES) - next;
    if (known) {
        first = r->shared[mesh].first;
        count = r->shared[mesh].count;
    } else if (!own) {
        r->shared[mesh].there = true;
        r->shared[mesh].first = first;
        r->shared[mesh].count = count;
    }
    for (size_t i = 0; i < count; i++)
        if (!builder_place(r->builder, first + i, world))
            return base_fail(r->error, r->document->subject, "does not fit into memory");
    return true;
}

/* Adds the mesh of a node under every transform of EXT_mesh_gpu_instancing. */
static bool add_instances(const mesh_reader *r, json_t *node, json_t *attributes,
                          const double world[16]) {
    static const struct {
        const char *name;
        int width;
    } parts[3] = { { "TRANSLATION", 3 }, { "ROTATION", 4 }, { "SCALE", 3 } };
    float *numbers[3] = { NULL, NULL, NULL };
    size_t count = 0;
    bool ok = true;
    for (int i = 0; i < 3 && ok; i++) {
        const long accessor = gltf_index(attributes, parts[i].name);
        count = accessor < 0 ? count : r->document->accessors[accessor].count;
        ok = read_attribute(r->document, attributes, parts[i].name, &numbers[i], r->error);
    }
    for (size_t k = 0; k < count && ok; k++) {
        gltf_transform transform = { .rotation = { 0, 0, 0, 1 }, .scale = { 1, 1, 1 } };
        double *const to[3] = { transform.translation, transform.rotation, transform.scale };
        double local[16], instance[16];
        for (int i = 0; i < 3; i++)
            for (int c = 0; numbers[i] && c < parts[i].width; c++)
                to[i][c] = (double)numbers[i][k * (size_t)parts[i].width + (size_t)c];
        gltf_transform_matrix(&transform, local);
        scene_multiply(world, local, instance);
        ok = add_mesh(r, node, instance);
    }
    for (int i = 0; i < 3; i++)
        free(numbers[i]);
    return ok;
}

/* Notes the attributes of a morph target that are unsupported. */
static void note_unmorphed(json_t *target, scene_builder *builder) {
    const char *name;
    json_t *item;
    json_object_foreach (target, name, item) {
        if (strncmp(name, "COLOR_", 6) == 0 || strncmp(name, "TEXCOORD_", 9) == 0)
            builder_unsupported(builder, name, "morph target", 1);
    }
}

static void note_undrawn(const gltf *document, scene_builder *builder) {
    for (size_t i = 0; i < gltf_count(document, GLTF_MESHES); i++) {
        json_t *primitives = gltf_primitives(document, i), *primitive;
        size_t number;
        json_array_foreach (primitives, number, primitive) {
            if (!is_drawn(primitive))
                builder_unsupported(builder, "points and lines", "primitive", 1);
            if (json_object_get(json_object_get(primitive, "attributes"), "COLOR_1"))
                builder_unsupported(builder, "COLOR_1", "primitive", 1);
            json_t *targets = json_object_get(primitive, "targets"), *target;
            size_t k;
            json_array_foreach (targets, k, target)
                note_unmorphed(target, builder);
        }
    }
}

/* Finds the nodes with a mesh below them. */
static void find_filled(const gltf *document) {
    for (size_t i = gltf_count(document, GLTF_NODES); i-- > 0;) {
        gltf_node *node = &document->nodes[document->order[i]];
        const json_t *entry = gltf_item(document, GLTF_NODES, document->order[i]);
        node->filled |= node->shown && json_object_get(entry, "mesh");
        if (node->filled && node->parent >= 0)
            document->nodes[node->parent].filled = true;
    }
}

static bool add_nodes(const mesh_reader *r) {
    const gltf *document = r->document;
    find_filled(document);
    for (size_t i = 0; i < gltf_count(document, GLTF_NODES); i++) {
        gltf_node *drawn = &document->nodes[document->order[i]];
        json_t *node = gltf_item(document, GLTF_NODES, document->order[i]);
        json_t *instances =
            json_object_get(gltf_extension(node, "EXT_mesh_gpu_instancing"), "attributes");
        sandbox_progress((double)i / (double)gltf_count(document, GLTF_NODES));
        if (!drawn->filled)
            continue;
        drawn->number =
            builder_node(r->builder, gltf_text(node, "name"),
                         drawn->parent < 0 ? SCENE_NO_NODE : document->nodes[drawn->parent].number);
        if (!json_object_get(node, "mesh"))
            continue;
        if (!(instances ? add_instances(r, node, instances, drawn->world)
                        : add_mesh(r, node, drawn->world)))
            return false;
    }
    builder_end_nodes(r->builder);
    return true;
}

bool gltf_add_meshes(const gltf *document, scene_builder *builder, base_error *error) {
    mesh_reader r = { .document = document, .builder = builder, .error = error };
    r.shared = calloc(gltf_count(document, GLTF_MESHES) + 1, sizeof *r.shared);
    if (!r.shared)
        return base_fail(error, document->subject, "does not fit into memory");
    note_undrawn(document, builder);
    const bool ok = add_nodes(&r);
    free(r.shared);
    return ok;
}
