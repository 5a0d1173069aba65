/* SPDX-License-Identifier: MIT */
#include "app/scene/gltf.h"

#include "app/scene/sandbox.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NODE_DEPTH_MAX 512
/* of accessors without a buffer view: they are all zeros */
#define UNBACKED_BYTES_MAX (64u << 20)

/* --- reading JSON -------------------------------------------------------------------------------
 */

const cJSON *gltf_member(const cJSON *object, const char *name) {
    return cJSON_IsObject(object) ? cJSON_GetObjectItemCaseSensitive(object, name) : NULL;
}

double gltf_number(const cJSON *object, const char *name, double fallback) {
    const cJSON *item = gltf_member(object, name);
    return cJSON_IsNumber(item) ? item->valuedouble : fallback;
}

long gltf_index(const cJSON *object, const char *name, size_t count, bool *ok) {
    const cJSON *item = gltf_member(object, name);
    if (!item)
        return -1;
    const double value = cJSON_IsNumber(item) ? item->valuedouble : -1.0;
    if (!(value >= 0.0 && value < (double)count) || value != floor(value)) {
        *ok = false;
        return -1;
    }
    return (long)value;
}

void gltf_numbers(const cJSON *object, const char *name, size_t count, double *numbers) {
    const cJSON *array = gltf_member(object, name);
    size_t found = 0;
    const cJSON *item;
    cJSON_ArrayForEach(item, array) found += cJSON_IsNumber(item) ? 1 : count + 1;
    if (!cJSON_IsArray(array) || found != count)
        return;
    cJSON_ArrayForEach(item, array) *numbers++ = item->valuedouble;
}

const char *gltf_text(const cJSON *object, const char *name) {
    const cJSON *item = gltf_member(object, name);
    return cJSON_IsString(item) && item->valuestring ? item->valuestring : "";
}

static bool make_list(const cJSON *object, const char *name, gltf_list *list) {
    const cJSON *array = gltf_member(object, name), *item;
    size_t count = 0;
    if (!cJSON_IsArray(array))
        return true;
    cJSON_ArrayForEach(item, array) count++;
    list->items = calloc(count + 1, sizeof(void *));
    if (!list->items)
        return false;
    cJSON_ArrayForEach(item, array) list->items[list->count++] = item;
    return true;
}

/* --- the containers -----------------------------------------------------------------------------
 */

static uint32_t little_endian(const unsigned char *bytes) {
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
           (uint32_t)bytes[3] << 24;
}

/* Splits a GLB into its JSON and BIN chunks. */
static bool split_glb(gltf *document, const unsigned char *data, size_t size,
                      const unsigned char **json, size_t *json_size, cli_error *error) {
    if (size < 20 || little_endian(data + 4) != 2)
        return cli_fail(error, document->subject, "is no GLB file of version 2");
    if (little_endian(data + 8) > size)
        return cli_fail(error, document->subject, "is truncated: %zu of %u bytes are there", size,
                        little_endian(data + 8));
    *json_size = little_endian(data + 12);
    if (little_endian(data + 16) != 0x4e4f534a || *json_size > size - 20)
        return cli_fail(error, document->subject, "is damaged: its JSON chunk is not there");
    *json = data + 20;
    const size_t next = 20 + *json_size;
    if (size - next < 8)
        return true;
    document->binary_size = little_endian(data + next);
    if (little_endian(data + next + 4) != 0x004e4942 || document->binary_size > size - next - 8)
        return cli_fail(error, document->subject, "is damaged: its BIN chunk is not there");
    document->binary = data + next + 8;
    return true;
}

/* --- checks: buffers ----------------------------------------------------------------------------
 */

static bool fail_entry(const gltf *document, const char *what, size_t index, const char *wrong,
                       cli_error *error) {
    return cli_fail(error, document->subject, "is no valid glTF: %s %zu %s", what, index, wrong);
}

static bool check_version(const gltf *document, cli_error *error) {
    static const char *const known[] = { "KHR_texture_transform",
                                         "KHR_materials_emissive_strength",
                                         "KHR_lights_punctual",
                                         "KHR_materials_unlit",
                                         "KHR_materials_sheen",
                                         "KHR_materials_clearcoat",
                                         "KHR_materials_ior",
                                         "KHR_materials_specular",
                                         "KHR_materials_transmission",
                                         "KHR_materials_volume",
                                         NULL };
    const char *version = gltf_text(gltf_member(document->root, "asset"), "version");
    if (strncmp(version, "2.", 2) != 0)
        return cli_fail(error, document->subject,
                        version[0] ? "is glTF %.16s (version 2.0 is read)"
                                   : "is no glTF file: it has no asset.version%.0s",
                        version);
    const cJSON *item;
    cJSON_ArrayForEach(item, gltf_member(document->root, "extensionsRequired")) {
        const char *name = cJSON_IsString(item) ? item->valuestring : "";
        size_t i = 0;
        while (known[i] && strcmp(known[i], name) != 0)
            i++;
        if (!known[i])
            return cli_fail(error, document->subject,
                            "requires the extension %.100s, which is not supported (export it "
                            "without)",
                            name);
    }
    return true;
}

/* Base64 bytes of a data URI; NULL if it is none. */
static const char *data_uri_text(const char *uri) {
    const char *comma = strncmp(uri, "data:", 5) == 0 ? strchr(uri, ',') : NULL;
    return comma && comma - uri >= 7 && strncmp(comma - 7, ";base64", 7) == 0 ? comma + 1 : NULL;
}

static size_t base64_size(const char *text) {
    size_t length = strlen(text);
    while (length && text[length - 1] == '=')
        length--;
    return length / 4 * 3 + (length % 4 ? length % 4 - 1 : 0);
}

static uint64_t input_bytes(const gltf *document) {
    uint64_t total = 0;
    const gltf_list *lists[] = { &document->buffers, &document->images };
    for (size_t k = 0; k < 2; k++)
        for (size_t i = 0; i < lists[k]->count; i++) {
            const char *uri = gltf_text(lists[k]->items[i], "uri");
            if (uri[0] && strncmp(uri, "data:", 5) != 0)
                total += sources_size(document->sources, uri);
        }
    return total;
}

static bool check_buffers(gltf *document, cli_error *error) {
    for (size_t i = 0; i < document->buffers.count; i++) {
        const cJSON *buffer = document->buffers.items[i];
        const double length = gltf_number(buffer, "byteLength", -1.0);
        const char *uri = gltf_text(buffer, "uri");
        size_t there;
        if (!(length >= 1.0))
            return fail_entry(document, "buffer", i, "has no byteLength", error);
        if (data_uri_text(uri)) {
            there = base64_size(data_uri_text(uri));
        } else if (uri[0]) {
            const source *found;
            if (!sources_read(document->sources, uri, &found, error))
                return false;
            there = found->size;
        } else if (i == 0 && document->binary) {
            there = document->binary_size;
        } else {
            return fail_entry(document, "buffer", i, "has no data", error);
        }
        if ((double)there < length)
            return fail_entry(document, "buffer", i, "is longer than its data (truncated?)", error);
    }
    return true;
}

static bool check_views(const gltf *document, cli_error *error) {
    for (size_t i = 0; i < document->views.count; i++) {
        const cJSON *view = document->views.items[i];
        bool ok = true;
        const long buffer = gltf_index(view, "buffer", document->buffers.count, &ok);
        const double offset = gltf_number(view, "byteOffset", 0.0);
        const double length = gltf_number(view, "byteLength", -1.0);
        const double stride = gltf_number(view, "byteStride", 4.0);
        if (buffer < 0 || !(offset >= 0.0) || !(length >= 1.0) ||
            !(stride >= 4.0 && stride <= 252.0) ||
            !(offset + length <= gltf_number(document->buffers.items[buffer], "byteLength", 0.0)))
            return fail_entry(document, "bufferView", i, "reaches outside its buffer", error);
    }
    return true;
}

static int component_size(const cJSON *accessor, const char *name) {
    switch ((int)gltf_number(accessor, name, 0.0)) {
    case 5120:
    case 5121:
        return 1;
    case 5122:
    case 5123:
        return 2;
    case 5125:
    case 5126:
        return 4;
    default:
        return 0;
    }
}

static int component_count(const cJSON *accessor) {
    static const struct {
        const char *name;
        int count;
    } types[] = { { "SCALAR", 1 }, { "VEC2", 2 }, { "VEC3", 3 }, { "VEC4", 4 },
                  { "MAT2", 4 },   { "MAT3", 9 }, { "MAT4", 16 } };
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (strcmp(gltf_text(accessor, "type"), types[i].name) == 0)
            return types[i].count;
    return 0;
}

/* Whether `count` elements of `size` bytes lie in the view that `holder` names. */
static bool view_holds(const gltf *document, const cJSON *holder, double count, double size) {
    bool ok = true;
    const long view = gltf_index(holder, "bufferView", document->views.count, &ok);
    const double offset = gltf_number(holder, "byteOffset", 0.0);
    if (view < 0)
        return false;
    const double stride = gltf_number(document->views.items[view], "byteStride", size);
    return offset >= 0.0 && offset + (count - 1.0) * stride + size <=
                                gltf_number(document->views.items[view], "byteLength", 0.0);
}

static bool check_accessors(const gltf *document, cli_error *error) {
    double unbacked = 0.0;
    for (size_t i = 0; i < document->accessors.count; i++) {
        const cJSON *accessor = document->accessors.items[i];
        const cJSON *sparse = gltf_member(accessor, "sparse");
        const double count = gltf_number(accessor, "count", 0.0);
        const double size =
            (double)component_size(accessor, "componentType") * component_count(accessor);
        if (size == 0.0 || !(count >= 1.0 && count < 4e9))
            return fail_entry(document, "accessor", i, "has no valid type or count", error);
        if (!gltf_member(accessor, "bufferView"))
            unbacked += count * size;
        else if (!view_holds(document, accessor, count, size))
            return fail_entry(document, "accessor", i, "reaches outside its bufferView", error);
        if (unbacked > (double)UNBACKED_BYTES_MAX)
            return fail_entry(document, "accessor", i, "has a count without data", error);
        if (!sparse)
            continue;
        const cJSON *indices = gltf_member(sparse, "indices"),
                    *values = gltf_member(sparse, "values");
        const double changed = gltf_number(sparse, "count", 0.0);
        if (!(changed >= 1.0 && changed <= count) ||
            !view_holds(document, indices, changed, component_size(indices, "componentType")) ||
            component_size(indices, "componentType") == 0 ||
            !view_holds(document, values, changed, size))
            return fail_entry(document, "accessor", i, "has invalid sparse data", error);
    }
    return true;
}

/* --- checks: meshes and nodes -------------------------------------------------------------------
 */

static bool check_primitive(const gltf *document, const cJSON *primitive) {
    bool ok = true;
    const size_t accessors = document->accessors.count;
    const cJSON *attributes = gltf_member(primitive, "attributes"), *item;
    gltf_index(primitive, "material", document->materials.count, &ok);
    const long indices = gltf_index(primitive, "indices", accessors, &ok);
    const long position = gltf_index(attributes, "POSITION", accessors, &ok);
    if (!ok || position < 0)
        return false;
    const double count = gltf_number(document->accessors.items[position], "count", 0.0);
    if (component_count(document->accessors.items[position]) != 3)
        return false;
    if (indices >= 0 && component_count(document->accessors.items[indices]) != 1)
        return false;
    cJSON_ArrayForEach(item, attributes) {
        const long index = gltf_index(attributes, item->string, accessors, &ok);
        if (!ok || index < 0 ||
            gltf_number(document->accessors.items[index], "count", 0.0) != count)
            return false;
    }
    return true;
}

static bool check_meshes(const gltf *document, cli_error *error) {
    for (size_t i = 0; i < document->meshes.count; i++) {
        const cJSON *primitive;
        cJSON_ArrayForEach(primitive, gltf_member(document->meshes.items[i], "primitives")) {
            if (!check_primitive(document, primitive))
                return fail_entry(document, "mesh", i, "has attributes that do not fit together",
                                  error);
        }
    }
    return true;
}

void gltf_transform_read(const cJSON *node, gltf_transform *t) {
    *t = (gltf_transform) { .rotation = { 0, 0, 0, 1 }, .scale = { 1, 1, 1 } };
    gltf_numbers(node, "translation", 3, t->translation);
    gltf_numbers(node, "rotation", 4, t->rotation);
    gltf_numbers(node, "scale", 3, t->scale);
}

void gltf_transform_matrix(const gltf_transform *t, double m[16]) {
    const double x = t->rotation[0], y = t->rotation[1], z = t->rotation[2], w = t->rotation[3];
    const double rotation[9] = {
        1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),
        2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
        2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y),
    };
    for (int i = 0; i < 16; i++)
        m[i] = i % 5 == 0;
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            m[4 * column + row] = rotation[3 * column + row] * t->scale[column];
    memcpy(m + 12, t->translation, sizeof t->translation);
}

/* The node's own transform, column-major. */
static bool local_transform(const cJSON *node, double m[16]) {
    gltf_transform transform;
    gltf_transform_read(node, &transform);
    gltf_transform_matrix(&transform, m);
    gltf_numbers(node, "matrix", 16, m);
    for (int i = 0; i < 16; i++)
        if (!isfinite(m[i]))
            return false;
    return true;
}

static void multiply(const double *a, const double *b, double *out) {
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            double sum = 0.0;
            for (int k = 0; k < 4; k++)
                sum += a[4 * k + row] * b[4 * column + k];
            out[4 * column + row] = sum;
        }
}

typedef struct walk_entry {
    long node, parent;
    int depth;
} walk_entry;

/* Walks the node tree from the scene's roots and computes world transforms. Each node may be
 * reached once: that excludes cycles. */
static bool walk_nodes(gltf *document, walk_entry *stack, char *seen, cli_error *error) {
    bool ok = true;
    size_t used = 0;
    const cJSON *scenes = gltf_member(document->root, "scenes"), *item;
    const long number =
        gltf_index(document->root, "scene", (size_t)cJSON_GetArraySize(scenes), &ok);
    const cJSON *scene_entry = cJSON_GetArrayItem(scenes, number < 0 ? 0 : (int)number);
    const cJSON *children = gltf_member(scene_entry, "nodes");
    walk_entry at = { -1, -1, 0 };
    for (;;) {
        cJSON_ArrayForEach(item, children) {
            const double child = cJSON_IsNumber(item) ? item->valuedouble : -1.0;
            if (!(child >= 0.0 && child < (double)document->nodes.count) || seen[(size_t)child])
                return fail_entry(document, "node", (size_t)(at.node < 0 ? 0 : at.node),
                                  "has a child that does not exist or has another parent", error);
            seen[(size_t)child] = 1;
            stack[used++] = (walk_entry) { (long)child, at.node, at.depth + 1 };
        }
        if (used == 0)
            return ok || cli_fail(error, document->subject, "is no valid glTF: no such scene");
        at = stack[--used];
        const cJSON *node = document->nodes.items[at.node];
        double local[16];
        gltf_index(node, "mesh", document->meshes.count, &ok);
        gltf_index(node, "camera", document->cameras.count, &ok);
        if (!ok || !local_transform(node, local))
            return fail_entry(document, "node", (size_t)at.node,
                              "refers to what is not there, or has no finite transform", error);
        if (at.depth > NODE_DEPTH_MAX)
            return fail_entry(document, "node", (size_t)at.node, "is nested too deep", error);
        if (at.parent >= 0)
            multiply(document->world[at.parent], local, document->world[at.node]);
        else
            memcpy(document->world[at.node], local, sizeof local);
        children = gltf_member(node, "children");
    }
}

static bool check_nodes(gltf *document, cli_error *error) {
    const size_t count = document->nodes.count;
    document->world = calloc(count + 1, sizeof *document->world);
    walk_entry *stack = calloc(count + 1, sizeof *stack);
    char *seen = calloc(count + 1, 1);
    const bool ok = document->world && stack && seen
                        ? walk_nodes(document, stack, seen, error)
                        : cli_fail(error, document->subject, "does not fit into memory");
    free(stack);
    free(seen);
    return ok;
}

/* --- opening ------------------------------------------------------------------------------------
 */

static bool make_lists(gltf *document) {
    const cJSON *root = document->root;
    const cJSON *punctual = gltf_member(gltf_member(root, "extensions"), "KHR_lights_punctual");
    return make_list(root, "nodes", &document->nodes) &&
           make_list(root, "meshes", &document->meshes) &&
           make_list(root, "materials", &document->materials) &&
           make_list(root, "textures", &document->textures) &&
           make_list(root, "images", &document->images) &&
           make_list(root, "samplers", &document->samplers) &&
           make_list(root, "buffers", &document->buffers) &&
           make_list(root, "bufferViews", &document->views) &&
           make_list(root, "accessors", &document->accessors) &&
           make_list(root, "cameras", &document->cameras) &&
           make_list(punctual, "lights", &document->lights);
}

bool gltf_open(const void *data, size_t size, source_set *sources, gltf *document,
               cli_error *error) {
    memset(document, 0, sizeof *document);
    document->subject = sources->subject;
    document->sources = sources;
    const unsigned char *json = data;
    size_t json_size = size;
    if (size >= 4 && memcmp(data, "glTF", 4) == 0 &&
        !split_glb(document, data, size, &json, &json_size, error))
        return false;
    document->root = cJSON_ParseWithLength((const char *)json, json_size);
    if (!cJSON_IsObject(document->root))
        return cli_fail(error, document->subject, "is no valid JSON (truncated?)");
    if (!make_lists(document))
        return cli_fail(error, document->subject, "does not fit into memory");
    if (!check_version(document, error))
        return false;
    sandbox_expect_input(size + input_bytes(document));
    return check_buffers(document, error) && check_views(document, error) &&
           check_accessors(document, error) && check_meshes(document, error) &&
           check_nodes(document, error);
}

void gltf_close(gltf *document) {
    const gltf_list *lists[] = { &document->nodes,    &document->meshes, &document->materials,
                                 &document->textures, &document->images, &document->samplers,
                                 &document->buffers,  &document->views,  &document->accessors,
                                 &document->cameras,  &document->lights };
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        free(lists[i]->items);
    free(document->world);
    cJSON_Delete(document->root);
}

static bool decode_base64(const char *text, unsigned char **bytes, size_t *size) {
    *size = base64_size(text);
    unsigned char *out = *bytes = malloc(*size + 3);
    uint32_t group = 0;
    int have = 0;
    for (; out && *text && *text != '='; text++) {
        const char c = *text;
        const int digit = c >= 'A' && c <= 'Z'   ? c - 'A'
                          : c >= 'a' && c <= 'z' ? c - 'a' + 26
                          : c >= '0' && c <= '9' ? c - '0' + 52
                          : c == '+'             ? 62
                          : c == '/'             ? 63
                                                 : -1;
        if (digit < 0)
            return false;
        group = group << 6 | (uint32_t)digit;
        if (++have == 4) {
            *out++ = (unsigned char)(group >> 16);
            *out++ = (unsigned char)(group >> 8);
            *out++ = (unsigned char)group;
            have = 0;
        }
    }
    if (have >= 2)
        group <<= 6 * (4 - have);
    if (out && have >= 2)
        *out++ = (unsigned char)(group >> 16);
    if (out && have == 3)
        *out++ = (unsigned char)(group >> 8);
    return out != NULL;
}

bool gltf_data_uri_bytes(const char *uri, void **owned, size_t *size) {
    unsigned char *bytes = NULL;
    const char *text = data_uri_text(uri);
    const bool ok = text && decode_base64(text, &bytes, size);
    if (!ok)
        free(bytes);
    *owned = ok ? bytes : NULL;
    return ok;
}

bool gltf_view_bytes(const gltf *document, size_t view, const unsigned char **bytes, size_t *size,
                     void **owned, cli_error *error) {
    const cJSON *entry = document->views.items[view];
    const size_t number = (size_t)gltf_number(entry, "buffer", 0.0);
    const char *uri = gltf_text(document->buffers.items[number], "uri");
    const size_t offset = (size_t)gltf_number(entry, "byteOffset", 0.0);
    *size = (size_t)gltf_number(entry, "byteLength", 0.0);
    *owned = NULL;
    if (data_uri_text(uri)) {
        unsigned char *decoded;
        size_t decoded_size;
        const bool ok = decode_base64(data_uri_text(uri), &decoded, &decoded_size);
        *owned = decoded;
        if (!ok || offset + *size > decoded_size)
            return fail_entry(document, "buffer", number, "is no valid base64", error);
        *bytes = decoded + offset;
    } else if (uri[0]) {
        const source *found;
        if (!sources_read(document->sources, uri, &found, error))
            return false;
        *bytes = (const unsigned char *)found->data + offset;
    } else {
        *bytes = document->binary + offset;
    }
    return true;
}
