/* SPDX-License-Identifier: MIT */
#include "app/scene/builder.h"

#include "app/base/file_hash.h"
#include "app/base/memory.h"
#include "app/scene/center.h"
#include "app/scene/instance.h"
#include "app/scene/name.h"
#include "app/scene/vector.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void builder_free(scene_builder *builder) {
    for (int i = 0; i < BLOB_SECTIONS; i++)
        free(builder->arrays[i].items);
    free(builder->centers);
    memset(builder, 0, sizeof *builder);
}

void *builder_append(scene_builder *builder, blob_section section, size_t count) {
    builder_array *array = &builder->arrays[section];
    const size_t item = blob_item_size[section];
    if (builder->out_of_memory || count > SIZE_MAX / 4 / item - array->count) {
        builder->out_of_memory = true;
        return NULL;
    }
    if (array->count + count > array->capacity) {
        size_t capacity = array->capacity ? array->capacity * 2 : 64;
        while (capacity < array->count + count)
            capacity *= 2;
        void *items = memory_large_resize(array->items, capacity * item);
        if (!items) {
            builder->out_of_memory = true;
            return NULL;
        }
        array->items = items;
        array->capacity = capacity;
    }
    void *first = (char *)array->items + array->count * item;
    memset(first, 0, count * item);
    array->count += count;
    return first;
}

size_t builder_count(const scene_builder *builder, blob_section section) {
    return builder->arrays[section].count;
}

void *builder_items(const scene_builder *builder, blob_section section) {
    return builder->arrays[section].items;
}

scene_material *builder_material(scene_builder *builder, const char *name) {
    scene_material *material = builder_append(builder, BLOB_MATERIALS, 1);
    if (!material)
        return NULL;
    *material = scene_material_plain();
    scene_clean_name(material->name, name);
    return material;
}

void builder_sphere_light(scene_builder *builder, lmp_vec3 center, float radius, lmp_rgb color,
                          float power) {
    scene_light *light = builder_append(builder, BLOB_LIGHTS, 1);
    if (!light)
        return;
    light->emitter = (lmp_light) {
        .position = center,
        .radius = radius,
        .radiance = rgb_scale(color, lmp_sphere_radiance_from_power(power, radius)),
    };
}

/* Moves the last mesh near 0 if it is far from it. */
static void center_mesh(scene_builder *builder, scene_mesh *mesh) {
    const size_t count = builder_count(builder, BLOB_MESHES);
    double(*centers)[3] = realloc(builder->centers, count * sizeof *centers);
    if (!centers) {
        builder->out_of_memory = true;
        return;
    }
    builder->centers = centers;
    double *center = memset(centers[count - 1], 0, sizeof *centers);
    if (!center_find(mesh->minimum, mesh->maximum, center))
        return;
    const uint32_t *indices = (uint32_t *)builder_items(builder, BLOB_INDICES) + mesh->first_index;
    scene_vertex *vertices = builder_items(builder, BLOB_VERTICES);
    uint32_t least = indices[0], most = indices[0];
    for (uint32_t i = 1; i < mesh->index_count; i++) {
        least = indices[i] < least ? indices[i] : least;
        most = indices[i] > most ? indices[i] : most;
    }
    for (uint32_t i = least; i <= most; i++)
        for (int k = 0; k < 3; k++)
            vertices[i].position[k] = (float)((double)vertices[i].position[k] - center[k]);
    blob_bounds(vertices, indices, mesh->index_count, mesh->minimum, mesh->maximum);
}

void builder_mesh(scene_builder *builder, const char *name, uint32_t material, size_t first_index) {
    const size_t end = builder_count(builder, BLOB_INDICES);
    if (end == first_index)
        return;
    scene_mesh *mesh = builder_append(builder, BLOB_MESHES, 1);
    if (!mesh)
        return;
    scene_clean_name(mesh->name, name);
    mesh->material = material;
    mesh->first_index = (uint32_t)first_index;
    mesh->index_count = (uint32_t)(end - first_index);
    const uint32_t *indices = builder_items(builder, BLOB_INDICES);
    blob_bounds(builder_items(builder, BLOB_VERTICES), indices + first_index, end - first_index,
                mesh->minimum, mesh->maximum);
    if (builder->centers_meshes)
        center_mesh(builder, mesh);
}

/* Appends a node for the instances to come. */
static uint32_t append_node(scene_builder *builder, uint32_t name, uint32_t parent) {
    const uint32_t number = (uint32_t)builder_count(builder, BLOB_NODES);
    scene_node *node = builder_append(builder, BLOB_NODES, 1);
    if (node)
        *node = (scene_node) { .name = name,
                               .parent = parent,
                               .end = number + 1,
                               .first = (uint32_t)builder_count(builder, BLOB_INSTANCES) };
    return number;
}

uint32_t builder_node(scene_builder *builder, const char *name, uint32_t parent) {
    char clean[SCENE_NAME_SIZE];
    scene_clean_name(clean, name);
    const size_t size = clean[0] ? strlen(clean) + 1 : 0;
    const uint32_t at = (uint32_t)builder_count(builder, BLOB_NAMES);
    char *to = size > 0 ? builder_append(builder, BLOB_NAMES, size) : NULL;
    if (to)
        memcpy(to, clean, size);
    builder->has_tree = true;
    return append_node(builder, size ? at : SCENE_NO_NODE, parent);
}

void builder_end_nodes(scene_builder *builder) {
    scene_node *nodes = builder_items(builder, BLOB_NODES);
    for (size_t i = builder_count(builder, BLOB_NODES); i-- > 0;)
        if (nodes[i].parent != SCENE_NO_NODE && nodes[nodes[i].parent].end < nodes[i].end)
            nodes[nodes[i].parent].end = nodes[i].end;
}

bool builder_place(scene_builder *builder, size_t mesh, const double matrix[16]) {
    if (!builder->has_tree)
        append_node(builder, SCENE_NO_NODE, SCENE_NO_NODE);
    scene_instance *instance = builder_append(builder, BLOB_INSTANCES, 1);
    double moved[16];
    if (!instance)
        return false;
    memcpy(moved, matrix, sizeof moved);
    for (int k = 0; k < 3 && builder->centers; k++)
        for (int i = 0; i < 3; i++)
            moved[12 + k] += matrix[4 * i + k] * builder->centers[mesh][i];
    scene_instance_set(instance, moved);
    instance->mesh = (uint32_t)mesh;
    return true;
}

void builder_instances(scene_builder *builder, size_t first_mesh) {
    static const double same[16] = { [0] = 1, [5] = 1, [10] = 1, [15] = 1 };
    for (size_t i = first_mesh; i < builder_count(builder, BLOB_MESHES); i++)
        builder_place(builder, i, same);
}

void builder_geometry(const scene_builder *builder, scene *s) {
    memset(s, 0, sizeof *s);
    s->vertices = builder_items(builder, BLOB_VERTICES);
    s->indices = builder_items(builder, BLOB_INDICES);
    s->meshes = builder_items(builder, BLOB_MESHES);
    s->instances = builder_items(builder, BLOB_INSTANCES);
    s->vertex_count = builder_count(builder, BLOB_VERTICES);
    s->index_count = builder_count(builder, BLOB_INDICES);
    s->mesh_count = builder_count(builder, BLOB_MESHES);
    s->instance_count = builder_count(builder, BLOB_INSTANCES);
    memcpy(s->origin, builder->origin, sizeof s->origin);
}

void builder_unsupported(scene_builder *builder, const char *what, const char *noun, size_t count) {
    char name[SCENE_NAME_SIZE];
    if (count == 0)
        return;
    scene_clean_name(name, what ? what : "");
    scene_unsupported *items = builder_items(builder, BLOB_UNSUPPORTED), *found = NULL;
    const size_t known = builder_count(builder, BLOB_UNSUPPORTED);
    for (size_t i = 0; i < known && !found; i++)
        if (strcmp(items[i].what, name) == 0 && strcmp(items[i].noun, noun) == 0)
            found = &items[i];
    if (!found && known < SCENE_UNSUPPORTED_MAX) {
        found = builder_append(builder, BLOB_UNSUPPORTED, 1);
        if (!found)
            return;
        memcpy(found->what, name, sizeof name);
        scene_clean_name(found->noun, noun);
    }
    if (found)
        found->count += (uint32_t)count;
}

void builder_unsupported_file(scene_builder *builder, const char *path, const char *noun) {
    static const char gap[] = "...";
    char name[SCENE_NAME_SIZE];
    const size_t length = strlen(path), room = sizeof name - sizeof gap;
    const char *tail = length < sizeof name ? path : path + length - room;
    while (tail > path && (*tail & 0xc0) == 0x80) /* not inside a character */
        tail++;
    snprintf(name, sizeof name, "%s%s", tail > path ? gap : "", tail);
    builder_unsupported(builder, name, noun, 1);
}

void builder_header(const scene_builder *builder, bool checksum, blob_header *header) {
    size_t counts[BLOB_SECTIONS];
    for (int i = 0; i < BLOB_SECTIONS; i++)
        counts[i] = builder->arrays[i].count;
    blob_layout(header, counts);
    memcpy(header->origin, builder->origin, sizeof header->origin);
    header->up = (uint32_t)builder->up;
    for (int i = 0; checksum && i < BLOB_SECTIONS; i++)
        file_hash_add(&header->content, builder->arrays[i].items, counts[i] * blob_item_size[i]);
}

bool builder_pack(const scene_builder *builder, void **block, size_t *size) {
    blob_header header;
    builder_header(builder, false, &header);
    *block = NULL;
    if (builder->out_of_memory || !(*block = memory_large(header.size)))
        return false;
    *size = header.size;
    memcpy(*block, &header, sizeof header);
    for (int i = 0; i < BLOB_SECTIONS; i++)
        if (builder->arrays[i].count)
            memcpy((char *)*block + header.sections[i].offset, builder->arrays[i].items,
                   builder->arrays[i].count * blob_item_size[i]);
    return true;
}
