/* SPDX-License-Identifier: MIT */
/* batch.h - reads the caller's arrays in chunks of elements, transposed to the kernels' planes. */
#ifndef LAMPION_KERNELS_BATCH_H
#define LAMPION_KERNELS_BATCH_H

#include "src/base/element.h"
#include "src/kernels/convert.h"

#include <string.h>

/* Elements of a chunk, whose planes fit the first-level cache: a multiple of the registers that
 * kernels take side by side, three and four of LMPI_KERNEL_LANES_MAX. A file with many planes, or
 * with kernels that need most of the stack, defines a smaller number before it includes this
 * header. */
#ifndef LMPI_BATCH
#define LMPI_BATCH 192
#endif

typedef struct lmpi_batch_plane {
    float at[LMPI_BATCH] __attribute__((aligned(64)));
} lmpi_batch_plane;

/* Pointers to the planes of a chunk's vectors, and the memory for them. */
typedef struct lmpi_batch_vec3 {
    float *x, *y, *z;
} lmpi_batch_vec3;

typedef struct lmpi_batch_room {
    lmpi_batch_plane x, y, z;
} lmpi_batch_room;

static inline lmpi_batch_vec3 lmpi_batch_in(lmpi_batch_room *room) {
    return (lmpi_batch_vec3) { room->x.at, room->y.at, room->z.at };
}

static inline size_t lmpi_batch_count(size_t count, size_t first) {
    return count - first < LMPI_BATCH ? count - first : LMPI_BATCH;
}

/* Whether kernels can read the elements in place, as a plane of whole registers. */
static inline bool lmpi_batch_is_there(size_t stride, size_t count) {
    return stride == sizeof(float) && count % LMPI_KERNEL_LANES_MAX == 0;
}

/* Sets the lanes of a plane past the last of `count` to 0: by sizes that compilers know, because a
 * call of memset takes as long as a small kernel. */
static inline void lmpi_batch_fill_plane(float *plane, size_t count) {
    const size_t missing = -count % LMPI_KERNEL_LANES_MAX;
    plane += count;
    for (size_t size = 1; size < LMPI_KERNEL_LANES_MAX; size *= 2)
        if (missing & size) {
            memset(plane, 0, size * sizeof *plane);
            plane += size;
        }
}

/* Returns elements first … first+count-1 in place, or copied to `plane`, whose lanes past them are
 * 0. */
static inline const float *lmpi_batch_floats(const float *array, size_t stride, size_t first,
                                             size_t count, float *plane) {
    if (lmpi_batch_is_there(stride, count))
        return array + first;
    if (stride == sizeof(float))
        memcpy(plane, array + first, count * sizeof(float));
    else
        for (size_t i = 0; i < count; i++)
            plane[i] = lmpi_element(array, stride, first + i);
    lmpi_batch_fill_plane(plane, count);
    return plane;
}

static inline lmpi_kernel_vec3 lmpi_batch_planes(lmpi_batch_vec3 planes) {
    return (lmpi_kernel_vec3) { planes.x, planes.y, planes.z };
}

static inline void lmpi_batch_set(float x, float y, float z, lmpi_batch_vec3 planes, size_t i) {
    planes.x[i] = x;
    planes.y[i] = y;
    planes.z[i] = z;
}

static inline lmp_vec3 lmpi_batch_get(const lmpi_kernel_vec3 *vectors, size_t i) {
    return (lmp_vec3) { vectors->x[i], vectors->y[i], vectors->z[i] };
}

/* Loads element i of the caller's array to element `to` of the planes. */
static inline void lmpi_batch_load(const lmp_vec3_array *array, size_t i, lmpi_batch_vec3 planes,
                                   size_t to) {
    const lmp_vec3 v = lmpi_vec3_element(array, i);
    lmpi_batch_set(v.x, v.y, v.z, planes, to);
}

/* Sets the lanes past the last of `count` to 0. */
static inline void lmpi_batch_fill(lmpi_batch_vec3 planes, size_t count) {
    lmpi_batch_fill_plane(planes.x, count);
    lmpi_batch_fill_plane(planes.y, count);
    lmpi_batch_fill_plane(planes.z, count);
}

/* Whether vectors follow one another as an array of lmp_vec3 does. */
static inline bool lmpi_batch_is_packed(const lmp_vec3_array *array) {
    return array->stride == sizeof(lmp_vec3) && array->y == array->x + 1 &&
           array->z == array->x + 2;
}

/* Copies vectors that follow one another. The planes must not overlap, so that compilers
 * vectorize. */
static inline void lmpi_batch_unpack(const float *vectors, size_t count, float *restrict x,
                                     float *restrict y, float *restrict z) {
    for (size_t i = 0; i < count; i++) {
        x[i] = vectors[3 * i];
        y[i] = vectors[3 * i + 1];
        z[i] = vectors[3 * i + 2];
    }
}

/* Returns vectors first … first+count-1 in place where their members are planes, otherwise copied
 * in one pass over them. */
static inline lmpi_kernel_vec3 lmpi_batch_vectors(const lmp_vec3_array *array, size_t first,
                                                  size_t count, lmpi_batch_vec3 planes) {
    if (array->stride == sizeof(float))
        return (lmpi_kernel_vec3) {
            lmpi_batch_floats(array->x, array->stride, first, count, planes.x),
            lmpi_batch_floats(array->y, array->stride, first, count, planes.y),
            lmpi_batch_floats(array->z, array->stride, first, count, planes.z)
        };
    if (lmpi_batch_is_packed(array))
        lmpi_batch_unpack(array->x + 3 * first, count, planes.x, planes.y, planes.z);
    else
        for (size_t i = 0; i < count; i++)
            lmpi_batch_load(array, first + i, planes, i);
    lmpi_batch_fill(planes, count);
    return lmpi_batch_planes(planes);
}

/* Converts a caller's stride, in bytes and 0 for tight, to the kernels', in floats. */
static inline size_t lmpi_batch_stride(size_t stride, size_t tight) {
    return stride ? stride / sizeof(float) : tight;
}

/* Describe a result of `values` values per element, and the same result without its first elements.
 */
static inline lmpi_kernel_out lmpi_batch_all(float *at, size_t values, size_t count, int planar,
                                             size_t stride) {
    return (lmpi_kernel_out) { at, lmpi_batch_stride(stride, planar ? count : values), planar };
}
static inline lmpi_kernel_out lmpi_batch_from(const lmpi_kernel_out *all, size_t first) {
    lmpi_kernel_out out = *all;
    out.at += out.planar ? first : first * out.stride;
    return out;
}
static inline lmpi_kernel_out lmpi_batch_out(float *at, size_t values, size_t count, int planar,
                                             size_t stride, size_t first) {
    const lmpi_kernel_out all = lmpi_batch_all(at, values, count, planar, stride);
    return lmpi_batch_from(&all, first);
}

/* Results larger than this are stored past the caches. A core that shares a last-level cache of 32
 * MB with others gains by it from 8 MB on, and in larger caches a reader may still find up to 16
 * MB. Below 7 bands ordinary stores are about as fast. */
#define LMPI_BATCH_STREAMED            ((size_t)16 << 20)
#define LMPI_BATCH_STREAMED_VALUES_MIN 49

/* Whether a result is streamed. Planes must begin at the same offset in a cache line, or none would
 * be written in whole lines. */
static inline bool lmpi_batch_streams(const lmpi_kernel_out *out, size_t values, size_t count) {
    return values >= LMPI_BATCH_STREAMED_VALUES_MIN && values <= LMPI_KERNEL_STREAM_VALUES_MAX &&
           values * sizeof(float) * count > LMPI_BATCH_STREAMED &&
           (!out->planar || out->stride % LMPI_KERNEL_LINE == 0);
}

/* Returns the elements of the chunk from `first` on; the first chunk of streamed planes ends where
 * a cache line does. */
static inline size_t lmpi_batch_chunk(const lmpi_kernel_out *all, bool streams, size_t count,
                                      size_t first) {
    const size_t head = -((uintptr_t)all->at / sizeof(float)) % LMPI_KERNEL_LINE;
    return streams && all->planar && first == 0 && head > 0 ? head : lmpi_batch_count(count, first);
}

/* Makes streamed stores visible to other threads. */
static inline void lmpi_batch_fence(void) {
#ifdef __SSE2__
    __builtin_ia32_sfence();
#endif
}

#endif
