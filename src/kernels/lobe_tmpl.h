/* SPDX-License-Identifier: MIT */
/* lobe_tmpl.h - the response of a lobe to many lights at many points, O(bands) a light (lobe.h of
 * the API): s2/4 Σ_l (2l+1) lambda_l R_l(cos a) P_l(axis·w), with monic P_l up to
 * LMPI_TABLE_MONIC_BANDS. */
#ifndef LAMPION_KERNELS_LOBE_TMPL_H
#define LAMPION_KERNELS_LOBE_TMPL_H

#include "src/kernels/accumulate_tmpl.h"
#include "src/kernels/light.h"

/* Blocks of points that run side by side, because the recurrences of one wait for themselves. */
#define LOBE_BLOCKS (LMPI_LANES == 16 ? 3 : LMPI_LANES == 1 ? 1 : 2)

typedef struct lobe_block {
    vf point[3], axis[3], rgb[3];
} lobe_block;

/* Computes the factors of R_l P_l. */
static inline void lobe_weights(int bands, int monic, const float *lambda, float *weights) {
    for (int l = 0; l < bands; l++) {
        const double scale =
            monic ? (double)lmpi_table_norm[lmpi_table_index(l, 0)] / (double)lmpi_table_pole[l]
                  : 1;
        weights[l] = (float)((2 * l + 1) / 4.0 * (double)lambda[l] * scale);
    }
}

/* The recurrences of one light's cap in each block, and the sums of odd and of even bands, whose
 * signs differ inside a sphere. */
typedef struct lobe_sums {
    vf t[LOBE_BLOCKS], u[LOBE_BLOCKS], r[LOBE_BLOCKS], difference[LOBE_BLOCKS];
    vf p0[LOBE_BLOCKS], p1[LOBE_BLOCKS], odd[LOBE_BLOCKS], even[LOBE_BLOCKS];
} lobe_sums;

/* Begins a light's sums; returns whether some lane is inside, and then sets `sign` to that of the
 * even bands. */
LMPI_INLINE int lobe_begin(int bands, int blocks, const float *weights,
                           const lmpi_kernel_lights *lights, size_t light, const lobe_block *block,
                           lobe_sums *sums, vf sign[LOBE_BLOCKS]) {
    int inside = 0;
    LMPI_UNROLL for (int k = 0; k < blocks; k++) {
        const cap_lanes cap = lights_cap(lights, light, block[k].point, 0);
        const vf *axis = block[k].axis;
        sums->t[k] = cap.t;
        sums->u[k] = (axis[0] * cap.x + axis[1] * cap.y + axis[2] * cap.z) * cap.per_d;
        sums->r[k] = cap.s2;
        sums->difference[k] = vf_set(0);
        sums->p0[k] = vf_set(1);
        sums->p1[k] = sums->u[k];
        sums->odd[k] = (cap.t_full + cap.t_full) * weights[0];
        sums->even[k] = vf_set(0);
        if (bands > 1)
            sums->odd[k] = sums->odd[k] + weights[1] * (sums->r[k] * sums->u[k]);
        sign[k] = cap.even;
        inside |= cap.inside;
    }
    return inside;
}

/* Adds band l to `to`, the sums of its parity. */
LMPI_INLINE void lobe_band(int l, int monic, int blocks, const float *weights, lobe_sums *sums,
                           vf to[LOBE_BLOCKS]) {
    const float *cap_d = lmpi_table_cap_d, *cap_t = lmpi_table_cap_t;
    const float *legendre_d = lmpi_table_legendre_d, *legendre_t = lmpi_table_legendre_t;
    const float *square = lmpi_table_monic;
    LMPI_OPAQUE(cap_d);
    LMPI_OPAQUE(cap_t);
    LMPI_OPAQUE(square);
    LMPI_UNROLL for (int k = 0; k < blocks; k++) {
        const vf u = sums->u[k], p1 = sums->p1[k], p0 = sums->p0[k];
        sums->difference[k] = cap_d[l] * sums->difference[k] - cap_t[l] * sums->t[k] * sums->r[k];
        sums->r[k] = sums->r[k] + sums->difference[k];
        sums->p0[k] = p1;
        sums->p1[k] = monic ? u * p1 - square[l] * p0 : legendre_t[l] * u * p1 - legendre_d[l] * p0;
        to[k] = to[k] + weights[l] * (sums->r[k] * sums->p1[k]);
    }
}

/* Sums all bands, two per iteration, each into sums of its own. */
LMPI_INLINE void lobe_sum(int bands, int constant, int monic, int blocks, const float *weights,
                          lobe_sums *sums) {
    int l = 2;
    if (constant) {
        LMPI_UNROLL for (; l + 1 < bands; l += 2) {
            lobe_band(l, monic, blocks, weights, sums, sums->even);
            lobe_band(l + 1, monic, blocks, weights, sums, sums->odd);
        }
    } else {
        LMPI_ROLLED for (; l + 1 < bands; l += 2) {
            lobe_band(l, monic, blocks, weights, sums, sums->even);
            lobe_band(l + 1, monic, blocks, weights, sums, sums->odd);
        }
    }
    if (l < bands)
        lobe_band(l, monic, blocks, weights, sums, sums->even);
}

LMPI_INLINE void lobe_light(int bands, int constant, int monic, int blocks, const float *weights,
                            const lmpi_kernel_lights *lights, size_t light, lobe_block *block) {
    const lmp_rgb rgb = lights_radiance(lights, light);
    lobe_sums sums;
    vf sign[LOBE_BLOCKS];
    LMPI_OPAQUE(weights);
    const int inside = lobe_begin(bands, blocks, weights, lights, light, block, &sums, sign);
    lobe_sum(bands, constant, monic, blocks, weights, &sums);
    LMPI_UNROLL for (int k = 0; k < blocks; k++) {
        if (__builtin_expect(inside, 0))
            sums.even[k] = sums.even[k] * sign[k];
        const vf sum = sums.odd[k] + sums.even[k];
        block[k].rgb[0] = block[k].rgb[0] + rgb.r * sum;
        block[k].rgb[1] = block[k].rgb[1] + rgb.g * sum;
        block[k].rgb[2] = block[k].rgb[2] + rgb.b * sum;
    }
}

LMPI_INLINE void lobe_blocks(int bands, int constant, int monic, int blocks, const float *weights,
                             const lmpi_kernel_vec3 *axes, const lmpi_kernel_lights *lights,
                             const lmpi_kernel_vec3 *points, size_t element, size_t count,
                             const lmpi_kernel_out *out) {
    lobe_block block[LOBE_BLOCKS];
    LMPI_UNROLL for (int k = 0; k < blocks; k++) {
        const size_t e = element + (size_t)k * LMPI_LANES;
        block[k].point[0] = vf_load(points->x + e);
        block[k].point[1] = vf_load(points->y + e);
        block[k].point[2] = vf_load(points->z + e);
        block[k].axis[0] = vf_load(axes->x + e);
        block[k].axis[1] = vf_load(axes->y + e);
        block[k].axis[2] = vf_load(axes->z + e);
        LMPI_UNROLL for (int i = 0; i < 3; i++) block[k].rgb[i] = vf_set(0);
    }
    for (size_t light = 0; light < lights->count; light++)
        lobe_light(bands, constant, monic, blocks, weights, lights, light, block);
    LMPI_ROLLED for (int k = 0; k < blocks; k++) {
        const size_t e = element + (size_t)k * LMPI_LANES;
        layout_put((const float *)block[k].rgb, 0, 3, out, e, layout_live(count, e));
    }
}

LMPI_INLINE void lobe_bands(int bands, int constant, const float *weights,
                            const lmpi_kernel_vec3 *axes, const lmpi_kernel_lights *lights,
                            const lmpi_kernel_vec3 *points, size_t count,
                            const lmpi_kernel_out *out) {
    const size_t side = LOBE_BLOCKS * LMPI_LANES;
    for (size_t e = 0; e + side <= count; e += side) {
        if (constant || bands <= LMPI_TABLE_MONIC_BANDS)
            lobe_blocks(bands, constant, 1, LOBE_BLOCKS, weights, axes, lights, points, e, count,
                        out);
        else
            lobe_blocks(bands, 0, 0, LOBE_BLOCKS, weights, axes, lights, points, e, count, out);
    }
}

static void kernel_lobe(int bands, const float *lambda, const lmpi_kernel_vec3 *axes,
                        const lmpi_kernel_lights *lights, const lmpi_kernel_vec3 *points,
                        size_t count, const lmpi_kernel_out *out) {
    const size_t side = LOBE_BLOCKS * LMPI_LANES;
    float weights[LMP_BANDS_MAX];
    lobe_weights(bands, bands <= LMPI_TABLE_MONIC_BANDS, lambda, weights);
    BASIS_SPECIALISE(bands, lobe_bands, weights, axes, lights, points, count, out)
    for (size_t e = count / side * side; e < count; e += LMPI_LANES) {
        if (bands <= LMPI_TABLE_MONIC_BANDS)
            lobe_blocks(bands, 0, 1, 1, weights, axes, lights, points, e, count, out);
        else
            lobe_blocks(bands, 0, 0, 1, weights, axes, lights, points, e, count, out);
    }
}

#endif
