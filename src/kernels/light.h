/* SPDX-License-Identifier: MIT */
/* light.h - kernels that compute the coefficients of lights. */
#ifndef LAMPION_KERNELS_LIGHT_H
#define LAMPION_KERNELS_LIGHT_H

#include "src/kernels/arrays.h"
#include "src/kernels/packed_light.h"

/* Pairs of a sphere of radiance 1 and a point, one per element. */
typedef struct lmpi_kernel_pairs {
    lmpi_kernel_vec3 center, point;
    const float *radius;
} lmpi_kernel_pairs;

/* Spheres in the caller's memory; radiance.x … z are red, green, blue. A radius of LMPI_DIRAC makes
 * a Dirac at the center, whose intensity is in radiance. */
typedef struct lmpi_kernel_lights {
    lmp_vec3_array center;
    lmp_float_array radius;
    lmp_vec3_array radiance;
    size_t count;
    /* For sums of lights, the fraction of light i that reaches point p is at [i * stride + p]; NULL
     * means that all does. */
    const float *visibility;
    size_t visibility_stride;
    int adds; /* set by accumulate_more alone */
} lmpi_kernel_lights;

/* Fading of lights toward their surfaces over a distance of 1/per_reach (src/kernels/fade_tmpl.h).
 * With per_outer above 0, lights also lose what remains of them when they fade over 1/per_outer. */
typedef struct lmpi_kernel_fade {
    float per_reach, per_outer;
} lmpi_kernel_fade;

typedef struct lmpi_light_kernels {
    /* Computes `bands` values, Z_l (paper Eq. 12). */
    void (*zonal)(int bands, const float *radius, const float *distance, size_t count,
                  const lmpi_kernel_out *out);
    /* Computes bands^2 values, L_lm (paper Eq. 12 and 13). */
    void (*project)(int bands, const lmpi_kernel_pairs *pairs, size_t count,
                    const lmpi_kernel_out *out);
    /* Does project with up to LMPI_KERNEL_STREAM_VALUES_MAX values, stored past the caches. */
    void (*project_streamed)(int bands, const lmpi_kernel_pairs *pairs, size_t count,
                             const lmpi_kernel_out *out);
    /* Computes 3 bands^2 values: the red, green and blue coefficients of the sum of the lights. */
    void (*accumulate)(const lmp_scratch *scratch, int bands, const lmpi_kernel_lights *lights,
                       const lmpi_kernel_vec3 *points, size_t count, const lmpi_kernel_out *out);
    /* Does accumulate, and adds the sum to what the output holds. */
    void (*accumulate_more)(const lmp_scratch *scratch, int bands, const lmpi_kernel_lights *lights,
                            const lmpi_kernel_vec3 *points, size_t count,
                            const lmpi_kernel_out *out);
    /* Adds values to the output from value `first` on, times each element's factor. */
    void (*add)(const float *sh, size_t first, size_t values, const float *factors, size_t count,
                const lmpi_kernel_out *out);
    /* Multiplies whole registers of factors by the fraction of a cone's light that reaches the
     * points. */
    void (*cone)(const lmpi_packed_light *cone, const lmpi_kernel_vec3 *points, size_t count,
                 float *factors);
    /* Does accumulate, and computes 9 bands^2 values: derivatives by x, then y, then z. |cos a| is
     * clamped to at least cos_min, because they are infinite on the sphere's surface. */
    void (*gradient)(const lmp_scratch *scratch, int bands, const lmpi_kernel_lights *lights,
                     const lmpi_kernel_vec3 *points, float cos_min, size_t count,
                     const lmpi_kernel_out *out, const lmpi_kernel_out *gradient);
    /* Does gradient with lights that fade. */
    void (*fading_gradient)(const lmp_scratch *scratch, int bands, const lmpi_kernel_lights *lights,
                            const lmpi_kernel_vec3 *points, float cos_min, lmpi_kernel_fade fade,
                            size_t count, const lmpi_kernel_out *out,
                            const lmpi_kernel_out *gradient);
} lmpi_light_kernels;

#endif
