/* SPDX-License-Identifier: MIT */
/* planes.h - the lobes of a chunk of surfaces in planes, as the kernels take them. */
#ifndef LAMPION_SHADE_PLANES_H
#define LAMPION_SHADE_PLANES_H

#include "src/kernels/batch.h"
#include "src/lobe/ggx.h"
#include "src/shade/material.h"

/* Planes of a chunk, for points, normals, views, diffuse weights and sums; and planes of each lobe.
 */
enum { SHADE_PLANES = 15, SHADE_LOBE_PLANES = 10 };

/* Floats of all planes, by the stack that base.h promises. Debug builds keep more on the stack
 * themselves; no result depends on the number. */
#ifdef NDEBUG
#define SHADE_FLOATS 3328
#else
#define SHADE_FLOATS 1664
#endif

/* Surfaces of a chunk: as many whole registers as the planes of their lobes leave room for. */
#define SHADE_FIT(lobes)                                                                           \
    (SHADE_FLOATS / (SHADE_PLANES + (lobes)*SHADE_LOBE_PLANES) / LMPI_KERNEL_LANES_MAX *           \
     LMPI_KERNEL_LANES_MAX)
enum {
    SHADE_SURFACES_MIN = SHADE_FIT(LMPI_KERNEL_LOBES_MAX),
    SHADE_SURFACES_GGX = SHADE_FIT(LMP_GGX_LOBES_FEW), /* the most with GGX lobes */
    SHADE_SURFACES_MAX = SHADE_FIT(1)                  /* the most with one lobe or none */
};

/* A Phong lobe of each surface, and the red, green, blue it has accumulated. */
typedef struct shade_lobe_planes {
    lmpi_batch_vec3 axis, weight;
    float *exponent, *accumulated[3];
} shade_lobe_planes;

typedef struct shade_planes {
    lmpi_batch_vec3 point, normal, view, diffuse;
    float *accumulated[3]; /* by the diffuse lobe, or by a BRDF; planes follow one another */
    size_t stride;         /* floats from plane to plane */
    shade_lobe_planes lobe[LMPI_KERNEL_LOBES_MAX];
    float memory[SHADE_FLOATS] __attribute__((aligned(64)));
} shade_planes;

/* Returns how many surfaces with `lobes` lobes a chunk takes. */
static inline size_t lmpi_shade_capacity(int lobes) {
    const size_t fit = (size_t)SHADE_FIT(lobes);
    return fit < SHADE_SURFACES_MAX ? fit : SHADE_SURFACES_MAX;
}

/* Divides the memory among the planes of `lobes` lobes. */
void lmpi_shade_divide(int lobes, shade_planes *planes);

/* Repeats the last index past the end of a chunk's surfaces, because kernels read whole registers.
 */
static inline void lmpi_shade_fill(size_t *at, size_t count) {
    for (size_t i = count; i % LMPI_KERNEL_LANES_MAX; i++)
        at[i] = at[count - 1];
}

/* Returns the vectors of surfaces at[0 … count-1], which must be filled: in place if the indices
 * are consecutive, else copied to `planes`. */
lmpi_kernel_vec3 lmpi_shade_vectors(const lmp_vec3_array *array, const size_t *at, size_t count,
                                    bool in_a_row, lmpi_batch_vec3 planes);

/* Loads the lobes of the surfaces at[0 … count-1], `lobes` Phong lobes each; what they accumulate
 * is not set. */
void lmpi_shade_load(const lmp_surfaces *surfaces, const size_t *at, size_t count, int lobes,
                     const lmpi_kernel_vec3 *normal, const lmpi_kernel_vec3 *view,
                     shade_planes *planes);

/* Adds the weighted sums of the lobes, and ambient light, to the planes of the diffuse lobe. */
void lmpi_shade_sum_planes(size_t count, int lobes, const float ambient[3], shade_planes *planes);

/* Stores the diffuse lobe's planes, clamped at 0, as the colors of the surfaces at[0 … count-1]. */
void lmpi_shade_store(const shade_planes *planes, const size_t *at, size_t count, size_t stride,
                      float *rgb);

#endif
