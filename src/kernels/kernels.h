/* SPDX-License-Identifier: MIT */
/* kernels.h - the batch kernels: one source, compiled once for each instruction set, and a table of
 * function pointers that picks one at run time.
 *
 * Every build does the same operations in the same order, contracts none of them to an FMA and
 * takes its quotients and roots from the IEEE instructions, so all give the same bits.
 *
 * Element arrays (`const float *`) are planar and readable up to the next multiple of
 * LMP_KERNEL_LANES_MAX elements; what is read past `count` must be finite, and is not used. */
#ifndef LAMPION_KERNELS_KERNELS_H
#define LAMPION_KERNELS_KERNELS_H

#include <lampion/base.h>

#define LMP_KERNEL_LANES_MAX 16

/* Value v of element e lies at at[e * stride + v], or at at[v * stride + e] if planar. */
typedef struct lmp_kernel_out {
    float *at;
    size_t stride;
    int planar;
} lmp_kernel_out;

typedef struct lmp_kernel_in {
    const float *at;
    size_t stride;
    int planar;
} lmp_kernel_in;

typedef struct lmp_kernel_vec3 {
    const float *x, *y, *z;
} lmp_kernel_vec3;

/* One sphere of radiance 1 an element. */
typedef struct lmp_kernel_pairs {
    lmp_kernel_vec3 center, point;
    const float *radius;
} lmp_kernel_pairs;

/* Spheres wherever the caller keeps them; radiance.x … z are red, green, blue. */
typedef struct lmp_kernel_lights {
    lmp_vec3_array center;
    lmp_float_array radius;
    lmp_vec3_array radiance;
    size_t count;
} lmp_kernel_lights;

typedef struct lmp_kernels {
    const char *name;
    int lanes;

    /* bands^2 values: Y_lm. */
    void (*eval)(int bands, const lmp_kernel_vec3 *directions, size_t count,
                 const lmp_kernel_out *out);
    /* One value: the dot product of two elements of `values` values. */
    void (*dot)(size_t values, const lmp_kernel_in *a, const lmp_kernel_in *b, size_t count,
                float *dots);
    /* bands^2 values, by the matrices of lmp_sh_rotation. */
    void (*rotate)(int bands, const float *matrices, const lmp_kernel_in *in, size_t count,
                   const lmp_kernel_out *out);
    /* `bands` values: Z_l (paper Eq. 12). */
    void (*zonal)(int bands, const float *radius, const float *distance, size_t count,
                  const lmp_kernel_out *out);
    /* bands^2 values: L_lm (paper Eq. 12 and 13). */
    void (*project)(int bands, const lmp_kernel_pairs *pairs, size_t count,
                    const lmp_kernel_out *out);
    /* 3 bands^2 values: the red, green and blue coefficients of the sum of the lights. */
    void (*accumulate)(int bands, const lmp_kernel_lights *lights, const lmp_kernel_vec3 *points,
                       size_t count, const lmp_kernel_out *out);
    /* The same, and 9 bands^2 values: their derivatives by x, then y, then z; |cos a| is held at
     * cos_min and up, for they are infinite on the sphere's surface. */
    void (*gradient)(int bands, const lmp_kernel_lights *lights, const lmp_kernel_vec3 *points,
                     float cos_min, size_t count, const lmp_kernel_out *out,
                     const lmp_kernel_out *gradient);
    /* 3 values: the response of a lobe round each point's axis to the lights. */
    void (*lobe)(int bands, const float *lambda, const lmp_kernel_vec3 *axes,
                 const lmp_kernel_lights *lights, const lmp_kernel_vec3 *points, size_t count,
                 const lmp_kernel_out *out);
} lmp_kernels;

/* Fills the table with the best build among `cpu_flags` (lmp_cpu_flag, base.h) that this library
 * and machine have; scalar when there is none. Returns the flag of the build taken. */
unsigned lmp_kernels_init(lmp_kernels *kernels, unsigned cpu_flags);

/* The table in use: what lmp_cpu_mask chose, else the best. */
const lmp_kernels *lmp_kernels_get(void);

#endif
