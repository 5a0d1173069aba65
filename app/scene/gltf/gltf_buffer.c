/* SPDX-License-Identifier: MIT */
/* gltf_buffer.c - buffers, the views into them, and the accessors of these. */
#include "app/scene/escape.h"
#include "app/scene/gltf/gltf.h"
#include "app/scene/gltf/meshopt.h"

#include <stdlib.h>
#include <string.h>

/* the most that accessors without a buffer view may claim: their elements are zeros, and cost a
 * file nothing */
#define UNBACKED_BYTES_MAX (64u << 20)

/* --- data URIs -------------------------------------------------------------------------------- */

static int base64_digit(char c) {
    return c >= 'A' && c <= 'Z'   ? c - 'A'
           : c >= 'a' && c <= 'z' ? c - 'a' + 26
           : c >= '0' && c <= '9' ? c - '0' + 52
           : c == '+'             ? 62
           : c == '/'             ? 63
                                  : -1;
}

static bool decode_base64(const char *text, gltf_bytes *bytes) {
    size_t length = strlen(text);
    while (length > 0 && text[length - 1] == '=')
        length--;
    unsigned char *out = length % 4 == 1 ? NULL : malloc(length / 4 * 3 + 3);
    uint32_t group = 0;
    size_t size = 0;
    for (size_t i = 0; out && i < length; i++) {
        const int digit = base64_digit(text[i]);
        if (digit < 0) {
            free(out);
            return false;
        }
        group = group << 6 | (uint32_t)digit;
        if (i % 4 > 0)
            out[size++] = (unsigned char)(group >> (6 - 2 * (i % 4)));
    }
    *bytes = (gltf_bytes) { .bytes = out, .size = size, .owned = out };
    return out != NULL;
}

/* Decodes a data URI without base64: characters, and escapes of others (RFC 2397). */
static bool decode_escaped(const char *text, gltf_bytes *bytes) {
    unsigned char *out = malloc(strlen(text) + 1);
    size_t size = 0;
    for (const char *c = text; out && *c;)
        out[size++] = (unsigned char)escape_next(&c);
    *bytes = (gltf_bytes) { .bytes = out, .size = size, .owned = out };
    return out != NULL;
}

bool gltf_data_uri(const char *uri, gltf_bytes *bytes) {
    static const char mark[] = ";base64";
    const char *comma = strncmp(uri, "data:", 5) == 0 ? strchr(uri, ',') : NULL;
    if (!comma)
        return false;
    const bool base64 = (size_t)(comma - uri) >= sizeof mark - 1 &&
                        memcmp(comma - (sizeof mark - 1), mark, sizeof mark - 1) == 0;
    return base64 ? decode_base64(comma + 1, bytes) : decode_escaped(comma + 1, bytes);
}

/* --- buffers ---------------------------------------------------------------------------------- */

/* Returns what either of the two meshoptimizer extensions says of a buffer or view. */
static json_t *compression_of(json_t *entry) {
    json_t *found = gltf_extension(entry, "KHR_meshopt_compression");
    return found ? found : gltf_extension(entry, "EXT_meshopt_compression");
}

/* Loads a buffer for readers without the extension, which may be missing. */
static bool load_fallback(gltf *document, size_t i, base_error *error) {
    const char *uri = gltf_text(gltf_item(document, GLTF_BUFFERS, i), "uri");
    const source *found;
    source_state state;
    if (!uri[0] || strncmp(uri, "data:", 5) == 0)
        return true;
    if (!sources_read_optional(document->sources, uri, &found, &state, error))
        return false;
    if (found)
        document->buffers[i] = (gltf_bytes) { .bytes = found->data, .size = found->size };
    return true;
}

static bool load_buffer(gltf *document, size_t i, base_error *error) {
    json_t *entry = gltf_item(document, GLTF_BUFFERS, i);
    const double length = gltf_number(entry, "byteLength", 0.0);
    const char *uri = gltf_text(entry, "uri");
    gltf_bytes *buffer = &document->buffers[i];
    if (json_is_true(json_object_get(compression_of(entry), "fallback")))
        return load_fallback(document, i, error);
    if (strncmp(uri, "data:", 5) == 0) {
        if (!gltf_data_uri(uri, buffer))
            return gltf_fail(document, GLTF_BUFFERS, i, "is not a valid data URI", error);
    } else if (uri[0]) {
        const source *found;
        if (!sources_read(document->sources, uri, &found, error))
            return false;
        *buffer = (gltf_bytes) { .bytes = found->data, .size = found->size };
    } else if (i == 0 && document->binary.bytes) {
        *buffer = document->binary;
    } else {
        return gltf_fail(document, GLTF_BUFFERS, i, "has no data", error);
    }
    if ((double)buffer->size < length)
        return gltf_fail(document, GLTF_BUFFERS, i, "is longer than its data (truncated?)", error);
    buffer->size = (size_t)length;
    return true;
}

static size_t choice(json_t *object, const char *name, const char *const *names, size_t count) {
    size_t i = 0;
    while (i < count && strcmp(gltf_text(object, name), names[i]) != 0)
        i++;
    return i < count ? i : 0;
}

/* Decompresses a view into memory of its own. If that fails, the view's bytes come from the buffer
 * for readers without the extension, if there is one. */
static bool decompress_view(gltf *document, size_t i, json_t *packed, base_error *error) {
    static const char *const modes[] = { "ATTRIBUTES", "TRIANGLES", "INDICES" };
    static const char *const filters[] = { "NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL",
                                           "COLOR" };
    json_t *view = gltf_item(document, GLTF_VIEWS, i);
    const gltf_bytes *from = &document->buffers[gltf_index(packed, "buffer")];
    const double offset = gltf_number(packed, "byteOffset", 0.0);
    const double length = gltf_number(packed, "byteLength", 0.0);
    const double count = gltf_number(packed, "count", 0.0);
    const double stride = gltf_number(packed, "byteStride", 0.0);
    const meshopt_layout layout = { (meshopt_mode)choice(packed, "mode", modes, 3),
                                    (meshopt_filter)choice(packed, "filter", filters, 5),
                                    (size_t)count, (size_t)stride };
    const char *wrong;
    if (!(offset + length <= (double)from->size))
        return gltf_fail(document, GLTF_VIEWS, i, "reaches outside its compressed buffer", error);
    if (count * stride != gltf_number(view, "byteLength", 0.0))
        return gltf_fail(document, GLTF_VIEWS, i, "has another length than its compressed data",
                         error);
    gltf_bytes *to = &document->views[i];
    to->owned = meshopt_decode(&layout, from->bytes + (size_t)offset, (size_t)length, &wrong);
    to->bytes = to->owned;
    to->size = (size_t)(count * stride);
    return to->owned || document->buffers[gltf_index(view, "buffer")].size > 0 ||
           gltf_fail(document, GLTF_VIEWS, i, wrong, error);
}

static bool load_view(gltf *document, size_t i, base_error *error) {
    json_t *view = gltf_item(document, GLTF_VIEWS, i);
    const size_t room = document->buffers[gltf_index(view, "buffer")].size;
    const double end = gltf_number(view, "byteOffset", 0.0) + gltf_number(view, "byteLength", 0.0);
    json_t *packed = compression_of(view);
    if (packed && !decompress_view(document, i, packed, error))
        return false;
    if (!document->views[i].bytes && !(end <= (double)room))
        return gltf_fail(document, GLTF_VIEWS, i, "reaches outside its buffer", error);
    if ((int)gltf_number(view, "byteStride", 4.0) % 4 != 0)
        return gltf_fail(document, GLTF_VIEWS, i, "has a stride that is not a multiple of 4",
                         error);
    return true;
}

gltf_bytes gltf_view_bytes(const gltf *document, size_t view) {
    json_t *entry = gltf_item(document, GLTF_VIEWS, view);
    const gltf_bytes *buffer = &document->buffers[gltf_index(entry, "buffer")];
    if (document->views[view].bytes)
        return (gltf_bytes) { .bytes = document->views[view].bytes,
                              .size = document->views[view].size };
    return (gltf_bytes) { .bytes = buffer->bytes + (size_t)gltf_number(entry, "byteOffset", 0.0),
                          .size = (size_t)gltf_number(entry, "byteLength", 0.0) };
}

bool gltf_load_buffers(gltf *document, base_error *error) {
    const size_t count = gltf_count(document, GLTF_BUFFERS);
    document->buffers = calloc(count + 1, sizeof *document->buffers);
    document->views = calloc(gltf_count(document, GLTF_VIEWS) + 1, sizeof *document->views);
    bool ok = (document->buffers && document->views) ||
              base_fail(error, document->subject, "does not fit into memory");
    for (size_t i = 0; i < count && ok; i++)
        ok = load_buffer(document, i, error);
    for (size_t i = 0; i < gltf_count(document, GLTF_VIEWS) && ok; i++)
        ok = load_view(document, i, error);
    return ok;
}

/* --- accessors -------------------------------------------------------------------------------- */

static size_t component_size(gltf_component component) {
    return component <= GLTF_UNSIGNED_BYTE ? 1 : component <= GLTF_UNSIGNED_SHORT ? 2 : 4;
}

typedef struct element {
    const char *name;
    int columns, rows;
} element;

static const element *find_element(const char *type) {
    static const element known[] = { { "SCALAR", 1, 1 }, { "VEC2", 1, 2 }, { "VEC3", 1, 3 },
                                     { "VEC4", 1, 4 },   { "MAT2", 2, 2 }, { "MAT3", 3, 3 },
                                     { "MAT4", 4, 4 } };
    const element *found = known;
    while (strcmp(found->name, type) != 0)
        found++;
    return found;
}

size_t gltf_element_size(const char *type, gltf_component component) {
    const element *kind = find_element(type);
    const size_t column = (size_t)kind->rows * component_size(component);
    /* The columns of a matrix begin at multiples of 4 bytes. */
    return kind->columns == 1 ? column : (size_t)kind->columns * ((column + 3) & ~(size_t)3);
}

/* Returns the bytes of `count` elements in the view that `holder` names, or NULL if they are not
 * all inside it or not aligned to their components. */
static const unsigned char *find_elements(const gltf *document, json_t *holder, double count,
                                          size_t size, size_t stride, gltf_component component) {
    const gltf_bytes view = gltf_view_bytes(document, (size_t)gltf_index(holder, "bufferView"));
    const double offset = gltf_number(holder, "byteOffset", 0.0);
    json_t *entry = gltf_item(document, GLTF_VIEWS, (size_t)gltf_index(holder, "bufferView"));
    const size_t unit = component_size(component);
    if (!(offset + (count - 1.0) * (double)stride + (double)size <= (double)view.size) ||
        (size_t)offset % unit != 0 ||
        ((size_t)gltf_number(entry, "byteOffset", 0.0) + (size_t)offset) % unit != 0)
        return NULL;
    return view.bytes + (size_t)offset;
}

static bool load_sparse(const gltf *document, json_t *sparse, size_t size, gltf_accessor *a) {
    json_t *indices = json_object_get(sparse, "indices"),
           *values = json_object_get(sparse, "values");
    const double count = gltf_number(sparse, "count", 0.0);
    if (!(count <= (double)a->count))
        return false;
    a->sparse.count = (size_t)count;
    a->sparse.component = (gltf_component)gltf_number(indices, "componentType", 0.0);
    const size_t item = component_size(a->sparse.component);
    a->sparse.indices = find_elements(document, indices, count, item, item, a->sparse.component);
    a->sparse.values = find_elements(document, values, count, size, size, a->component);
    return a->sparse.indices && a->sparse.values;
}

static bool load_accessor(const gltf *document, size_t i, gltf_accessor *a, base_error *error) {
    json_t *entry = gltf_item(document, GLTF_ACCESSORS, i);
    json_t *sparse = json_object_get(entry, "sparse");
    const double count = gltf_number(entry, "count", 0.0);
    const element *kind = find_element(gltf_text(entry, "type"));
    *a = (gltf_accessor) { .count = (size_t)count,
                           .width = kind->columns * kind->rows,
                           .component = (gltf_component)gltf_number(entry, "componentType", 0.0),
                           .normalized = json_is_true(json_object_get(entry, "normalized")),
                           .view = gltf_index(entry, "bufferView") };
    const size_t size = gltf_element_size(kind->name, a->component);
    a->stride = size;
    a->normalized = a->normalized && a->component != GLTF_FLOAT;
    if (a->normalized && component_size(a->component) == 4)
        return gltf_fail(document, GLTF_ACCESSORS, i, "has a type that cannot be normalized",
                         error);
    if (a->view >= 0) {
        json_t *view = gltf_item(document, GLTF_VIEWS, (size_t)a->view);
        a->stride = (size_t)gltf_number(view, "byteStride", (double)size);
        if (a->stride < size)
            return gltf_fail(document, GLTF_ACCESSORS, i, "has elements that overlap", error);
        a->bytes = find_elements(document, entry, count, size, a->stride, a->component);
        if (!a->bytes)
            return gltf_fail(document, GLTF_ACCESSORS, i,
                             "reaches outside its bufferView, or is not aligned in it", error);
    }
    return !sparse || load_sparse(document, sparse, size, a) ||
           gltf_fail(document, GLTF_ACCESSORS, i, "has invalid sparse data", error);
}

static bool check_backing(const gltf *document, size_t i, base_error *error) {
    const gltf_accessor *a = &document->accessors[i];
    return a->bytes || (double)a->count * (double)a->stride <= UNBACKED_BYTES_MAX ||
           gltf_fail(document, GLTF_ACCESSORS, i, "has a count without data", error);
}

bool gltf_load_accessors(gltf *document, base_error *error) {
    const size_t count = gltf_count(document, GLTF_ACCESSORS);
    document->accessors = calloc(count + 1, sizeof *document->accessors);
    bool ok =
        document->accessors || base_fail(error, document->subject, "does not fit into memory");
    for (size_t i = 0; i < count && ok; i++)
        ok = load_accessor(document, i, &document->accessors[i], error);
    return ok;
}

bool gltf_check_backing(const gltf *document, base_error *error) {
    bool ok = true;
    for (size_t i = 0; i < gltf_count(document, GLTF_ACCESSORS) && ok; i++)
        ok = check_backing(document, i, error);
    return ok;
}
