/* SPDX-License-Identifier: MIT */
/* lobe.h - the response of a lobe to many lights at many points, O(bands) a light (lobe.h of the
 * API): s2/4 Σ_l (2l+1) lambda_l R_l(cos a) P_l(axis·w), with monic P_l up to
 * LMP_TABLE_MONIC_BANDS. */
#ifndef LAMPION_KERNELS_LOBE_H
#define LAMPION_KERNELS_LOBE_H

#include "src/kernels/accumulate.h"

/* Blocks of points that run side by side: the recurrences of one wait for themselves. */
#define LOBE_BLOCKS (LMP_LANES == 16 ? 3 : LMP_LANES == 1 ? 1 : 2)

typedef struct lobe_block {
    vf point[3], axis[3], rgb[3];
} lobe_block;

/* The factors of R_l P_l. */
static inline void lobe_weights(int bands, int monic, const float *lambda, float *weights) {
    for (int l = 0; l < bands; l++) {
        const double scale =
            monic ? (double)lmp_table_norm[lmp_table_index(l, 0)] / (double)lmp_table_pole[l] : 1;
        weights[l] = (float)((2 * l + 1) / 4.0 * (double)lambda[l] * scale);
    }
}

LMP_INLINE void lobe_light(int bands, int monic, int blocks, const float *weights,
                           const lmp_kernel_lights *lights, size_t light, lobe_block *block) {
    vf t[LOBE_BLOCKS], u[LOBE_BLOCKS], r[LOBE_BLOCKS], difference[LOBE_BLOCKS], p0[LOBE_BLOCKS];
    vf p1[LOBE_BLOCKS], sign[LOBE_BLOCKS], odd[LOBE_BLOCKS], even[LOBE_BLOCKS];
    const lmp_rgb rgb = lights_radiance(lights, light);
    const float *cap_d = lmp_table_cap_d, *cap_t = lmp_table_cap_t;
    const float *legendre_d = lmp_table_legendre_d, *legendre_t = lmp_table_legendre_t;
    const float *square = lmp_table_monic;
    LMP_OPAQUE(cap_d);
    LMP_OPAQUE(cap_t);
    LMP_OPAQUE(square);
    LMP_OPAQUE(weights);
    int inside = 0;
    LMP_UNROLL for (int k = 0; k < blocks; k++) {
        const cap_lanes cap = lights_cap(lights, light, block[k].point, 0);
        const vf *axis = block[k].axis;
        t[k] = cap.t;
        u[k] = (axis[0] * cap.x + axis[1] * cap.y + axis[2] * cap.z) * cap.per_d;
        r[k] = cap.s2;
        difference[k] = vf_set(0);
        sign[k] = cap.even;
        inside |= cap.inside;
        p0[k] = vf_set(1);
        p1[k] = u[k];
        odd[k] = (cap.t_full + cap.t_full) * weights[0];
        even[k] = vf_set(0);
        if (bands > 1)
            odd[k] = odd[k] + weights[1] * (r[k] * u[k]);
    }
    LMP_UNROLL for (int l = 2; l < bands; l++) {
        LMP_UNROLL for (int k = 0; k < blocks; k++) {
            difference[k] = cap_d[l] * difference[k] - cap_t[l] * t[k] * r[k];
            r[k] = r[k] + difference[k];
            const vf p2 = monic ? u[k] * p1[k] - square[l] * p0[k]
                                : legendre_t[l] * u[k] * p1[k] - legendre_d[l] * p0[k];
            p0[k] = p1[k];
            p1[k] = p2;
            if (l % 2)
                odd[k] = odd[k] + weights[l] * (r[k] * p2);
            else
                even[k] = even[k] + weights[l] * (r[k] * p2);
        }
    }
    LMP_UNROLL for (int k = 0; k < blocks; k++) {
        if (__builtin_expect(inside, 0))
            even[k] = even[k] * sign[k];
        const vf sum = odd[k] + even[k];
        block[k].rgb[0] = block[k].rgb[0] + rgb.r * sum;
        block[k].rgb[1] = block[k].rgb[1] + rgb.g * sum;
        block[k].rgb[2] = block[k].rgb[2] + rgb.b * sum;
    }
}

LMP_INLINE void lobe_blocks(int bands, int monic, int blocks, const float *weights,
                            const lmp_kernel_vec3 *axes, const lmp_kernel_lights *lights,
                            const lmp_kernel_vec3 *points, size_t element, size_t count,
                            const lmp_kernel_out *out) {
    lobe_block block[LOBE_BLOCKS];
    LMP_UNROLL for (int k = 0; k < blocks; k++) {
        const size_t e = element + (size_t)k * LMP_LANES;
        block[k].point[0] = vf_load(points->x + e);
        block[k].point[1] = vf_load(points->y + e);
        block[k].point[2] = vf_load(points->z + e);
        block[k].axis[0] = vf_load(axes->x + e);
        block[k].axis[1] = vf_load(axes->y + e);
        block[k].axis[2] = vf_load(axes->z + e);
        LMP_UNROLL for (int i = 0; i < 3; i++) block[k].rgb[i] = vf_set(0);
    }
    for (size_t light = 0; light < lights->count; light++)
        lobe_light(bands, monic, blocks, weights, lights, light, block);
    LMP_ROLLED for (int k = 0; k < blocks; k++) {
        const size_t e = element + (size_t)k * LMP_LANES;
        layout_put((const float *)block[k].rgb, 0, 3, out, e, layout_live(count, e));
    }
}

LMP_INLINE void lobe_bands(int bands, int constant, const float *weights,
                           const lmp_kernel_vec3 *axes, const lmp_kernel_lights *lights,
                           const lmp_kernel_vec3 *points, size_t count, const lmp_kernel_out *out) {
    const size_t side = LOBE_BLOCKS * LMP_LANES;
    for (size_t e = 0; e + side <= count; e += side) {
        if (constant || bands <= LMP_TABLE_MONIC_BANDS)
            lobe_blocks(bands, 1, LOBE_BLOCKS, weights, axes, lights, points, e, count, out);
        else
            lobe_blocks(bands, 0, LOBE_BLOCKS, weights, axes, lights, points, e, count, out);
    }
}

static void kernel_lobe(int bands, const float *lambda, const lmp_kernel_vec3 *axes,
                        const lmp_kernel_lights *lights, const lmp_kernel_vec3 *points,
                        size_t count, const lmp_kernel_out *out) {
    const size_t side = LOBE_BLOCKS * LMP_LANES;
    float weights[LMP_BANDS_MAX];
    lobe_weights(bands, bands <= LMP_TABLE_MONIC_BANDS, lambda, weights);
    BASIS_SPECIALISE(bands, lobe_bands, weights, axes, lights, points, count, out)
    for (size_t e = count / side * side; e < count; e += LMP_LANES) {
        if (bands <= LMP_TABLE_MONIC_BANDS)
            lobe_blocks(bands, 1, 1, weights, axes, lights, points, e, count, out);
        else
            lobe_blocks(bands, 0, 1, weights, axes, lights, points, e, count, out);
    }
}

#endif
