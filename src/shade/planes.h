/* SPDX-License-Identifier: MIT */
/* planes.h - the lobes of a chunk of surfaces in planes, as the kernels take them. */
#ifndef LAMPION_SHADE_PLANES_H
#define LAMPION_SHADE_PLANES_H

/* Planes of five lobes: a larger chunk would leave the stack that base.h promises. Code that is
 * to be debugged keeps more there; no result depends on it. */
#ifdef NDEBUG
#define LMP_BATCH 64
#else
#define LMP_BATCH 32
#endif

#include "src/kernels/batch.h"
#include "src/shade/material.h"

/* A Phong lobe of each surface, and what it has accumulated: red, green, blue. */
typedef struct shade_lobe_planes {
    lmp_batch_vec3 axis, weight;
    lmp_batch_plane exponent;
    lmp_batch_plane accumulated[3];
} shade_lobe_planes;

typedef struct shade_planes {
    lmp_batch_vec3 diffuse;
    lmp_batch_plane accumulated[3]; /* by the diffuse lobe, or by a BRDF */
    shade_lobe_planes lobe[LMP_KERNEL_LOBES_MAX];
} shade_planes;

/* Past the last index of a chunk's surfaces, that one again: kernels read whole registers. */
static inline void lmp_shade_fill(size_t *at, size_t count) {
    for (size_t i = count; i % LMP_KERNEL_LANES_MAX; i++)
        at[i] = at[count - 1];
}

/* Vectors of surfaces at[0 … count-1], which are filled: where they are, if those are in a row, or
 * in these planes. */
lmp_kernel_vec3 lmp_shade_vectors(const lmp_vec3_array *array, const size_t *at, size_t count,
                                  bool in_a_row, lmp_batch_vec3 *planes);

/* The lobes of the surfaces at[0 … count-1], `lobes` Phong ones each; what they accumulate
 * is not set. */
void lmp_shade_load(const lmp_surfaces *surfaces, const size_t *at, size_t count, int lobes,
                    const lmp_kernel_vec3 *normal, const lmp_kernel_vec3 *view,
                    shade_planes *planes);

/* What the lobes have accumulated and ambient light, weighted: into what the diffuse one has. */
void lmp_shade_sum_planes(size_t count, int lobes, const float ambient[3], shade_planes *planes);

/* What the diffuse lobe has, clamped at 0, as the colors of the surfaces at[0 … count-1]. */
void lmp_shade_store(const shade_planes *planes, const size_t *at, size_t count, size_t stride,
                     float *rgb);

#endif
