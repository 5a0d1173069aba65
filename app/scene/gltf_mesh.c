/* SPDX-License-Identifier: MIT */
/* gltf_mesh.c - the meshes of the scene's nodes, and where they stand. */
#include "app/sandbox/sandbox.h"
#include "app/scene/gltf_deform.h"
#include "app/scene/instance.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MODE_TRIANGLES = 4, MODE_STRIP = 5, MODE_FAN = 6 };

/* --- a primitive's numbers -------------------------------------------------------------------- */

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

/* Reads `width` floats of an attribute, if it is there, into every vertex at `offset` bytes. */
static bool fill_attribute(const gltf *document, const cJSON *attributes, const char *name,
                           int width, size_t offset, mesh_draft *draft, cli_error *error) {
    float *numbers;
    const bool ok = read_attribute(document, attributes, name, &numbers, error);
    if (ok)
        fill(draft, numbers, width, offset);
    free(numbers);
    return ok;
}

static bool read_coordinates(const gltf *document, const cJSON *primitive, mesh_draft *draft,
                             cli_error *error) {
    const cJSON *attributes = gltf_member(primitive, "attributes");
    const long material = gltf_primitive_material(document, primitive);
    long sets[2] = { -1, -1 };
    if (material >= 0)
        gltf_material_sets(gltf_item(document, GLTF_MATERIALS, (size_t)material), sets);
    for (size_t k = 0; k < 2 && sets[k] >= 0; k++) {
        char name[32];
        snprintf(name, sizeof name, "TEXCOORD_%ld", sets[k]);
        if (!gltf_member(attributes, name))
            builder_left_out(document->builder, "missing texture coordinates", "primitive", 1);
        if (!fill_attribute(document, attributes, name, 2,
                            offsetof(scene_vertex, uv) + k * sizeof draft->vertices->uv[0], draft,
                            error))
            return false;
    }
    /* Without textures, coordinates still turn a material that has a direction. */
    return sets[0] >= 0 || fill_attribute(document, attributes, "TEXCOORD_0", 2,
                                          offsetof(scene_vertex, uv), draft, error);
}

static uint16_t as_color(float x) {
    return (uint16_t)(65535.0f * fminf(fmaxf(x, 0.0f), 1.0f) + 0.5f);
}

static bool read_colors(const gltf *document, const cJSON *attributes, mesh_draft *draft,
                        cli_error *error) {
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

static bool read_vertices(const gltf *document, const cJSON *primitive, mesh_draft *draft,
                          cli_error *error) {
    const cJSON *attributes = gltf_member(primitive, "attributes");
    draft->vertex_count = document->accessors[gltf_index(attributes, "POSITION")].count;
    draft->has_normals = gltf_member(attributes, "NORMAL") != NULL;
    draft->vertices = calloc(draft->vertex_count, sizeof *draft->vertices);
    if (!draft->vertices)
        return cli_fail(error, document->subject, "does not fit into memory");
    return fill_attribute(document, attributes, "POSITION", 3, offsetof(scene_vertex, position),
                          draft, error) &&
           fill_attribute(document, attributes, "NORMAL", 3, offsetof(scene_vertex, normal), draft,
                          error) &&
           /* Tangents belong to the normals that they come with. */
           (!draft->has_normals || fill_attribute(document, attributes, "TANGENT", 4,
                                                  offsetof(scene_vertex, tangent), draft, error)) &&
           read_coordinates(document, primitive, draft, error) &&
           read_colors(document, attributes, draft, error);
}

/* The vertices of triangle `i` of a strip or fan: every second of a strip is rotated over. */
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

/* --- nodes ------------------------------------------------------------------------------------ */

static bool is_drawn(const cJSON *primitive) {
    return gltf_number(primitive, "mode", MODE_TRIANGLES) >= MODE_TRIANGLES &&
           gltf_member(gltf_member(primitive, "attributes"), "POSITION");
}

/* What the nodes share. */
typedef struct mesh_reader {
    const gltf *document;
    scene_builder *builder;
    struct {
        bool there;
        size_t first, count; /* of the scene's meshes */
    } * shared;              /* of each mesh of the document */
    cli_error *error;
} mesh_reader;

static bool add_primitive(const mesh_reader *r, const cJSON *node, const cJSON *primitive,
                          const char *name, const double world[16]) {
    const cJSON *attributes = gltf_member(primitive, "attributes");
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

static bool add_primitives(const mesh_reader *r, const cJSON *node, const double world[16]) {
    const size_t mesh = (size_t)gltf_index(node, "mesh");
    const cJSON *entry = gltf_item(r->document, GLTF_MESHES, mesh);
    const cJSON *primitives = gltf_member(entry, "primitives"), *primitive;
    const bool several = cJSON_GetArraySize(primitives) > 1;
    char own[SCENE_NAME_SIZE], name[2 * SCENE_NAME_SIZE];
    snprintf(own, sizeof own, "mesh %zu", mesh);
    if (gltf_text(entry, "name")[0])
        scene_clean_name(own, gltf_text(entry, "name"));
    int number = 0;
    cJSON_ArrayForEach(primitive, primitives) {
        snprintf(name, sizeof name, several ? "%s-%d" : "%s", own, number++);
        if (is_drawn(primitive) && !add_primitive(r, node, primitive, name, world))
            return false;
    }
    return true;
}

/* --- instances -------------------------------------------------------------------------------- */

/* The mesh of a node, where a matrix takes it. What the node deforms, or what the matrix does is
 * too much for an instance, has meshes of its own. */
static bool add_mesh(const mesh_reader *r, const cJSON *node, const double world[16]) {
    static const double same[16] = { [0] = 1, [5] = 1, [10] = 1, [15] = 1 };
    const size_t mesh = (size_t)gltf_index(node, "mesh");
    const size_t next = builder_count(r->builder, BLOB_MESHES);
    if (gltf_member(node, "skin") || !scene_instance_set(&(scene_instance) { 0 }, world)) {
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
            return cli_fail(r->error, r->document->subject, "does not fit into memory");
    return true;
}

/* The mesh of a node by every transform that EXT_mesh_gpu_instancing gives it. */
static bool add_instances(const mesh_reader *r, const cJSON *node, const cJSON *attributes,
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

static void note_undrawn(const gltf *document, scene_builder *builder) {
    for (size_t i = 0; i < gltf_count(document, GLTF_MESHES); i++) {
        const cJSON *mesh = gltf_item(document, GLTF_MESHES, i), *primitive;
        cJSON_ArrayForEach(primitive, gltf_member(mesh, "primitives")) {
            const cJSON *target, *item;
            if (!is_drawn(primitive))
                builder_left_out(builder, "points and lines", "primitive", 1);
            if (gltf_member(gltf_member(primitive, "attributes"), "COLOR_1"))
                builder_left_out(builder, "COLOR_1", "primitive", 1);
            cJSON_ArrayForEach(target, gltf_member(primitive, "targets"))
                cJSON_ArrayForEach(item, target) {
                if (strncmp(item->string, "COLOR_", 6) == 0 ||
                    strncmp(item->string, "TEXCOORD_", 9) == 0)
                    builder_left_out(builder, item->string, "morph target", 1);
            }
        }
    }
}

static bool add_nodes(const mesh_reader *r) {
    const gltf *document = r->document;
    for (size_t i = 0; i < gltf_count(document, GLTF_NODES); i++) {
        const gltf_node *drawn = &document->nodes[document->order[i]];
        const cJSON *node = gltf_item(document, GLTF_NODES, document->order[i]);
        const cJSON *instances =
            gltf_member(gltf_extension(node, "EXT_mesh_gpu_instancing"), "attributes");
        sandbox_progress((double)i / (double)gltf_count(document, GLTF_NODES));
        if (!drawn->shown || !gltf_member(node, "mesh"))
            continue;
        if (!(instances ? add_instances(r, node, instances, drawn->world)
                        : add_mesh(r, node, drawn->world)))
            return false;
    }
    return true;
}

bool gltf_add_meshes(const gltf *document, scene_builder *builder, cli_error *error) {
    mesh_reader r = { .document = document, .builder = builder, .error = error };
    r.shared = calloc(gltf_count(document, GLTF_MESHES) + 1, sizeof *r.shared);
    if (!r.shared)
        return cli_fail(error, document->subject, "does not fit into memory");
    note_undrawn(document, builder);
    const bool ok = add_nodes(&r);
    free(r.shared);
    return ok;
}
