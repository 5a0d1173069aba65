/* SPDX-License-Identifier: MIT */
/* gltf_json.c - the container, its JSON, and members of objects. */
#include "app/scene/gltf.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* --- members ---------------------------------------------------------------------------------- */

const cJSON *gltf_member(const cJSON *object, const char *name) {
    return cJSON_IsObject(object) ? cJSON_GetObjectItemCaseSensitive(object, name) : NULL;
}

const cJSON *gltf_extension(const cJSON *object, const char *name) {
    return gltf_member(gltf_member(object, "extensions"), name);
}

double gltf_number(const cJSON *object, const char *name, double fallback) {
    const cJSON *item = gltf_member(object, name);
    return cJSON_IsNumber(item) ? item->valuedouble : fallback;
}

long gltf_index(const cJSON *object, const char *name) {
    const cJSON *item = gltf_member(object, name);
    return cJSON_IsNumber(item) ? (long)item->valuedouble : -1;
}

void gltf_numbers(const cJSON *object, const char *name, size_t count, double *numbers) {
    const cJSON *array = gltf_member(object, name), *item;
    if (cJSON_GetArraySize(array) != (int)count)
        return;
    cJSON_ArrayForEach(item, array) *numbers++ = item->valuedouble;
}

const char *gltf_text(const cJSON *object, const char *name) {
    const cJSON *item = gltf_member(object, name);
    return cJSON_IsString(item) && item->valuestring ? item->valuestring : "";
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

/* Finds the JSON and the BIN chunk of a GLB: the first and perhaps the second. Further chunks are
 * for extensions. */
static bool split_glb(gltf *document, const unsigned char *data, size_t size, gltf_bytes *json,
                      cli_error *error) {
    if (size < GLB_HEADER + GLB_CHUNK || little_endian(data + 4) != 2)
        return cli_fail(error, document->subject, "is not a GLB file of version 2");
    const uint32_t length = little_endian(data + 8);
    if (length > size)
        return cli_fail(error, document->subject, "is truncated: %zu of %u bytes are there", size,
                        length);
    builder_left_out(document->builder, "bytes after its end", "file", length < size);
    size = length;
    int number = 0;
    for (size_t at = GLB_HEADER, next; at < size; at = next, number++) {
        const size_t left = size - at;
        const uint32_t chunk = left < GLB_CHUNK ? 0 : little_endian(data + at);
        const uint32_t type = left < GLB_CHUNK ? 0 : little_endian(data + at + 4);
        if (left < GLB_CHUNK || chunk > left - GLB_CHUNK)
            return cli_fail(error, document->subject,
                            "is damaged: chunk %d has an impossible length", number);
        next = at + GLB_CHUNK + chunk;
        if ((type == GLB_JSON) != (number == 0) || (type == GLB_BIN && number != 1))
            return cli_fail(error, document->subject,
                            "is damaged: its chunks are not JSON and then BIN");
        if (number < 2 && (type == GLB_JSON || type == GLB_BIN))
            *(type == GLB_JSON ? json : &document->binary) =
                (gltf_bytes) { .bytes = data + at + GLB_CHUNK, .size = chunk };
    }
    return true;
}

/* --- names ------------------------------------------------------------------------------------ */

static int compare_names(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* A name that some object has twice, of which a reader would see one only; NULL if there is none,
 * or no memory (*out_of_memory). */
static const char *repeated_name(const cJSON *value, bool *out_of_memory) {
    const cJSON *item;
    size_t count = 0;
    cJSON_ArrayForEach(item, value) {
        const char *name = repeated_name(item, out_of_memory);
        if (name || *out_of_memory)
            return name;
        count++;
    }
    if (!cJSON_IsObject(value) || count < 2)
        return NULL;
    const char **names = malloc(count * sizeof *names), *found = NULL;
    *out_of_memory = !names;
    if (!names)
        return NULL;
    count = 0;
    cJSON_ArrayForEach(item, value) names[count++] = item->string;
    qsort(names, count, sizeof *names, compare_names);
    for (size_t i = 1; i < count && !found; i++)
        if (strcmp(names[i - 1], names[i]) == 0)
            found = names[i];
    free(names);
    return found;
}

/* --- parsing ---------------------------------------------------------------------------------- */

static bool make_list(const cJSON *holder, const char *name, gltf_list *list) {
    const cJSON *array = gltf_member(holder, name), *item;
    list->items = calloc((size_t)cJSON_GetArraySize(array) + 1, sizeof(void *));
    if (!list->items)
        return false;
    if (cJSON_IsArray(array))
        cJSON_ArrayForEach(item, array) list->items[list->count++] = item;
    return true;
}

/* Whether a file is called a GLB and holds neither that nor glTF's JSON. */
static bool only_claims_glb(const gltf *document, const unsigned char *bytes, size_t size) {
    const size_t length = strlen(document->subject);
    size_t blanks = 0;
    while (blanks < size && bytes[blanks] <= 32 && bytes[blanks] > 0)
        blanks++;
    return length > 4 && strcasecmp(document->subject + length - 4, ".glb") == 0 &&
           (blanks == size || bytes[blanks] != '{');
}

bool gltf_parse(gltf *document, const void *data, size_t size, cli_error *error) {
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
    /* A byte-order mark at the start, and NULs where a chunk's spaces belong, say nothing. */
    if (json.size >= 3 && memcmp(json.bytes, "\xef\xbb\xbf", 3) == 0) {
        json.bytes += 3;
        json.size -= 3;
    }
    while (json.size > 0 && json.bytes[json.size - 1] == 0)
        json.size--;
    if (json.bytes == (const unsigned char *)data && only_claims_glb(document, data, size))
        return cli_fail(error, document->subject,
                        "is not a GLB file: its first bytes are not \"glTF\"");
    document->root = file_parse_json(document->subject, (const char *)json.bytes, json.size, error);
    if (!document->root)
        return false;
    bool out_of_memory = false;
    const char *repeated = repeated_name(document->root, &out_of_memory);
    if (repeated)
        return cli_fail(error, document->subject,
                        "is not valid glTF: \"%.100s\" is there twice in one object", repeated);
    const cJSON *punctual = gltf_extension(document->root, "KHR_lights_punctual");
    for (int kind = 0; kind < GLTF_KINDS && !out_of_memory; kind++)
        out_of_memory = !make_list(kind == GLTF_LIGHTS ? punctual : document->root, names[kind],
                                   &document->lists[kind]);
    return !out_of_memory || cli_fail(error, document->subject, "does not fit into memory");
}

bool gltf_fail(const gltf *document, gltf_kind kind, size_t index, const char *wrong,
               cli_error *error) {
    static const char *const nouns[GLTF_KINDS] = {
        [GLTF_ACCESSORS] = "accessor", [GLTF_ANIMATIONS] = "animation", [GLTF_BUFFERS] = "buffer",
        [GLTF_VIEWS] = "bufferView",   [GLTF_CAMERAS] = "camera",       [GLTF_IMAGES] = "image",
        [GLTF_LIGHTS] = "light",       [GLTF_MATERIALS] = "material",   [GLTF_MESHES] = "mesh",
        [GLTF_NODES] = "node",         [GLTF_SAMPLERS] = "sampler",     [GLTF_SCENES] = "scene",
        [GLTF_SKINS] = "skin",         [GLTF_TEXTURES] = "texture",
    };
    return cli_fail(error, document->subject, "is not valid glTF: %s %zu %s", nouns[kind], index,
                    wrong);
}
