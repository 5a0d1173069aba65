/* SPDX-License-Identifier: MIT */
#include "app/scene/gltf/meshopt.h"

#include <meshoptimizer.h>
#include <stdint.h>
#include <stdlib.h>

/* limits on the decoded size per byte: of attributes, two bits can stand for 16 bytes */
#define BYTES_A_BYTE  128
#define BYTES_BESIDES 65536
#define STRIDE_MAX    256

/* The first byte of a stream by kind: the kind in its upper half, the version in the lower. */
static const struct {
    unsigned kind, newest;
} streams[] = { [MESHOPT_ATTRIBUTES] = { 0xa0, 0 },
                [MESHOPT_TRIANGLES] = { 0xe0, 1 },
                [MESHOPT_INDICES] = { 0xd0, 1 } };

/* Checks what the library asserts about a layout. */
static const char *layout_wrong(const meshopt_layout *layout) {
    const size_t stride = layout->stride;
    const bool index = stride == 2 || stride == 4;
    if (layout->filter == MESHOPT_COLOR)
        return "has the color filter, which is not supported (export it without)";
    if (layout->mode == MESHOPT_ATTRIBUTES ? stride == 0 || stride > STRIDE_MAX || stride % 4 != 0
                                           : !index)
        return "is compressed with a stride that its mode does not have";
    if (layout->mode == MESHOPT_TRIANGLES && layout->count % 3 != 0)
        return "is compressed as triangles whose indices are no multiple of 3";
    if (layout->filter != MESHOPT_NONE && layout->mode != MESHOPT_ATTRIBUTES)
        return "is compressed with a filter that its mode does not have";
    if ((layout->filter == MESHOPT_OCTAHEDRAL && stride != 4 && stride != 8) ||
        (layout->filter == MESHOPT_QUATERNION && stride != 8))
        return "is compressed with a stride that its filter does not have";
    return NULL;
}

static const char *stream_wrong(const meshopt_layout *layout, const unsigned char *data,
                                size_t size) {
    if (size == 0 || (data[0] & 0xf0u) != streams[layout->mode].kind)
        return "is compressed in another way than its mode";
    if ((data[0] & 0x0fu) > streams[layout->mode].newest)
        return "is compressed by a newer version of meshoptimizer, which is not supported";
    if (layout->count > (BYTES_A_BYTE * size + BYTES_BESIDES) / layout->stride)
        return "has more elements than its compressed data hold";
    return NULL;
}

static bool decode(const meshopt_layout *layout, const unsigned char *data, size_t size, void *to) {
    switch (layout->mode) {
    case MESHOPT_ATTRIBUTES:
        return meshopt_decodeVertexBuffer(to, layout->count, layout->stride, data, size) == 0;
    case MESHOPT_TRIANGLES:
        return meshopt_decodeIndexBuffer(to, layout->count, layout->stride, data, size) == 0;
    default:
        return meshopt_decodeIndexSequence(to, layout->count, layout->stride, data, size) == 0;
    }
}

static void unfilter(const meshopt_layout *layout, void *bytes) {
    if (layout->filter == MESHOPT_OCTAHEDRAL)
        meshopt_decodeFilterOct(bytes, layout->count, layout->stride);
    if (layout->filter == MESHOPT_QUATERNION)
        meshopt_decodeFilterQuat(bytes, layout->count, layout->stride);
    if (layout->filter == MESHOPT_EXPONENTIAL)
        meshopt_decodeFilterExp(bytes, layout->count, layout->stride);
}

void *meshopt_decode(const meshopt_layout *layout, const unsigned char *data, size_t size,
                     const char **wrong) {
    *wrong = layout_wrong(layout);
    if (!*wrong)
        *wrong = stream_wrong(layout, data, size);
    if (*wrong)
        return NULL;
    void *const bytes = calloc(layout->count, layout->stride);
    if (bytes && decode(layout, data, size, bytes)) {
        unfilter(layout, bytes);
        return bytes;
    }
    *wrong = bytes ? "has damaged compressed data" : "does not fit into memory";
    free(bytes);
    return NULL;
}
