/* SPDX-License-Identifier: MIT */
/* eval_gradient.h - Y_lm and its surface gradient: lanes are directions. Band after band, because
 * the slope of column m along z is that of column m + 1 at the same band. */
#ifndef LAMPION_KERNELS_EVAL_GRADIENT_H
#define LAMPION_KERNELS_EVAL_GRADIENT_H

#include "src/kernels/basis.h"

/* Columns that wait in planes of lanes, of +m and of -m, before they go out as rows. */
#define SLOPE_COLUMNS 16

/* The value, and d/dx, d/dy, d/dz. */
#define SLOPE_SETS 4

/* Where the columns stand: q_l^m with the one before, and (x + iy)^(m-1) at c[m], s[m]. */
typedef struct slope_columns {
    vf q0[LMP_BANDS_MAX], q1[LMP_BANDS_MAX + 1];
    vf c[LMP_BANDS_MAX + 1], s[LMP_BANDS_MAX + 1];
} slope_columns;

LMP_INLINE void slope_band(int l, const vf axis[3], slope_columns *columns) {
    for (int m = 0; m < l; m++) {
        const vf q2 =
            basis_step(lmp_table_a, lmp_table_b, l, m, axis[2], columns->q1[m], columns->q0[m]);
        columns->q0[m] = columns->q1[m];
        columns->q1[m] = q2;
    }
    columns->q0[l] = columns->q1[l + 1] = vf_set(0);
    columns->q1[l] = vf_set(lmp_table_diagonal[l]);
    vf c = l > 0 ? columns->c[l] : vf_set(1), s = l > 0 ? columns->s[l] : vf_set(0);
    if (l > 0)
        basis_rotate(l, axis[0], axis[1], &c, &s);
    else
        columns->c[0] = columns->s[0] = vf_set(0); /* multiplied by m = 0 */
    columns->c[l + 1] = c;
    columns->s[l + 1] = s;
}

/* A value, and the gradient g of its polynomial without the part along the direction. */
LMP_INLINE void slope_put(vf value, const vf g[3], const vf axis[3], float *to, size_t set) {
    const vf along = g[0] * axis[0] + g[1] * axis[1] + g[2] * axis[2];
    vf_store(to, value);
    LMP_UNROLL for (int i = 0; i < 3; i++)
        vf_store(to + (size_t)(i + 1) * set, g[i] - along * axis[i]);
}

/* (l, m) at plus, (l, -m) at minus; the sets are `set` floats apart. */
LMP_INLINE void slope_entry(int l, int m, const vf axis[3], const slope_columns *columns,
                            float *plus, float *minus, size_t set) {
    const vf q = columns->q1[m], mq = (float)m * q;
    const vf dz = lmp_table_slope[lmp_table_index(l, m)] * columns->q1[m + 1];
    const vf c = columns->c[m + 1], s = columns->s[m + 1];
    const vf mc = mq * columns->c[m], ms = mq * columns->s[m];
    const vf cosine[3] = { mc, vf_set(0) - ms, dz * c }, sine[3] = { ms, mc, dz * s };
    slope_put(q * c, cosine, axis, plus, set);
    if (m > 0)
        slope_put(q * s, sine, axis, minus, set);
}

/* Where the sets lie: the first in one output, the others in another. */
typedef struct slope_out {
    const lmp_kernel_out *out, *gradient;
    size_t plane, element, live;
} slope_out;

static inline void slope_send(const float *block, size_t first, size_t values,
                              const slope_out *to) {
    const size_t set = 2 * SLOPE_COLUMNS * LMP_LANES;
    layout_put(block, first, values, to->out, to->element, to->live);
    for (size_t i = 0; i < 3; i++)
        layout_put(block + (i + 1) * set, i * to->plane + first, values, to->gradient, to->element,
                   to->live);
}

/* Columns first … end-1 of band l: of a set m = end-1 … first backwards as -m, then +m. */
static inline void slope_columns_put(int l, int first, int end, const vf axis[3],
                                     const slope_columns *columns, const slope_out *to) {
    float LMP_ALIGNED block[SLOPE_SETS * 2 * SLOPE_COLUMNS * LMP_LANES];
    float *minus = block, *plus = block + SLOPE_COLUMNS * LMP_LANES;
    const size_t middle = (size_t)(l * l + l);
    for (int m = first; m < end; m++)
        slope_entry(l, m, axis, columns, plus + (m - first) * LMP_LANES,
                    minus + (end - 1 - m) * LMP_LANES, 2 * SLOPE_COLUMNS * LMP_LANES);
    slope_send(plus, middle + (size_t)first, (size_t)(end - first), to);
    if (first == 0)
        first = 1;
    if (first < end)
        slope_send(minus, middle + 1 - (size_t)end, (size_t)(end - first), to);
}

static void kernel_eval_gradient(int bands, const lmp_kernel_vec3 *directions, size_t count,
                                 const lmp_kernel_out *out, const lmp_kernel_out *gradient) {
    slope_columns columns;
    for (size_t e = 0; e < count; e += LMP_LANES) {
        const vf axis[3] = { vf_load(directions->x + e), vf_load(directions->y + e),
                             vf_load(directions->z + e) };
        const slope_out to = { out, gradient, (size_t)(bands * bands), e, layout_live(count, e) };
        for (int l = 0; l < bands; l++) {
            slope_band(l, axis, &columns);
            for (int first = 0; first <= l; first += SLOPE_COLUMNS)
                slope_columns_put(l, first,
                                  l + 1 - first < SLOPE_COLUMNS ? l + 1 : first + SLOPE_COLUMNS,
                                  axis, &columns, &to);
        }
    }
}

#endif
