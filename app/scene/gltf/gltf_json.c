/* SPDX-License-Identifier: MIT */
/* gltf_json.c - the container, its JSON, and members of objects. */
#include "app/base/file_json.h"
#include "app/scene/gltf/gltf.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* --- members ---------------------------------------------------------------------------------- */

json_t *gltf_extension(const json_t *object, const char *name) {
    return json_object_get(json_object_get(object, "extensions"), name);
}

double gltf_number(const json_t *object, const char *name, double fallback) {
    const json_t *item = json_object_get(object, name);
    return json_is_number(item) ? json_number_value(item) : fallback;
}

long gltf_index(const json_t *object, const char *name) {
    return (long)gltf_number(object, name, -1.0);
}

void gltf_numbers(const json_t *object, const char *name, size_t count, double *numbers) {
    const json_t *array = json_object_get(object, name);
    for (size_t i = 0; json_array_size(array) == count && i < count; i++)
        numbers[i] = json_number_value(json_array_get(array, i));
}

const char *gltf_text(const json_t *object, const char *name) {
    const char *text = json_string_value(json_object_get(object, name));
    return text ? text : "";
}

/* --- the container ---------------------------------------------------------------------------- */

static uint32_t little_endian(const unsigned char *bytes) {
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
           (uint32_t)bytes[3] << 24;
}

#define GLB_HEADER 12
#define GLB_CHUNK  8
#define GLB_JSON   0x4e4f534au
#define GLB_BIN    0x004e4942u

/* Finds the chunks of a GLB: first JSON, then perhaps BIN. Further chunks are for extensions. */
static bool split_glb(gltf *document, const unsigned char *data, size_t size, gltf_bytes *json,
                      base_error *error) {
    if (size < GLB_HEADER + GLB_CHUNK || little_endian(data + 4) != 2)
        return base_fail(error, document->subject, "is not a GLB file of version 2");
    const uint32_t length = little_endian(data + 8);
    if (length > size)
        return base_fail(error, document->subject, "is truncated: %zu of %u bytes are there", size,
                         length);
    builder_unsupported(document->builder, "bytes after its end", "file", length < size);
    size = length;
    int number = 0;
    for (size_t at = GLB_HEADER, next; at < size; at = next, number++) {
        const size_t left = size - at;
        const uint32_t chunk = left < GLB_CHUNK ? 0 : little_endian(data + at);
        const uint32_t type = left < GLB_CHUNK ? 0 : little_endian(data + at + 4);
        if (left < GLB_CHUNK || chunk > left - GLB_CHUNK)
            return base_fail(error, document->subject,
                             "is damaged: chunk %d has an impossible length", number);
        next = at + GLB_CHUNK + chunk;
        if ((type == GLB_JSON) != (number == 0) || (type == GLB_BIN && number != 1))
            return base_fail(error, document->subject,
                             "is damaged: its chunks are not JSON and then BIN");
        if (number < 2 && (type == GLB_JSON || type == GLB_BIN))
            *(type == GLB_JSON ? json : &document->binary) =
                (gltf_bytes) { .bytes = data + at + GLB_CHUNK, .size = chunk };
    }
    return true;
}

/* --- parsing ---------------------------------------------------------------------------------- */

/* Whether a file is named .glb but is neither a GLB nor glTF's JSON. */
static bool only_claims_glb(const gltf *document, const unsigned char *bytes, size_t size) {
    const size_t length = strlen(document->subject);
    size_t blanks = 0;
    while (blanks < size && bytes[blanks] <= 32 && bytes[blanks] > 0)
        blanks++;
    return length > 4 && strcasecmp(document->subject + length - 4, ".glb") == 0 &&
           (blanks == size || bytes[blanks] != '{');
}

bool gltf_parse(gltf *document, const void *data, size_t size, base_error *error) {
    static const char *const names[GLTF_KINDS] = {
        [GLTF_ACCESSORS] = "accessors", [GLTF_ANIMATIONS] = "animations",
        [GLTF_BUFFERS] = "buffers",     [GLTF_VIEWS] = "bufferViews",
        [GLTF_CAMERAS] = "cameras",     [GLTF_IMAGES] = "images",
        [GLTF_LIGHTS] = "lights",       [GLTF_MATERIALS] = "materials",
        [GLTF_MESHES] = "meshes",       [GLTF_NODES] = "nodes",
        [GLTF_SAMPLERS] = "samplers",   [GLTF_SCENES] = "scenes",
        [GLTF_SKINS] = "skins",         [GLTF_TEXTURES] = "textures",
    };
    gltf_bytes json = { .bytes = data, .size = size };
    if (size >= 4 && memcmp(data, "glTF", 4) == 0 && !split_glb(document, data, size, &json, error))
        return false;
    /* skip a byte-order mark at the start, and NULs where a chunk is padded with spaces */
    if (json.size >= 3 && memcmp(json.bytes, "\xef\xbb\xbf", 3) == 0) {
        json.bytes += 3;
        json.size -= 3;
    }
    while (json.size > 0 && json.bytes[json.size - 1] == 0)
        json.size--;
    if (json.bytes == (const unsigned char *)data && only_claims_glb(document, data, size))
        return base_fail(error, document->subject,
                         "is not a GLB file: its first bytes are not \"glTF\"");
    document->root = file_parse_json(document->subject, (const char *)json.bytes, json.size, error);
    if (!document->root)
        return false;
    for (int kind = 0; kind < GLTF_KINDS; kind++)
        document->lists[kind] = json_object_get(document->root, names[kind]);
    document->lists[GLTF_LIGHTS] =
        json_object_get(gltf_extension(document->root, "KHR_lights_punctual"), "lights");
    document->lists[GLTF_AREA_LIGHTS] =
        json_object_get(gltf_extension(document->root, "EXT_lights_area"), "lights");
    return true;
}

bool gltf_fail(const gltf *document, gltf_kind kind, size_t index, const char *wrong,
               base_error *error) {
    static const char *const nouns[GLTF_KINDS] = {
        [GLTF_ACCESSORS] = "accessor",
        [GLTF_ANIMATIONS] = "animation",
        [GLTF_BUFFERS] = "buffer",
        [GLTF_VIEWS] = "bufferView",
        [GLTF_CAMERAS] = "camera",
        [GLTF_IMAGES] = "image",
        [GLTF_AREA_LIGHTS] = "area light",
        [GLTF_LIGHTS] = "light",
        [GLTF_MATERIALS] = "material",
        [GLTF_MESHES] = "mesh",
        [GLTF_NODES] = "node",
        [GLTF_SAMPLERS] = "sampler",
        [GLTF_SCENES] = "scene",
        [GLTF_SKINS] = "skin",
        [GLTF_TEXTURES] = "texture",
    };
    return base_fail(error, document->subject, "is not valid glTF: %s %zu %s", nouns[kind], index,
                     wrong);
}
