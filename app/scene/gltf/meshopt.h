/* SPDX-License-Identifier: MIT */
/* meshopt.h - buffer views that meshoptimizer compressed. */
#ifndef LAMPION_SCENE_GLTF_MESHOPT_H
#define LAMPION_SCENE_GLTF_MESHOPT_H

#include <stdbool.h>
#include <stddef.h>

typedef enum meshopt_mode { MESHOPT_ATTRIBUTES, MESHOPT_TRIANGLES, MESHOPT_INDICES } meshopt_mode;

typedef enum meshopt_filter {
    MESHOPT_NONE,
    MESHOPT_OCTAHEDRAL,
    MESHOPT_QUATERNION,
    MESHOPT_EXPONENTIAL,
    MESHOPT_COLOR /* not supported */
} meshopt_filter;

typedef struct meshopt_layout {
    meshopt_mode mode;
    meshopt_filter filter;
    size_t count, stride;
} meshopt_layout;

/* Decodes a stream to count x stride bytes, to be freed. On failure returns NULL and *wrong, which
 * continues "the buffer view …". */
void *meshopt_decode(const meshopt_layout *layout, const unsigned char *data, size_t size,
                     const char **wrong);

#endif
