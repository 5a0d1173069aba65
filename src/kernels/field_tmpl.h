/* SPDX-License-Identifier: MIT */
/* field_tmpl.h - interpolates a field of coefficients at many points, and what lobes receive there.
 *
 * Adini's interpolation takes the value and the three slopes of each corner of a cell. In every
 * axis, s from 0 to 1 along an edge h, the corner on side 0 or 1 has
 *
 *     linear   1 - s, s        bend   -+ (s² (3 - 2s) - s)       slope   h s (1-s)², -h s² (1-s)
 *
 * and its weights are  l l l + b l l + l b l + l l b  of the value,  t l l  of d/dx and so on.
 * Weights are computed with points as lanes; then lanes are coefficients, because 32 rows are
 * summed and no lane needs another. What is read of a cell serves four points in it. */
#ifndef LAMPION_KERNELS_FIELD_TMPL_H
#define LAMPION_KERNELS_FIELD_TMPL_H

#include "src/kernels/field.h"
#include "src/kernels/reconstruct_tmpl.h"
#include "src/kernels/shade.h"

#define FIELD_WEIGHTS 32

/* Sums that share the rows read, and vectors of each sum that are computed side by side. */
#define FIELD_SUMS        4
#define FIELD_WIDTH(sums) (LMPI_LANES == 16 ? 5 : (sums) == 1 ? 4 : 2)

typedef struct field_axis {
    vf linear[2], bend[2], slope[2];
} field_axis;

LMPI_INLINE field_axis field_along(vf s, float edge) {
    const vf rest = vf_set(1) - s;
    const vf bend = s * s * (3.0f - (s + s)) - s, both = edge * (s * rest);
    return (field_axis) { { rest, s }, { vf_set(0) - bend, bend }, { both * rest, -(both * s) } };
}

/* Computes the weights of corner k, of its value and its slopes, at weights + 4 k LMPI_LANES. */
LMPI_INLINE void field_weights(const field_axis axis[3], float *weights) {
    const field_axis *x = &axis[0], *y = &axis[1], *z = &axis[2];
    LMPI_UNROLL for (int k = 0; k < 8; k++) {
        const int i = k & 1, j = k >> 1 & 1, n = k >> 2;
        const vf yz = y->linear[j] * z->linear[n], xz = x->linear[i] * z->linear[n];
        const vf xy = x->linear[i] * y->linear[j];
        float *to = weights + 4 * k * LMPI_LANES;
        vf_store(to, (x->linear[i] + x->bend[i]) * yz + y->bend[j] * xz + z->bend[n] * xy);
        vf_store(to + LMPI_LANES, x->slope[i] * yz);
        vf_store(to + 2 * LMPI_LANES, y->slope[j] * xz);
        vf_store(to + 3 * LMPI_LANES, z->slope[n] * xy);
    }
}

LMPI_INLINE void field_all_weights(const lmpi_kernel_cells *cells, size_t e, float *weights) {
    const field_axis axis[3] = { field_along(vf_load(cells->fraction.x + e), cells->cell.x),
                                 field_along(vf_load(cells->fraction.y + e), cells->cell.y),
                                 field_along(vf_load(cells->fraction.z + e), cells->cell.z) };
    field_weights(axis, weights);
}

/* The rows of a cell's corners: the values of each, with its derivatives `stride` floats apart. */
typedef struct field_terms {
    const float *corner[8];
    size_t stride;
} field_terms;

/* Sums of points are stored by the vector: the first vector of all points, then the next, as the
 * transposition to planes reads them. */
#define FIELD_STEP ((size_t)LMPI_LANES * LMPI_LANES)

/* Computes `width` vectors of each sum. */
LMPI_INLINE void field_add(int sums, int width, const field_terms *terms,
                           const float *const *weights, float *const *to, size_t at) {
    vf sum[FIELD_SUMS][5];
    LMPI_UNROLL for (int i = 0; i < sums; i++) LMPI_UNROLL for (int j = 0; j < width; j++)
        sum[i][j] = vf_set(0);
    LMPI_ROLLED for (int k = 0; k < FIELD_WEIGHTS; k++) {
        const float *row = terms->corner[k / 4] + (size_t)(k % 4) * terms->stride + at;
        vf value[5];
        LMPI_UNROLL for (int j = 0; j < width; j++) value[j] = vf_load(row + j * LMPI_LANES);
        LMPI_UNROLL for (int i = 0; i < sums; i++) {
            const float weight = weights[i][k * LMPI_LANES];
            LMPI_UNROLL for (int j = 0; j < width; j++) {
                sum[i][j] = sum[i][j] + weight * value[j];
                LMPI_OPAQUE_LANES(sum[i][j]);
            }
        }
    }
    LMPI_UNROLL for (int i = 0; i < sums; i++) LMPI_UNROLL for (int j = 0; j < width; j++)
        vf_store(to[i] + (at / LMPI_LANES + (size_t)j) * FIELD_STEP, sum[i][j]);
}

/* Computes `count` coefficients of each sum, and what fills their last vector. */
LMPI_INLINE void field_run(int sums, const field_terms *terms, size_t count,
                           const float *const *weights, float *const *to) {
    const size_t step = (size_t)FIELD_WIDTH(sums) * LMPI_LANES;
    size_t at = 0;
    for (; at + step <= count + LMPI_LANES - 1; at += step)
        field_add(sums, FIELD_WIDTH(sums), terms, weights, to, at);
    for (; at < count; at += LMPI_LANES)
        field_add(sums, 1, terms, weights, to, at);
}

static LMPI_NOINLINE void field_one(const field_terms *terms, size_t count,
                                    const float *const *weights, float *const *to) {
    field_run(1, terms, count, weights, to);
}

static LMPI_NOINLINE void field_four(const field_terms *terms, size_t count,
                                     const float *const *weights, float *const *to) {
    field_run(FIELD_SUMS, terms, count, weights, to);
}

/* Coefficients of each point that are transposed and written together. */
#define FIELD_TOGETHER 80

typedef float field_rows[FIELD_TOGETHER * LMPI_LANES];

/* Computes coefficients at … at + count - 1 of points e … e + live - 1. */
LMPI_INLINE void field_values(const lmpi_kernel_cells *cells, size_t e, size_t live, size_t at,
                              size_t count, const float *weights, float *rows) {
    for (size_t lane = 0, some; lane < live; lane += some) {
        const uint32_t *corners = cells->corners + 8 * (e + lane);
        const float *by[FIELD_SUMS];
        float *to[FIELD_SUMS];
        field_terms terms = { .stride = cells->stride };
        for (some = 1; some < FIELD_SUMS && lane + some < live &&
                       memcmp(corners, corners + 8 * some, 8 * sizeof *corners) == 0;)
            some++;
        if (some < FIELD_SUMS)
            some = 1;
        for (int k = 0; k < 8; k++)
            terms.corner[k] = cells->nodes + 4 * (size_t)corners[k] * cells->stride + at;
        for (size_t i = 0; i < some; i++) {
            by[i] = weights + lane + i;
            to[i] = rows + (lane + i) * LMPI_LANES;
        }
        (some == 1 ? field_one : field_four)(&terms, count, by, to);
    }
}

/* Writes rows as they are, or as planes. */
LMPI_INLINE void field_put(const float *rows, size_t at, size_t count, const lmpi_kernel_out *out,
                           size_t e, size_t live) {
    for (size_t v = 0; v < count; v += LMPI_LANES, rows += FIELD_STEP) {
        const size_t some = count - v < LMPI_LANES ? count - v : LMPI_LANES;
        float LMPI_ALIGNED block[FIELD_STEP];
        if (!out->planar) {
            for (size_t i = 0; i < live; i++)
                memcpy(out->at + (e + i) * out->stride + at + v, rows + i * LMPI_LANES,
                       some * sizeof *rows);
            continue;
        }
        float *const to = out->at + (at + v) * out->stride + e;
        if (some == LMPI_LANES && live == LMPI_LANES) {
            layout_square(rows, to, out->stride);
            continue;
        }
        layout_square(rows, block, LMPI_LANES);
        for (size_t i = 0; i < some; i++)
            layout_put_plane(to + i * out->stride, block + i * LMPI_LANES, live);
    }
}

static void kernel_interpolate(size_t values, const lmpi_kernel_cells *cells, size_t count,
                               const lmpi_kernel_out *out) {
    for (size_t e = 0; e < count; e += LMPI_LANES) {
        const size_t live = layout_live(count, e);
        float LMPI_ALIGNED weights[FIELD_WEIGHTS * LMPI_LANES];
        field_rows LMPI_ALIGNED rows;
        field_all_weights(cells, e, weights);
        if (live < LMPI_LANES)
            memset(rows, 0, sizeof rows);
        for (size_t at = 0; at < values; at += FIELD_TOGETHER) {
            const size_t some = values - at < FIELD_TOGETHER ? values - at : FIELD_TOGETHER;
            field_values(cells, e, live, at, some, weights, rows);
            field_put(rows, at, some, out, e, live);
        }
    }
}

/* Adds what a lobe receives: the diffuse lobe by factors[l], or a Phong lobe by factor[l]. */
LMPI_INLINE void field_lobe(int bands, int phong, const float *factors, const vf *factor,
                            const lmpi_kernel_vec3 *axes, size_t e, const lmpi_kernel_in *sh,
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
    LMPI_UNROLL for (int m = 0; m < bands; m++) {
        if (m > 0)
            basis_rotate(m, block.axis[0], block.axis[1], &block.c, &block.s);
        reconstruct_column(bands, m, phong, stride, 1, factors, planes, &block);
    }
    LMPI_UNROLL for (int c = 0; c < 3; c++)
        vf_store(accumulated[c] + e, vf_load(accumulated[c] + e) + block.rgb[c]);
}

LMPI_INLINE void field_lobes(int bands, const float *window, const float *factors,
                             const lmpi_kernel_surfaces *surfaces, size_t e,
                             const lmpi_kernel_in *sh, const lmpi_kernel_accumulated *accumulated) {
    field_lobe(bands, 0, factors, NULL, &surfaces->normal, e, sh, accumulated->diffuse);
    LMPI_ROLLED for (int k = 0; k < surfaces->lobe_count; k++) {
        const lmpi_kernel_lobe *lobe = &surfaces->lobe[k];
        vf factor[LMPI_KERNEL_FIELD_BANDS_MAX];
        reconstruct_phong(bands, window, vf_load(lobe->exponent + e), factor);
        field_lobe(bands, 1, NULL, factor, &lobe->axis, e, sh, accumulated->specular[k]);
    }
}

/* Straight-line code for each number of bands, in a function of its own: in one function they would
 * take their stack together. */
typedef void field_of_bands(const float *window, const float *factors,
                            const lmpi_kernel_surfaces *surfaces, size_t e,
                            const lmpi_kernel_in *sh, const lmpi_kernel_accumulated *accumulated);
#ifdef LMPI_ROLLED_LOOPS
#define FIELD_LOBES(bands, ...) field_lobes(bands, __VA_ARGS__)
#else
#define FIELD_BANDS(n)                                                                             \
    static LMPI_NOINLINE void field_lobes_##n(                                                     \
        const float *window, const float *factors, const lmpi_kernel_surfaces *surfaces, size_t e, \
        const lmpi_kernel_in *sh, const lmpi_kernel_accumulated *accumulated) {                    \
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
static field_of_bands *const field_bands[LMPI_KERNEL_FIELD_BANDS_MAX] = {
    field_lobes_1, field_lobes_2, field_lobes_3, field_lobes_4, field_lobes_5,
    field_lobes_6, field_lobes_7, field_lobes_8, field_lobes_9, field_lobes_10
};
#define FIELD_LOBES(bands, ...) field_bands[(bands)-1](__VA_ARGS__)
#endif

static void kernel_shade_field(int bands, const float *window, const float *diffuse,
                               const lmpi_kernel_surfaces *surfaces, const lmpi_kernel_in *sh,
                               size_t count, const lmpi_kernel_accumulated *accumulated) {
    for (size_t e = 0; e < count; e += LMPI_LANES)
        FIELD_LOBES(bands, window, diffuse, surfaces, e, sh, accumulated);
}

#endif
