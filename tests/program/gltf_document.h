/* SPDX-License-Identifier: MIT */
/* gltf_document.h - a valid glTF document to change, and functions that read it. */
#ifndef LAMPION_GLTF_DOCUMENT_H
#define LAMPION_GLTF_DOCUMENT_H

#include "app/scene/gltf/gltf.h"

#include "tests/oracle/check.h"

#include <stdlib.h>
#include <string.h>

/* --- a valid document ------------------------------------------------------------------------- */

/* The document's bytes: four positions, three indices in each of three types, two matrices, two
 * times, two translations, a joint and a weight per vertex, and an image of one pixel. */
enum {
    POSITIONS = 0,
    BYTES = 48,
    SHORTS = 52,
    INTS = 60,
    MATRIX = 72,
    TIMES = 136,
    TRANSLATIONS = 144,
    JOINTS = 168,
    WEIGHTS = 184,
    PIXEL = 248
};

/* A PNG of one white pixel. */
static const unsigned char pixel_png[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
    0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00,
    0x00, 0x1f, 0x15, 0xc4, 0x89, 0x00, 0x00, 0x00, 0x0b, 0x49, 0x44, 0x41, 0x54, 0x78,
    0x9c, 0x63, 0xf8, 0x0f, 0x04, 0x00, 0x09, 0xfb, 0x03, 0xfd, 0xfb, 0x5e, 0x6b, 0x2b,
    0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82
};

static const char document[] =
    "{\"asset\":{\"version\":\"2.0\",\"minVersion\":\"2.0\",\"generator\":\"test\"},"
    "\"scene\":0,\"scenes\":[{\"nodes\":[0,2,3],\"name\":\"all\"}],"
    "\"extensionsUsed\":[\"KHR_lights_punctual\",\"KHR_texture_transform\"],"
    "\"extensionsRequired\":[\"KHR_texture_transform\"],"
    "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\",\"color\":[1,0.5,0],"
    "\"intensity\":4,\"range\":9,\"spot\":{\"innerConeAngle\":0.1,\"outerConeAngle\":0.5}}]}},"
    "\"nodes\":[{\"children\":[1],\"translation\":[1,2,3],\"rotation\":[0,0,0,1],"
    "\"scale\":[1,1,1],\"name\":\"top\"},{\"mesh\":0,\"skin\":0},"
    "{\"camera\":0,\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,9,1]},"
    "{\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}],"
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"aspectRatio\":1.5,\"yfov\":0.6,"
    "\"zfar\":10,\"znear\":0.1}}],"
    "\"skins\":[{\"joints\":[0],\"inverseBindMatrices\":4,\"skeleton\":0}],"
    "\"meshes\":[{\"name\":\"m\",\"primitives\":[{\"mode\":4,\"attributes\":{\"POSITION\":0,"
    "\"JOINTS_0\":7,\"WEIGHTS_0\":8},\"indices\":1,\"material\":0}]}],"
    "\"materials\":[{\"name\":\"m\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,1],"
    "\"baseColorTexture\":{\"index\":0,\"texCoord\":0,\"extensions\":{\"KHR_texture_transform\":"
    "{\"offset\":[0,0],\"rotation\":0,\"scale\":[2,2]}}},\"metallicFactor\":0.5,"
    "\"roughnessFactor\":0.5,\"metallicRoughnessTexture\":{\"index\":0}},"
    "\"normalTexture\":{\"index\":0,\"scale\":1},\"emissiveTexture\":{\"index\":0},"
    "\"emissiveFactor\":[0,0,0],\"alphaMode\":\"MASK\",\"alphaCutoff\":0.5,\"doubleSided\":true}],"
    "\"textures\":[{\"source\":0,\"sampler\":0}],"
    "\"samplers\":[{\"magFilter\":9729,\"minFilter\":9987,\"wrapS\":10497,\"wrapT\":33071}],"
    "\"images\":[{\"bufferView\":9,\"mimeType\":\"image/png\"}],"
    "\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":3,"
    "\"path\":\"translation\"}}],\"samplers\":[{\"input\":5,\"output\":6,"
    "\"interpolation\":\"LINEAR\"}]}],"
    "\"accessors\":["
    "{\"bufferView\":0,\"byteOffset\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\","
    "\"min\":[0,0,0],\"max\":[1,1,0]},"
    "{\"bufferView\":1,\"componentType\":5121,\"count\":3,\"type\":\"SCALAR\"},"
    "{\"bufferView\":2,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"},"
    "{\"bufferView\":3,\"componentType\":5125,\"count\":3,\"type\":\"SCALAR\"},"
    "{\"bufferView\":4,\"componentType\":5126,\"count\":1,\"type\":\"MAT4\"},"
    "{\"bufferView\":5,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"},"
    "{\"bufferView\":6,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"},"
    "{\"bufferView\":7,\"componentType\":5121,\"count\":4,\"type\":\"VEC4\"},"
    "{\"bufferView\":8,\"componentType\":5126,\"count\":4,\"type\":\"VEC4\"}],"
    "\"bufferViews\":["
    "{\"buffer\":0,\"byteOffset\":0,\"byteLength\":48,\"byteStride\":12,\"target\":34962},"
    "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":3,\"target\":34963},"
    "{\"buffer\":0,\"byteOffset\":52,\"byteLength\":6},"
    "{\"buffer\":0,\"byteOffset\":60,\"byteLength\":12},"
    "{\"buffer\":0,\"byteOffset\":72,\"byteLength\":64},"
    "{\"buffer\":0,\"byteOffset\":136,\"byteLength\":8},"
    "{\"buffer\":0,\"byteOffset\":144,\"byteLength\":24},"
    "{\"buffer\":0,\"byteOffset\":168,\"byteLength\":16},"
    "{\"buffer\":0,\"byteOffset\":184,\"byteLength\":64},"
    "{\"buffer\":0,\"byteOffset\":248,\"byteLength\":68}],"
    "\"buffers\":[{\"byteLength\":320}],\"extras\":{\"any\":[1,\"thing\"]}}";

static unsigned char bytes[320];

static inline void fill_bytes(void) {
    static const float positions[12] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 };
    static const float times[2] = { 0, 1 }, translations[6] = { 0, 0, 0, 1, 1, 1 };
    static const uint16_t shorts[3] = { 0, 1, 2 };
    static const uint32_t ints[3] = { 0, 1, 2 };
    float matrix[16] = { 0 };
    for (int i = 0; i < 16; i += 5)
        matrix[i] = 1.0f;
    memset(bytes, 0, sizeof bytes);
    memcpy(bytes + POSITIONS, positions, sizeof positions);
    memcpy(bytes + BYTES, "\0\1\2", 3);
    memcpy(bytes + SHORTS, shorts, sizeof shorts);
    memcpy(bytes + INTS, ints, sizeof ints);
    memcpy(bytes + MATRIX, matrix, sizeof matrix);
    memcpy(bytes + TIMES, times, sizeof times);
    memcpy(bytes + TRANSLATIONS, translations, sizeof translations);
    for (size_t i = 0; i < 4; i++)
        memcpy(bytes + WEIGHTS + 16 * i, &matrix[0], sizeof *matrix);
    memcpy(bytes + PIXEL, pixel_png, sizeof pixel_png);
}

/* --- reading one ------------------------------------------------------------------------------ */

static inline unsigned char *pack_glb(const char *json, size_t *size) {
    const size_t length = strlen(json), padded = (length + 3) & ~(size_t)3;
    *size = 12 + 8 + padded + 8 + sizeof bytes;
    unsigned char *glb = malloc(*size);
    assert_non_null(glb);
    const uint32_t head[5] = { 0x46546c67, 2, (uint32_t)*size, (uint32_t)padded, 0x4e4f534a };
    const uint32_t tail[2] = { sizeof bytes, 0x004e4942 };
    memcpy(glb, head, sizeof head);
    memset(glb + 20, ' ', padded);
    memcpy(glb + 20, json, length);
    memcpy(glb + 20 + padded, tail, sizeof tail);
    memcpy(glb + 28 + padded, bytes, sizeof bytes);
    return glb;
}

/* Whether these bytes are read; receives what they hold. */
static inline bool reads_bytes(const void *data, size_t size, scene_builder *builder,
                               base_error *error) {
    source_set sources = { .subject = "input", .folder = "/nowhere" };
    *error = (base_error) { .text = "" };
    memset(builder, 0, sizeof *builder);
    const bool ok = gltf_add(data, size, &sources, builder, error);
    sources_free(&sources);
    return ok;
}

static inline bool reads(const char *json, scene_builder *builder, base_error *error) {
    size_t size;
    unsigned char *glb = pack_glb(json, &size);
    const bool ok = reads_bytes(glb, size, builder, error);
    free(glb);
    return ok;
}

static inline void expect(const char *json, const char *refusal, const char *what) {
    scene_builder builder;
    base_error error;
    const bool ok = reads(json, &builder, &error);
    if (ok != (refusal == NULL) || (refusal && !strstr(error.text, refusal)))
        fail_msg("%s: \"%s\" instead of \"%s\"", what, ok ? "read" : error.text,
                 refusal ? refusal : "read");
    builder_free(&builder);
}

/* Returns a text with the first `from` replaced by `to`; the caller frees it. */
static inline char *replaced(const char *in, const char *from, const char *to) {
    const char *found = strstr(in, from);
    if (!found)
        fail_msg("\"%s\" is not in the document", from);
    char *text = malloc(strlen(in) + strlen(to) + 1);
    assert_non_null(text);
    sprintf(text, "%.*s%s%s", (int)(found - in), in, to, found + strlen(from));
    return text;
}

static inline char *changed(const char *from, const char *to) {
    return replaced(document, from, to);
}

#endif
