/* SPDX-License-Identifier: MIT */
/* lobe.h - kernels that compute with lobes of surfaces. */
#ifndef LAMPION_KERNELS_LOBE_H
#define LAMPION_KERNELS_LOBE_H

#include "src/kernels/light.h"

#define LMPI_KERNEL_LOBES_MAX 5

/* A Phong lobe per surface. */
typedef struct lmpi_kernel_lobe {
    lmpi_kernel_vec3 axis;
    const float *exponent;
} lmpi_kernel_lobe;

/* The table of GGX's lobes (lmpi_ggx_table): rows over roughness_min … 1 of nodes over the square
 * root of the view's cosine, each with LMPI_KERNEL_LOBES_MAX lobes of four parameters, and what the
 * base loses, by view. lmpi_kernel_ggx_lobe holds the planes of a lobe. */
typedef struct lmpi_kernel_ggx {
    const float *nodes, *diffuse;
    int views, roughnesses;
    float roughness_min;
} lmpi_kernel_ggx;

typedef struct lmpi_kernel_ggx_lobe {
    float *axis[3], *exponent, *f0, *f90;
} lmpi_kernel_ggx_lobe;

typedef struct lmpi_lobe_kernels {
    /* Computes the first `lobes` lobes of each surface, in whole registers. */
    void (*ggx)(const lmpi_kernel_ggx *table, const lmpi_kernel_vec3 *normal,
                const lmpi_kernel_vec3 *view, const float *roughness, size_t count, int lobes,
                const lmpi_kernel_ggx_lobe *to, float *diffuse_f90);
    /* Computes 3 values: the response of a lobe around each point's axis to the lights. */
    void (*response)(int bands, const float *lambda, const lmpi_kernel_vec3 *axes,
                     const lmpi_kernel_lights *lights, const lmpi_kernel_vec3 *points, size_t count,
                     const lmpi_kernel_out *out);
} lmpi_lobe_kernels;

#endif
