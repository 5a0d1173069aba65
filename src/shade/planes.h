/* SPDX-License-Identifier: MIT */
/* planes.h - the lobes of a chunk of surfaces in planes, as the kernels take them. */
#ifndef LAMPION_SHADE_PLANES_H
#define LAMPION_SHADE_PLANES_H

#include "src/kernels/batch.h"
#include "src/lobe/ggx.h"
#include "src/shade/material.h"

/* Planes of a chunk: of points, normals, views, diffuse weights and sums; and of a lobe. */
enum { SHADE_PLANES = 15, SHADE_LOBE_PLANES = 10 };

/* Floats of all planes, for the stack that base.h promises. Code that is to be debugged keeps more
 * there; no result depends on it. */
#ifdef NDEBUG
#define SHADE_FLOATS 3328
#else
#define SHADE_FLOATS 1664
#endif

/* Surfaces of a chunk: as many as planes of their lobes fit, in whole registers. */
#define SHADE_FIT(lobes)                                                                           \
    (SHADE_FLOATS / (SHADE_PLANES + (lobes)*SHADE_LOBE_PLANES) / LMP_KERNEL_LANES_MAX *            \
     LMP_KERNEL_LANES_MAX)
enum {
    SHADE_SURFACES_MIN = SHADE_FIT(LMP_KERNEL_LOBES_MAX),
    SHADE_SURFACES_GGX = SHADE_FIT(LMP_GGX_LOBES_FEW), /* at most */
    SHADE_SURFACES_MAX = SHADE_FIT(1)                  /* and of none */
};

/* A Phong lobe of each surface, and what it has accumulated: red, green, blue. */
typedef struct shade_lobe_planes {
    lmp_batch_vec3 axis, weight;
    float *exponent, *accumulated[3];
} shade_lobe_planes;

typedef struct shade_planes {
    lmp_batch_vec3 point, normal, view, diffuse;
    float *accumulated[3]; /* by the diffuse lobe, or by a BRDF; one after the other */
    size_t stride;         /* from plane to plane */
    shade_lobe_planes lobe[LMP_KERNEL_LOBES_MAX];
    float memory[SHADE_FLOATS] __attribute__((aligned(64)));
} shade_planes;

/* Surfaces with so many lobes that a chunk takes. */
static inline size_t lmp_shade_capacity(int lobes) {
    const size_t fit = (size_t)SHADE_FIT(lobes);
    return fit < SHADE_SURFACES_MAX ? fit : SHADE_SURFACES_MAX;
}

/* Divides the memory among planes of so many lobes. */
void lmp_shade_divide(int lobes, shade_planes *planes);

/* Past the last index of a chunk's surfaces, that one again: kernels read whole registers. */
static inline void lmp_shade_fill(size_t *at, size_t count) {
    for (size_t i = count; i % LMP_KERNEL_LANES_MAX; i++)
        at[i] = at[count - 1];
}

/* Vectors of surfaces at[0 … count-1], which are filled: where they are, if those are in a row, or
 * in these planes. */
lmp_kernel_vec3 lmp_shade_vectors(const lmp_vec3_array *array, const size_t *at, size_t count,
                                  bool in_a_row, lmp_batch_vec3 planes);

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
