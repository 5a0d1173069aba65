/* SPDX-License-Identifier: MIT */
/* batch.h - from the caller's arrays to the kernels': chunks of elements, transposed to planes. */
#ifndef LAMPION_KERNELS_BATCH_H
#define LAMPION_KERNELS_BATCH_H

#include "src/base/element.h"
#include "src/kernels/kernels.h"

#include <string.h>

/* Elements of a chunk: a multiple of the registers that kernels take side by side, three and four
 * of LMP_KERNEL_LANES_MAX, whose planes fit the first cache. Who has many planes, or kernels that
 * need most of the stack, defines a smaller one before. */
#ifndef LMP_BATCH
#define LMP_BATCH 192
#endif

typedef struct lmp_batch_plane {
    float at[LMP_BATCH] __attribute__((aligned(64)));
} lmp_batch_plane;

/* Where the planes of a chunk's vectors are, and room for them. */
typedef struct lmp_batch_vec3 {
    float *x, *y, *z;
} lmp_batch_vec3;

typedef struct lmp_batch_room {
    lmp_batch_plane x, y, z;
} lmp_batch_room;

static inline lmp_batch_vec3 lmp_batch_in(lmp_batch_room *room) {
    return (lmp_batch_vec3) { room->x.at, room->y.at, room->z.at };
}

static inline size_t lmp_batch_count(size_t count, size_t first) {
    return count - first < LMP_BATCH ? count - first : LMP_BATCH;
}

/* Whether elements are where the kernels can read them, in a plane of whole registers. */
static inline bool lmp_batch_is_there(size_t stride, size_t count) {
    return stride == sizeof(float) && count % LMP_KERNEL_LANES_MAX == 0;
}

/* Elements first … first+count-1: where they are, or copied to `plane`, whose lanes past them are
 * 0. */
static inline const float *lmp_batch_floats(const float *array, size_t stride, size_t first,
                                            size_t count, float *plane) {
    if (lmp_batch_is_there(stride, count))
        return array + first;
    if (stride == sizeof(float))
        memcpy(plane, array + first, count * sizeof(float));
    else
        for (size_t i = 0; i < count; i++)
            plane[i] = lmp_element(array, stride, first + i);
    for (size_t i = count; i % LMP_KERNEL_LANES_MAX; i++)
        plane[i] = 0;
    return plane;
}

static inline lmp_kernel_vec3 lmp_batch_planes(lmp_batch_vec3 planes) {
    return (lmp_kernel_vec3) { planes.x, planes.y, planes.z };
}

static inline void lmp_batch_set(float x, float y, float z, lmp_batch_vec3 planes, size_t i) {
    planes.x[i] = x;
    planes.y[i] = y;
    planes.z[i] = z;
}

static inline lmp_vec3 lmp_batch_get(const lmp_kernel_vec3 *vectors, size_t i) {
    return (lmp_vec3) { vectors->x[i], vectors->y[i], vectors->z[i] };
}

/* Element i of the caller's at `to`. */
static inline void lmp_batch_load(const lmp_vec3_array *array, size_t i, lmp_batch_vec3 planes,
                                  size_t to) {
    const lmp_vec3 v = lmp_vec3_element(array, i);
    lmp_batch_set(v.x, v.y, v.z, planes, to);
}

/* 0 in the lanes past the last of `count`. */
static inline void lmp_batch_fill(lmp_batch_vec3 planes, size_t count) {
    const size_t missing = -count % LMP_KERNEL_LANES_MAX;
    memset(planes.x + count, 0, missing * sizeof(float));
    memset(planes.y + count, 0, missing * sizeof(float));
    memset(planes.z + count, 0, missing * sizeof(float));
}

/* The same of vectors; where their members are not planes, in one pass over them. */
static inline lmp_kernel_vec3 lmp_batch_vectors(const lmp_vec3_array *array, size_t first,
                                                size_t count, lmp_batch_vec3 planes) {
    if (array->stride == sizeof(float))
        return (
            lmp_kernel_vec3) { lmp_batch_floats(array->x, array->stride, first, count, planes.x),
                               lmp_batch_floats(array->y, array->stride, first, count, planes.y),
                               lmp_batch_floats(array->z, array->stride, first, count, planes.z) };
    for (size_t i = 0; i < count; i++)
        lmp_batch_load(array, first + i, planes, i);
    lmp_batch_fill(planes, count);
    return lmp_batch_planes(planes);
}

/* A caller's stride, in bytes and 0 for tight, as the kernels': in floats. */
static inline size_t lmp_batch_stride(size_t stride, size_t tight) {
    return stride ? stride / sizeof(float) : tight;
}

/* A result of `values` values an element, and the same without its first elements. */
static inline lmp_kernel_out lmp_batch_all(float *at, size_t values, size_t count, int planar,
                                           size_t stride) {
    return (lmp_kernel_out) { at, lmp_batch_stride(stride, planar ? count : values), planar };
}
static inline lmp_kernel_out lmp_batch_from(const lmp_kernel_out *all, size_t first) {
    lmp_kernel_out out = *all;
    out.at += out.planar ? first : first * out.stride;
    return out;
}
static inline lmp_kernel_out lmp_batch_out(float *at, size_t values, size_t count, int planar,
                                           size_t stride, size_t first) {
    const lmp_kernel_out all = lmp_batch_all(at, values, count, planar, stride);
    return lmp_batch_from(&all, first);
}

/* Results larger than this are stored past the caches. A core that shares 32 MB of the last one
 * with others gains by it from 8 MB on, and up to 16 MB a reader may still find them in larger
 * ones. Below 7 bands, kernels are about as fast the ordinary way. */
#define LMP_BATCH_STREAMED            ((size_t)16 << 20)
#define LMP_BATCH_STREAMED_VALUES_MIN 49

/* Planes have to begin in the same place of a line, or none of them is written in whole lines. */
static inline bool lmp_batch_streams(const lmp_kernel_out *out, size_t values, size_t count) {
    return values >= LMP_BATCH_STREAMED_VALUES_MIN && values <= LMP_KERNEL_STREAM_VALUES_MAX &&
           values * sizeof(float) * count > LMP_BATCH_STREAMED &&
           (!out->planar || out->stride % LMP_KERNEL_LINE == 0);
}

/* Elements of the chunk from `first` on; the first one of planes that are streamed ends where a
 * line of them does. */
static inline size_t lmp_batch_chunk(const lmp_kernel_out *all, bool streams, size_t count,
                                     size_t first) {
    const size_t head = -((uintptr_t)all->at / sizeof(float)) % LMP_KERNEL_LINE;
    return streams && all->planar && first == 0 && head > 0 ? head : lmp_batch_count(count, first);
}

/* Shows other threads what was streamed. */
static inline void lmp_batch_fence(void) {
#ifdef __SSE2__
    __builtin_ia32_sfence();
#endif
}

#endif
