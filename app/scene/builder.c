/* SPDX-License-Identifier: MIT */
#include "app/scene/builder.h"

#include <stdlib.h>
#include <string.h>

void builder_free(scene_builder *builder) {
    for (int i = 0; i < BLOB_SECTIONS; i++)
        free(builder->arrays[i].items);
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
        void *items = realloc(array->items, capacity * item);
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
    const scene_texture_use none = { .texture = -1, .matrix = { 1.0f, 0.0f, 0.0f, 1.0f } };
    *material = (scene_material) {
        .base_color = { 1.0f, 1.0f, 1.0f, 1.0f },
        .metallic = 0.0f,
        .roughness = 1.0f,
        .normal_scale = 1.0f,
        .alpha_cutoff = 0.5f,
        .base_color_map = none,
        .metallic_roughness_map = none,
        .normal_map = none,
        .emission_map = none,
    };
    builder_name(material->name, name);
    return material;
}

void builder_mesh(scene_builder *builder, const char *name, uint32_t material, size_t first_index) {
    const size_t end = builder_count(builder, BLOB_INDICES);
    if (end == first_index)
        return;
    scene_mesh *mesh = builder_append(builder, BLOB_MESHES, 1);
    if (!mesh)
        return;
    builder_name(mesh->name, name);
    mesh->material = material;
    mesh->first_index = (uint32_t)first_index;
    mesh->index_count = (uint32_t)(end - first_index);
    const uint32_t *indices = builder_items(builder, BLOB_INDICES);
    const scene_vertex *vertices = builder_items(builder, BLOB_VERTICES);
    for (size_t i = first_index; i < end; i++)
        for (int k = 0; k < 3; k++) {
            const float x = vertices[indices[i]].position[k];
            if (i == first_index || x < mesh->minimum[k])
                mesh->minimum[k] = x;
            if (i == first_index || x > mesh->maximum[k])
                mesh->maximum[k] = x;
        }
}

void builder_left_out(scene_builder *builder, const char *what, const char *noun, size_t count) {
    char name[SCENE_NAME_SIZE];
    builder_name(name, what ? what : "");
    scene_left_out *items = builder_items(builder, BLOB_LEFT_OUT), *found = NULL;
    const size_t known = builder_count(builder, BLOB_LEFT_OUT);
    for (size_t i = 0; i < known && !found; i++)
        if (strcmp(items[i].what, name) == 0 && strcmp(items[i].noun, noun) == 0)
            found = &items[i];
    if (!found && known < SCENE_LEFT_OUT_MAX) {
        found = builder_append(builder, BLOB_LEFT_OUT, 1);
        if (!found)
            return;
        memcpy(found->what, name, sizeof name);
        builder_name(found->noun, noun);
    }
    if (found)
        found->count += (uint32_t)count;
}

/* Bytes of the UTF-8 character at text, 0 if it is none (overlong forms and surrogates are none).
 */
static size_t utf8_length(const unsigned char *text) {
    const unsigned char c = text[0];
    const size_t length = c < 0x80                ? 1
                          : c >= 0xc2 && c < 0xe0 ? 2
                          : c >= 0xe0 && c < 0xf0 ? 3
                          : c >= 0xf0 && c < 0xf5 ? 4
                                                  : 0;
    for (size_t i = 1; i < length; i++)
        if ((text[i] & 0xc0) != 0x80)
            return 0;
    if ((c == 0xe0 && text[1] < 0xa0) || (c == 0xed && text[1] >= 0xa0) ||
        (c == 0xf0 && text[1] < 0x90) || (c == 0xf4 && text[1] >= 0x90))
        return 0;
    return length;
}

void builder_name(char name[SCENE_NAME_SIZE], const char *text) {
    size_t used = 0;
    memset(name, 0, SCENE_NAME_SIZE);
    for (const unsigned char *c = (const unsigned char *)text; *c;) {
        const size_t length = utf8_length(c);
        const bool plain = length > 0 && *c >= 0x20 && *c != 0x7f;
        const size_t bytes = plain ? length : 1;
        if (used + bytes >= SCENE_NAME_SIZE)
            return;
        if (plain)
            memcpy(name + used, c, bytes);
        else
            name[used] = '?';
        used += bytes;
        c += bytes;
    }
}

void builder_header(const scene_builder *builder, bool checksum, blob_header *header) {
    size_t counts[BLOB_SECTIONS];
    for (int i = 0; i < BLOB_SECTIONS; i++)
        counts[i] = builder->arrays[i].count;
    blob_layout(header, counts);
    for (int i = 0; checksum && i < BLOB_SECTIONS; i++)
        file_hash_add(&header->content, builder->arrays[i].items, counts[i] * blob_item_size[i]);
}

bool builder_pack(const scene_builder *builder, void **block, size_t *size) {
    blob_header header;
    builder_header(builder, false, &header);
    *block = NULL;
    if (builder->out_of_memory || !(*block = malloc(header.size)))
        return false;
    *size = header.size;
    memcpy(*block, &header, sizeof header);
    for (int i = 0; i < BLOB_SECTIONS; i++)
        if (builder->arrays[i].count)
            memcpy((char *)*block + header.sections[i].offset, builder->arrays[i].items,
                   builder->arrays[i].count * blob_item_size[i]);
    return true;
}
