/* SPDX-License-Identifier: MIT */
/* sh.h - kernels of spherical harmonics, independent of lights and surfaces. */
#ifndef LAMPION_KERNELS_SH_H
#define LAMPION_KERNELS_SH_H

#include "src/kernels/arrays.h"

/* Texels of up to LMPI_KERNEL_CHANNELS channels: the direction of each, and its values times its
 * solid angle, 0 for those past the last. */
#define LMPI_KERNEL_TEXELS   256
#define LMPI_KERNEL_CHANNELS 4
typedef struct lmpi_kernel_texels {
    lmpi_kernel_vec3 direction;
    const float *value[LMPI_KERNEL_CHANNELS];
    int channels;
} lmpi_kernel_texels;

/* Sums of texels: the coefficients (l, m) and (l, -m) of a few orders m. */
#define LMPI_KERNEL_ORDERS 3
typedef struct lmpi_kernel_texel_sums {
    double cosine[LMPI_KERNEL_ORDERS][LMPI_KERNEL_CHANNELS][LMP_BANDS_MAX];
    double sine[LMPI_KERNEL_ORDERS][LMPI_KERNEL_CHANNELS][LMP_BANDS_MAX];
} lmpi_kernel_texel_sums;

typedef struct lmpi_sh_kernels {
    /* Evaluates bands^2 values, Y_lm. */
    void (*eval)(int bands, const lmpi_kernel_vec3 *directions, size_t count,
                 const lmpi_kernel_out *out);
    /* Does eval with up to LMPI_KERNEL_STREAM_VALUES_MAX values, stored past the caches where the
     * instruction set can; other threads see them after lmpi_batch_fence. */
    void (*eval_streamed)(int bands, const lmpi_kernel_vec3 *directions, size_t count,
                          const lmpi_kernel_out *out);
    /* Does eval, and computes 3 bands^2 values: derivatives along the sphere by x, then y, then z.
     */
    void (*eval_gradient)(int bands, const lmpi_kernel_vec3 *directions, size_t count,
                          const lmpi_kernel_out *out, const lmpi_kernel_out *gradient);
    /* Computes one value, the dot product of two elements of `values` values. */
    void (*dot)(size_t values, const lmpi_kernel_in *a, const lmpi_kernel_in *b, size_t count,
                float *dots);
    /* Rotates bands^2 values by the matrices of lmp_sh_make_rotation. */
    void (*rotate)(int bands, const float *matrices, const lmpi_kernel_in *in, size_t count,
                   const lmpi_kernel_out *out);
    /* Computes 3 values: the functions of three planes of coefficients in these directions, band l
     * times factors[l] and, where exponents are given, times that of a Phong lobe of integral 1. */
    void (*reconstruct)(int bands, const float *factors, const float *exponents,
                        const float *const planes[3], const lmpi_kernel_vec3 *directions,
                        size_t count, const lmpi_kernel_out *out);
    /* Adds up to LMPI_KERNEL_TEXELS texels to the sums of orders m … m+orders-1. */
    void (*image)(int bands, int m, int orders, const lmpi_kernel_texels *texels, size_t count,
                  lmpi_kernel_texel_sums *sums);
} lmpi_sh_kernels;

#endif
