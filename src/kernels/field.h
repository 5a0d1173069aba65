/* SPDX-License-Identifier: MIT */
/* field.h - a field of coefficients at many points, and what lobes receive there.
 *
 * Adini's interpolation takes the value and the three slopes of each corner of a cell. In every
 * axis, s from 0 to 1 along an edge h, the corner on side 0 or 1 has
 *
 *     linear   1 - s, s        bend   -+ (s² (3 - 2s) - s)       slope   h s (1-s)², -h s² (1-s)
 *
 * and its weights are  l l l + b l l + l b l + l l b  of the value,  t l l  of d/dx and so on.
 * Points are lanes of the weights; then, point by point, lanes are coefficients, for 32 rows are
 * added up and no lane needs another. */
#ifndef LAMPION_KERNELS_FIELD_H
#define LAMPION_KERNELS_FIELD_H

#include "src/kernels/reconstruct.h"

#define FIELD_WEIGHTS 32

/* Vectors of coefficients that are summed side by side. */
#define FIELD_WIDTH 4

typedef struct field_axis {
    vf linear[2], bend[2], slope[2];
} field_axis;

LMP_INLINE field_axis field_along(const float *fractions, float edge) {
    const vf s = vf_load(fractions), rest = vf_set(1) - s;
    const vf bend = s * s * (3.0f - (s + s)) - s, both = edge * (s * rest);
    return (field_axis) { { rest, s }, { vf_set(0) - bend, bend }, { both * rest, -(both * s) } };
}

/* Of corner k those of the value and of its slopes, at weights + 4 k LMP_LANES. */
LMP_INLINE void field_weights(const lmp_kernel_cells *cells, size_t e, float *weights) {
    const field_axis x = field_along(cells->fraction.x + e, cells->cell.x);
    const field_axis y = field_along(cells->fraction.y + e, cells->cell.y);
    const field_axis z = field_along(cells->fraction.z + e, cells->cell.z);
    LMP_UNROLL for (int k = 0; k < 8; k++) {
        const int i = k & 1, j = k >> 1 & 1, n = k >> 2;
        const vf yz = y.linear[j] * z.linear[n], xz = x.linear[i] * z.linear[n];
        const vf xy = x.linear[i] * y.linear[j];
        float *to = weights + 4 * k * LMP_LANES;
        vf_store(to, (x.linear[i] + x.bend[i]) * yz + y.bend[j] * xz + z.bend[n] * xy);
        vf_store(to + LMP_LANES, x.slope[i] * yz);
        vf_store(to + 2 * LMP_LANES, y.slope[j] * xz);
        vf_store(to + 3 * LMP_LANES, z.slope[n] * xy);
    }
}

/* Coefficients at + 0 … of one point: `width` vectors, or with `last` > 0 so many of one. */
LMP_INLINE void field_sum(int width, int last, size_t values, const float *const rows[8], size_t at,
                          const float *weights, float *to) {
    vf sum[FIELD_WIDTH];
    LMP_UNROLL for (int j = 0; j < width; j++) sum[j] = vf_set(0);
    LMP_ROLLED for (int k = 0; k < 8; k++) LMP_UNROLL for (int q = 0; q < 4; q++) {
        const float weight = weights[(4 * k + q) * LMP_LANES];
        const float *row = rows[k] + (size_t)q * values + at;
        LMP_UNROLL for (int j = 0; j < width; j++) sum[j] =
            sum[j] + weight * (last > 0 ? vf_load_first(row, last) : vf_load(row + j * LMP_LANES));
    }
    if (last > 0)
        vf_store_first(to + at, sum[0], last);
    else
        LMP_UNROLL for (int j = 0; j < width; j++) vf_store(to + at + j * LMP_LANES, sum[j]);
}

/* Coefficients at … at + count - 1 of one point, whole vectors but for the last. */
LMP_INLINE void field_run(size_t values, const float *const rows[8], size_t at, size_t count,
                          const float *weights, float *to) {
    const size_t end = at + count;
    for (; at + FIELD_WIDTH * LMP_LANES <= end; at += FIELD_WIDTH * LMP_LANES)
        field_sum(FIELD_WIDTH, 0, values, rows, at, weights, to);
    for (; at + LMP_LANES <= end; at += LMP_LANES)
        field_sum(1, 0, values, rows, at, weights, to);
    if (at < end)
        field_sum(1, (int)(end - at), values, rows, at, weights, to);
}

/* Coefficients of each point that are transposed and go out together. */
#define FIELD_TOGETHER 64

static void kernel_interpolate(size_t values, const lmp_kernel_cells *cells, size_t count,
                               const lmp_kernel_out *out) {
    for (size_t e = 0; e < count; e += LMP_LANES) {
        float LMP_ALIGNED weights[FIELD_WEIGHTS * LMP_LANES];
        float LMP_ALIGNED rows[FIELD_TOGETHER * LMP_LANES], block[FIELD_TOGETHER * LMP_LANES];
        const lmp_kernel_in in = { rows, FIELD_TOGETHER, 0 };
        const size_t live = layout_live(count, e);
        field_weights(cells, e, weights);
        for (size_t at = 0; at < values; at += FIELD_TOGETHER) {
            const size_t some = values - at < FIELD_TOGETHER ? values - at : FIELD_TOGETHER;
            for (size_t lane = 0; lane < live; lane++) {
                const uint32_t *corners = cells->corners + 8 * (e + lane);
                const float *from[8];
                for (int k = 0; k < 8; k++)
                    from[k] = cells->nodes + 4 * values * corners[k] + at;
                field_run(values, from, 0, some, weights + lane, rows + lane * FIELD_TOGETHER);
            }
            layout_get(block, 0, some, &in, 0, live);
            layout_put(block, at, some, out, e, live);
        }
    }
}

/* Adds what a lobe receives, diffuse by factors[l] or Phong's by factor[l]. */
LMP_INLINE void field_lobe(int bands, int phong, const float *factors, const vf *factor,
                           const lmp_kernel_vec3 *axes, size_t e, const lmp_kernel_in *sh,
                           float *const accumulated[3]) {
    const size_t values = (size_t)(bands * bands), stride = sh->stride;
    const float *const planes[3] = { sh->at + e, sh->at + values * stride + e,
                                     sh->at + 2 * values * stride + e };
    reconstruct_block block = { { vf_load(axes->x + e), vf_load(axes->y + e),
                                  vf_load(axes->z + e) },
                                vf_set(1),
                                vf_set(0),
                                { vf_set(0), vf_set(0), vf_set(0) },
                                factor };
    LMP_UNROLL for (int m = 0; m < bands; m++) {
        if (m > 0)
            basis_rotate(m, block.axis[0], block.axis[1], &block.c, &block.s);
        reconstruct_column(bands, m, phong, stride, 1, factors, planes, &block);
    }
    LMP_UNROLL for (int c = 0; c < 3; c++)
        vf_store(accumulated[c] + e, vf_load(accumulated[c] + e) + block.rgb[c]);
}

LMP_INLINE void field_lobes(int bands, const float *window, const float *factors,
                            const lmp_kernel_surfaces *surfaces, size_t e, const lmp_kernel_in *sh,
                            const lmp_kernel_accumulated *accumulated) {
    field_lobe(bands, 0, factors, NULL, &surfaces->normal, e, sh, accumulated->diffuse);
    LMP_ROLLED for (int k = 0; k < surfaces->lobe_count; k++) {
        const lmp_kernel_lobe *lobe = &surfaces->lobe[k];
        vf factor[LMP_KERNEL_FIELD_BANDS_MAX];
        reconstruct_phong(bands, window, vf_load(lobe->exponent + e), factor);
        field_lobe(bands, 1, NULL, factor, &lobe->axis, e, sh, accumulated->specular[k]);
    }
}

/* Straight-line code for each number of bands, in a function of its own: together they would take
 * their stack together. As for zonal sums, a sanitizer gets the code for any number. */
typedef void field_of_bands(const float *window, const float *factors,
                            const lmp_kernel_surfaces *surfaces, size_t e, const lmp_kernel_in *sh,
                            const lmp_kernel_accumulated *accumulated);
#ifdef LMP_KERNELS_SANITIZED
#define FIELD_LOBES(bands, ...) field_lobes(bands, __VA_ARGS__)
#else
#define FIELD_BANDS(n)                                                                             \
    static LMP_NOINLINE void field_lobes_##n(                                                      \
        const float *window, const float *factors, const lmp_kernel_surfaces *surfaces, size_t e,  \
        const lmp_kernel_in *sh, const lmp_kernel_accumulated *accumulated) {                      \
        field_lobes(n, window, factors, surfaces, e, sh, accumulated);                             \
    }
FIELD_BANDS(1)
FIELD_BANDS(2)
FIELD_BANDS(3)
FIELD_BANDS(4)
FIELD_BANDS(5)
FIELD_BANDS(6)
FIELD_BANDS(7)
FIELD_BANDS(8)
FIELD_BANDS(9)
FIELD_BANDS(10)
static field_of_bands *const field_bands[LMP_KERNEL_FIELD_BANDS_MAX] = {
    field_lobes_1, field_lobes_2, field_lobes_3, field_lobes_4, field_lobes_5,
    field_lobes_6, field_lobes_7, field_lobes_8, field_lobes_9, field_lobes_10
};
#define FIELD_LOBES(bands, ...) field_bands[(bands)-1](__VA_ARGS__)
#endif

static void kernel_shade_field(int bands, const float *window, const float *diffuse,
                               const lmp_kernel_surfaces *surfaces, const lmp_kernel_in *sh,
                               size_t count, const lmp_kernel_accumulated *accumulated) {
    float factors[LMP_KERNEL_FIELD_BANDS_MAX];
    for (int l = 0; l < bands; l++)
        factors[l] = window[l] * diffuse[l];
    for (size_t e = 0; e < count; e += LMP_LANES)
        FIELD_LOBES(bands, window, factors, surfaces, e, sh, accumulated);
}

#endif
