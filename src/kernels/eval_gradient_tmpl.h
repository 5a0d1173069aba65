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

/* The state of the columns: q_l^m with the one before, and (x + iy)^(m-1) at c[m], s[m]. */
typedef struct slope_columns {
    vf q0[LMP_BANDS_MAX], q1[LMP_BANDS_MAX + 1];
    vf c[LMP_BANDS_MAX + 1], s[LMP_BANDS_MAX + 1];
} slope_columns;

LMPI_INLINE void slope_band(int l, const vf axis[3], slope_columns *columns) {
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

/* Writes a value, and the gradient g of its polynomial without the part along the direction. */
LMPI_INLINE void slope_put(vf value, const vf g[3], const vf axis[3], float *to, size_t set) {
    const vf along = g[0] * axis[0] + g[1] * axis[1] + g[2] * axis[2];
    vf_store(to, value);
    LMPI_UNROLL for (int i = 0; i < 3; i++)
        vf_store(to + (size_t)(i + 1) * set, g[i] - along * axis[i]);
}

/* Writes (l, m) at plus and (l, -m) at minus; the sets are `set` floats apart. */
LMPI_INLINE void slope_entry(int l, int m, const vf axis[3], const slope_columns *columns,
                             float *plus, float *minus, size_t set) {
    const vf q = columns->q1[m], mq = (float)m * q;
    const vf dz = lmpi_table_slope[lmpi_table_index(l, m)] * columns->q1[m + 1];
    const vf c = columns->c[m + 1], s = columns->s[m + 1];
    const vf mc = mq * columns->c[m], ms = mq * columns->s[m];
    const vf cosine[3] = { mc, vf_set(0) - ms, dz * c }, sine[3] = { ms, mc, dz * s };
    slope_put(q * c, cosine, axis, plus, set);
    if (m > 0)
        slope_put(q * s, sine, axis, minus, set);
}

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
    float *minus = block, *plus = block + SLOPE_COLUMNS * LMPI_LANES;
    const size_t middle = (size_t)(l * l + l);
    for (int m = first; m < end; m++)
        slope_entry(l, m, axis, columns, plus + (m - first) * LMPI_LANES,
                    minus + (end - 1 - m) * LMPI_LANES, 2 * SLOPE_COLUMNS * LMPI_LANES);
    slope_send(plus, middle + (size_t)first, (size_t)(end - first), to);
    if (first == 0)
        first = 1;
    if (first < end)
        slope_send(minus, middle + 1 - (size_t)end, (size_t)(end - first), to);
}

static void kernel_eval_gradient(int bands, const lmpi_kernel_vec3 *directions, size_t count,
                                 const lmpi_kernel_out *out, const lmpi_kernel_out *gradient) {
    slope_columns columns;
    for (size_t e = 0; e < count; e += LMPI_LANES) {
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
