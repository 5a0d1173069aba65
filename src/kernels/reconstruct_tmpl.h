/* SPDX-License-Identifier: MIT */
/* reconstruct_tmpl.h - evaluates functions given by their coefficients in many directions: lanes
 * are directions, coefficients are broadcast. What a lobe receives of such a function is the same
 * sum, each band times the lobe's factor lambda_l. */
#ifndef LAMPION_KERNELS_RECONSTRUCT_TMPL_H
#define LAMPION_KERNELS_RECONSTRUCT_TMPL_H

#include "src/kernels/basis_tmpl.h"
#include "src/kernels/sh.h"

/* Blocks that run side by side, because the recurrences of one wait for themselves. */
#define RECONSTRUCT_BLOCKS (LMPI_LANES == 16 ? 2 : 1)

/* Factors below this count as 0: beside band 0, whose factor is about 1, they leave nothing, and
 * only narrow lobes need many bands. */
#define RECONSTRUCT_FACTOR_MIN 7.450580597e-9f

typedef struct reconstruct_block {
    vf axis[3], c, s, rgb[3];
    const vf *factor; /* factors of Phong lobes, windowed; may be NULL */
} reconstruct_block;

/* Computes lambda_l = lambda_(l-2) (e - l + 2) / (e + l + 1), of the lobe of integral 1. Returns
 * how many bands some lane needs. */
LMPI_INLINE int reconstruct_phong(int bands, const float *factors, vf exponent, vf *factor) {
    const vf least = vf_set(RECONSTRUCT_FACTOR_MIN), zero = vf_set(0), one = vf_set(1);
    vf before = vf_set(1), lambda = (exponent + 1) / (exponent + 2);
    int needed = 1;
    factor[0] = before * factors[0];
    LMPI_ROLLED for (int l = 1; l < bands; l++) {
        const vf value = lambda * factors[l], size = vf_max(value, zero - value);
        factor[l] = vf_select_less(size, least, zero, value);
        if (vf_any_less(zero, vf_select_less(size, least, zero, one)))
            needed = l + 1;
        const vf next = before * ((exponent - (float)(l - 1)) / (exponent + (float)(l + 2)));
        before = lambda;
        lambda = next;
    }
    return needed;
}

/* Returns coefficient i of a plane times `value`. With `own` > 0, the distance between
 * coefficients, each lane has a function of its own. */
LMPI_INLINE vf reconstruct_term(const float *plane, size_t own, size_t i, vf value) {
    return own > 0 ? vf_load(plane + i * own) * value : plane[i] * value;
}

/* Adds column m: the sums of the coefficients (l, m) and (l, -m) along it, times C_m and S_m. */
LMPI_INLINE void reconstruct_column(int bands, int m, int phong, size_t own, int blocks,
                                    const float *factors, const float *const planes[3],
                                    reconstruct_block *block) {
    vf q0[RECONSTRUCT_BLOCKS], q1[RECONSTRUCT_BLOCKS];
    vf cosine[RECONSTRUCT_BLOCKS][3], sine[RECONSTRUCT_BLOCKS][3];
    LMPI_UNROLL for (int k = 0; k < blocks; k++) {
        q0[k] = vf_set(0);
        q1[k] = vf_set(lmpi_table_diagonal[m]);
        LMPI_UNROLL for (int i = 0; i < 3; i++) cosine[k][i] = sine[k][i] = vf_set(0);
    }
    LMPI_UNROLL for (int l = m; l < bands; l++) {
        const size_t middle = (size_t)(l * l + l);
        LMPI_UNROLL for (int k = 0; k < blocks; k++) {
            if (l > m) {
                const vf q2 =
                    basis_step(lmpi_table_a, lmpi_table_b, l, m, block[k].axis[2], q1[k], q0[k]);
                q0[k] = q1[k];
                q1[k] = q2;
            }
            if (!phong && factors[l] == 0)
                continue; /* every other factor of a diffuse lobe is 0 */
            const vf value = phong ? q1[k] * block[k].factor[l] : q1[k] * factors[l];
            LMPI_UNROLL for (int i = 0; i < 3; i++) {
                cosine[k][i] =
                    cosine[k][i] + reconstruct_term(planes[i], own, middle + (size_t)m, value);
                if (m > 0)
                    sine[k][i] =
                        sine[k][i] + reconstruct_term(planes[i], own, middle - (size_t)m, value);
            }
        }
    }
    LMPI_UNROLL for (int k = 0; k < blocks; k++) LMPI_UNROLL for (int i = 0; i < 3; i++) block[k]
        .rgb[i] = block[k].rgb[i] +
                  (m > 0 ? cosine[k][i] * block[k].c + sine[k][i] * block[k].s : cosine[k][i]);
}

/* Evaluates some blocks. factor is memory for their factors, or NULL where the lobes are not Phong
 * lobes. */
LMPI_INLINE void reconstruct_blocks(int bands, int constant, int blocks,
                                    vf (*factor)[LMP_BANDS_MAX], const float *factors,
                                    const float *exponents, const float *const planes[3],
                                    const lmpi_kernel_vec3 *axes, size_t element, size_t count,
                                    const lmpi_kernel_out *out) {
    reconstruct_block block[RECONSTRUCT_BLOCKS];
    int needed = factor && !constant ? 1 : bands;
    LMPI_UNROLL for (int k = 0; k < blocks; k++) {
        const size_t e = element + (size_t)k * LMPI_LANES;
        block[k].axis[0] = vf_load(axes->x + e);
        block[k].axis[1] = vf_load(axes->y + e);
        block[k].axis[2] = vf_load(axes->z + e);
        block[k].c = vf_set(1);
        block[k].s = vf_set(0);
        LMPI_UNROLL for (int i = 0; i < 3; i++) block[k].rgb[i] = vf_set(0);
        if (factor) {
            const int some = reconstruct_phong(bands, factors, vf_load(exponents + e), factor[k]);
            needed = some > needed ? some : needed;
            block[k].factor = factor[k];
        }
    }
    LMPI_UNROLL for (int m = 0; m < needed; m++) {
        LMPI_UNROLL for (int k = 0; m > 0 && k < blocks; k++)
            basis_rotate(m, block[k].axis[0], block[k].axis[1], &block[k].c, &block[k].s);
        reconstruct_column(needed, m, factor != NULL, 0, blocks, factors, planes, block);
    }
    LMPI_ROLLED for (int k = 0; k < blocks; k++) {
        const size_t e = element + (size_t)k * LMPI_LANES;
        layout_put((const float *)block[k].rgb, 0, 3, out, e, layout_live(count, e));
    }
}

LMPI_INLINE void reconstruct_bands(int bands, int constant, vf (*factor)[LMP_BANDS_MAX],
                                   const float *factors, const float *exponents,
                                   const float *const planes[3], const lmpi_kernel_vec3 *axes,
                                   size_t count, const lmpi_kernel_out *out) {
    const size_t side = RECONSTRUCT_BLOCKS * LMPI_LANES;
    size_t e = 0;
    for (; e + side <= count; e += side)
        reconstruct_blocks(bands, constant, RECONSTRUCT_BLOCKS, factor, factors, exponents, planes,
                           axes, e, count, out);
    LMPI_ROLLED for (; e < count; e += LMPI_LANES) reconstruct_blocks(
        bands, constant, 1, factor, factors, exponents, planes, axes, e, count, out);
}

static LMPI_NOINLINE void reconstruct_lobes(int bands, const float *factors, const float *exponents,
                                            const float *const planes[3],
                                            const lmpi_kernel_vec3 *axes, size_t count,
                                            const lmpi_kernel_out *out) {
    vf factor[RECONSTRUCT_BLOCKS][LMP_BANDS_MAX];
    BASIS_SPECIALISE(bands, reconstruct_bands, factor, factors, exponents, planes, axes, count, out)
}

static LMPI_NOINLINE void reconstruct_same(int bands, const float *factors,
                                           const float *const planes[3],
                                           const lmpi_kernel_vec3 *axes, size_t count,
                                           const lmpi_kernel_out *out) {
    BASIS_SPECIALISE(bands, reconstruct_bands, NULL, factors, NULL, planes, axes, count, out)
}

static void kernel_reconstruct(int bands, const float *factors, const float *exponents,
                               const float *const planes[3], const lmpi_kernel_vec3 *axes,
                               size_t count, const lmpi_kernel_out *out) {
    if (exponents)
        reconstruct_lobes(bands, factors, exponents, planes, axes, count, out);
    else
        reconstruct_same(bands, factors, planes, axes, count, out);
}

#endif
