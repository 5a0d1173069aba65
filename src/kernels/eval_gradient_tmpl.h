/* SPDX-License-Identifier: MIT */
/* eval_gradient_tmpl.h - Y_lm and its surface gradient: lanes are directions. It goes band by band,
 * because the slope of column m along z is that of column m + 1 at the same band. */
#ifndef LAMPION_KERNELS_EVAL_GRADIENT_TMPL_H
#define LAMPION_KERNELS_EVAL_GRADIENT_TMPL_H

#include "src/kernels/basis_tmpl.h"
#include "src/kernels/sh.h"

/* Columns held as planes of lanes, of +m and of -m, before they are written as rows. */
#define SLOPE_COLUMNS 16

/* Sets of values: the value itself, and d/dx, d/dy, d/dz. */
#define SLOPE_SETS 4

/* Bands up to which a block holds all values of its directions. */
#define SLOPE_FEW 10

/* The state of the columns: q_l^m with the one before, and (x + iy)^(m-1) at c[m], s[m]; room for
 * one column more than there are bands. */
typedef struct slope_columns {
    vf *q0, *q1, *c, *s;
} slope_columns;

LMPI_INLINE void slope_band(int l, const vf axis[3], const slope_columns *columns) {
    for (int m = 0; m < l; m++) {
        const vf q2 =
            basis_step(lmpi_table_a, lmpi_table_b, l, m, axis[2], columns->q1[m], columns->q0[m]);
        columns->q0[m] = columns->q1[m];
        columns->q1[m] = q2;
    }
    columns->q0[l] = columns->q1[l + 1] = vf_set(0);
    columns->q1[l] = vf_set(lmpi_table_diagonal[l]);
    vf c = l > 0 ? columns->c[l] : vf_set(1), s = l > 0 ? columns->s[l] : vf_set(0);
    if (l > 0)
        basis_rotate(l, axis[0], axis[1], &c, &s);
    else
        columns->c[0] = columns->s[0] = vf_set(0); /* multiplied by m = 0 */
    columns->c[l + 1] = c;
    columns->s[l + 1] = s;
}

/* Planes of lanes for the values of each set, `stride` floats from one value to the next: those of
 * the first set, and of the three others. */
typedef struct slope_planes {
    float *set[SLOPE_SETS];
    size_t stride, gradient_stride;
} slope_planes;

static inline slope_planes slope_block(float *block, size_t values) {
    const size_t set = values * LMPI_LANES;
    return (slope_planes) { { block, block + set, block + 2 * set, block + 3 * set },
                            LMPI_LANES,
                            LMPI_LANES };
}

/* Writes value `at`, and the gradient g of its polynomial without the part along the direction. */
LMPI_INLINE void slope_put(vf value, const vf g[3], const vf axis[3], const slope_planes *to,
                           size_t at) {
    const vf along = g[0] * axis[0] + g[1] * axis[1] + g[2] * axis[2];
    vf_store(to->set[0] + at * to->stride, value);
    LMPI_UNROLL for (int i = 0; i < 3; i++)
        vf_store(to->set[i + 1] + at * to->gradient_stride, g[i] - along * axis[i]);
}

/* Writes (l, m) as value `plus`, and (l, -m) as value `minus`. */
LMPI_INLINE void slope_entry(int l, int m, const vf axis[3], const slope_columns *columns,
                             const slope_planes *to, size_t plus, size_t minus) {
    const vf q = columns->q1[m], mq = (float)m * q;
    const vf dz = lmpi_table_slope[lmpi_table_index(l, m)] * columns->q1[m + 1];
    const vf c = columns->c[m + 1], s = columns->s[m + 1];
    const vf mc = mq * columns->c[m], ms = mq * columns->s[m];
    const vf cosine[3] = { mc, vf_set(0) - ms, dz * c }, sine[3] = { ms, mc, dz * s };
    slope_put(q * c, cosine, axis, to, plus);
    if (m > 0)
        slope_put(q * s, sine, axis, to, minus);
}

LMPI_INLINE void slope_axis(const lmpi_kernel_vec3 *directions, size_t e, vf axis[3]) {
    axis[0] = vf_load(directions->x + e);
    axis[1] = vf_load(directions->y + e);
    axis[2] = vf_load(directions->z + e);
}

/* Writes all values of the directions from element e on. */
LMPI_INLINE void slope_all(int bands, const lmpi_kernel_vec3 *directions, size_t e,
                           const slope_columns *columns, const slope_planes *to) {
    vf axis[3];
    slope_axis(directions, e, axis);
    for (int l = 0; l < bands; l++) {
        const size_t middle = (size_t)(l * l + l);
        slope_band(l, axis, columns);
        for (int m = 0; m <= l; m++)
            slope_entry(l, m, axis, columns, to, middle + (size_t)m, middle - (size_t)m);
    }
}

/* Writes planes of whole registers. */
static LMPI_NOINLINE void slope_in_place(int bands, const lmpi_kernel_vec3 *directions,
                                         size_t count, const lmpi_kernel_out *out,
                                         const lmpi_kernel_out *gradient) {
    vf memory[4][LMP_BANDS_MAX + 1];
    const slope_columns columns = { memory[0], memory[1], memory[2], memory[3] };
    const size_t set = (size_t)(bands * bands) * gradient->stride;
    for (size_t e = 0; e < count; e += LMPI_LANES) {
        float *const first = gradient->at + e;
        const slope_planes to = { { out->at + e, first, first + set, first + 2 * set },
                                  out->stride,
                                  gradient->stride };
        slope_all(bands, directions, e, &columns, &to);
    }
}

/* Writes few bands by blocks: rows by whole registers, which the few values of a column would not
 * fill. */
static LMPI_NOINLINE void slope_few(int bands, const lmpi_kernel_vec3 *directions, size_t first,
                                    size_t count, const lmpi_kernel_out *out,
                                    const lmpi_kernel_out *gradient) {
    float LMPI_ALIGNED block[SLOPE_SETS * SLOPE_FEW * SLOPE_FEW * LMPI_LANES];
    vf memory[4][SLOPE_FEW + 1];
    const slope_columns columns = { memory[0], memory[1], memory[2], memory[3] };
    const size_t values = (size_t)(bands * bands);
    const slope_planes to = slope_block(block, values);
    for (size_t e = first; e < count; e += LMPI_LANES) {
        slope_all(bands, directions, e, &columns, &to);
        layout_put(to.set[0], 0, values, out, e, layout_live(count, e));
        layout_put(to.set[1], 0, 3 * values, gradient, e, layout_live(count, e));
    }
}

/* --- many bands, some columns at a time ------------------------------------------------------- */

/* The outputs: one for the first set, another for the three others. */
typedef struct slope_out {
    const lmpi_kernel_out *out, *gradient;
    size_t plane, element, live;
} slope_out;

static inline void slope_send(const float *block, size_t first, size_t values,
                              const slope_out *to) {
    const size_t set = 2 * SLOPE_COLUMNS * LMPI_LANES;
    layout_put(block, first, values, to->out, to->element, to->live);
    for (size_t i = 0; i < 3; i++)
        layout_put(block + (i + 1) * set, i * to->plane + first, values, to->gradient, to->element,
                   to->live);
}

/* Writes columns first … end-1 of band l: in each set m = end-1 … first backwards as -m, then +m.
 */
static inline void slope_columns_put(int l, int first, int end, const vf axis[3],
                                     const slope_columns *columns, const slope_out *to) {
    float LMPI_ALIGNED block[SLOPE_SETS * 2 * SLOPE_COLUMNS * LMPI_LANES];
    const slope_planes planes = slope_block(block, 2 * SLOPE_COLUMNS);
    const size_t middle = (size_t)(l * l + l);
    for (int m = first; m < end; m++)
        slope_entry(l, m, axis, columns, &planes, (size_t)(SLOPE_COLUMNS + m - first),
                    (size_t)(end - 1 - m));
    slope_send(block + SLOPE_COLUMNS * LMPI_LANES, middle + (size_t)first, (size_t)(end - first),
               to);
    if (first == 0)
        first = 1;
    if (first < end)
        slope_send(block, middle + 1 - (size_t)end, (size_t)(end - first), to);
}

static LMPI_NOINLINE void slope_many(int bands, const lmpi_kernel_vec3 *directions, size_t first,
                                     size_t count, const lmpi_kernel_out *out,
                                     const lmpi_kernel_out *gradient) {
    vf memory[4][LMP_BANDS_MAX + 1];
    const slope_columns columns = { memory[0], memory[1], memory[2], memory[3] };
    for (size_t e = first; e < count; e += LMPI_LANES) {
        const slope_out to = { out, gradient, (size_t)(bands * bands), e, layout_live(count, e) };
        vf axis[3];
        slope_axis(directions, e, axis);
        for (int l = 0; l < bands; l++) {
            slope_band(l, axis, &columns);
            for (int m = 0; m <= l; m += SLOPE_COLUMNS)
                slope_columns_put(l, m, l + 1 - m < SLOPE_COLUMNS ? l + 1 : m + SLOPE_COLUMNS, axis,
                                  &columns, &to);
        }
    }
}

static void kernel_eval_gradient(int bands, const lmpi_kernel_vec3 *directions, size_t count,
                                 const lmpi_kernel_out *out, const lmpi_kernel_out *gradient) {
    const size_t whole = out->planar && gradient->planar ? count - count % LMPI_LANES : 0;
    if (whole > 0)
        slope_in_place(bands, directions, whole, out, gradient);
    if (whole < count)
        (bands <= SLOPE_FEW ? slope_few : slope_many)(bands, directions, whole, count, out,
                                                      gradient);
}

#endif
