/* SPDX-License-Identifier: MIT */
/* basis_tmpl.h - Y_lm, and every sum over m of a function around an axis: L_lm = radial_l
 * Y_lm(axis).
 *
 * Column m of the basis is q_l^m {C_m, S_m} (tables.h). The same operations are done in two orders:
 * by columns, with the recurrence in registers, where the output takes any plane; and by bands,
 * which completes rows in their order. */
#ifndef LAMPION_KERNELS_BASIS_TMPL_H
#define LAMPION_KERNELS_BASIS_TMPL_H

#include "src/base/tables.h"
#include "src/kernels/layout_tmpl.h"

/* Up to this many bands the kernels are specialized: straight-line code. */
#define BASIS_STRAIGHT 10

/* Blocks that run side by side, because the recurrence of one block waits for itself. */
#define BASIS_BLOCKS (LMPI_LANES == 16 ? 4 : 2)

/* Values held as planes of lanes before they are written as rows: two bands and 15. */
#define BASIS_WAITING (4 * LMP_BANDS_MAX + 11)

/* The state of a column's recurrence. */
typedef struct basis_column {
    vf q0, q1;
} basis_column;

/* Returns q_l of a column from q_(l-1) and q_(l-2). */
LMPI_INLINE vf basis_step(const float *a, const float *b, int l, int m, vf z, vf q1, vf q0) {
    const size_t i = lmpi_table_index(l, m);
    if (l == m + 1)
        return a[i] * z * q1;
    return a[i] * z * q1 + b[i] * q0;
}

/* Computes C_m + i S_m = (x + iy)^m from C_(m-1) + i S_(m-1). */
LMPI_INLINE void basis_rotate(int m, vf x, vf y, vf *c, vf *s) {
    if (m == 1) {
        *c = x;
        *s = y;
        return;
    }
    const vf rotated = x * *c - y * *s;
    *s = x * *s + y * *c;
    *c = rotated;
}

/* Writes plane l*l+l±m to to + (l*l+l±m) * stride; radial NULL means 1 for every band. It is
 * straight-line code, because `bands` is a constant. */
LMPI_INLINE void basis_straight_columns(int bands, const vf axis[3], const vf *radial, float *to,
                                        size_t stride) {
    const float *a = lmpi_table_a, *b = lmpi_table_b, *diagonal = lmpi_table_diagonal;
    LMPI_OPAQUE(a);
    LMPI_OPAQUE(b);
    LMPI_OPAQUE(diagonal);
    const vf x = axis[0], y = axis[1], z = axis[2];
    /* Copied, because the stores below might otherwise change them. */
    vf scale[BASIS_STRAIGHT];
    float *middles[BASIS_STRAIGHT];
    LMPI_UNROLL for (int l = 0; l < bands; l++) {
        if (radial)
            scale[l] = radial[l];
        middles[l] = to + (size_t)(l * l + l) * stride;
        LMPI_OPAQUE(middles[l]);
    }
    vf c = vf_set(1), s = vf_set(0);
    LMPI_UNROLL for (int m = 0; m < bands; m++) {
        vf q0 = vf_set(0), q1 = vf_set(diagonal[m]);
        LMPI_OPAQUE_LANES(q1);
        if (m > 0)
            basis_rotate(m, x, y, &c, &s);
        LMPI_UNROLL for (int l = m; l < bands; l++) {
            if (l > m) {
                const vf q2 = basis_step(a, b, l, m, z, q1, q0);
                q0 = q1;
                q1 = q2;
            }
            const vf value = radial ? q1 * scale[l] : q1;
            vf_store(middles[l] + (size_t)m * stride, m > 0 ? value * c : value);
            if (m > 0)
                vf_store(middles[l] - (size_t)m * stride, value * s);
        }
    }
}

/* Writes band l of column m, whose recurrence is at band l - 1. */
LMPI_INLINE void basis_pair_put(const float *a, const float *b, int l, int m, vf z, vf *q0, vf *q1,
                                vf c, vf s, float *middle, size_t stride) {
    if (l > m) {
        const vf q2 = basis_step(a, b, l, m, z, *q1, *q0);
        *q0 = *q1;
        *q1 = q2;
    }
    vf_store(middle + (size_t)m * stride, m > 0 ? *q1 * c : *q1);
    if (m > 0)
        vf_store(middle - (size_t)m * stride, *q1 * s);
}

/* Does basis_straight_columns for radial NULL, two columns side by side, because each waits for
 * itself. The second of the last two may lie past `bands`, and is not stored. */
LMPI_INLINE void basis_straight_pairs(int bands, const vf axis[3], float *to, size_t stride) {
    const float *a = lmpi_table_a, *b = lmpi_table_b, *diagonal = lmpi_table_diagonal;
    LMPI_OPAQUE(a);
    LMPI_OPAQUE(b);
    LMPI_OPAQUE(diagonal);
    const vf x = axis[0], y = axis[1], z = axis[2];
    float *middles[BASIS_STRAIGHT];
    LMPI_UNROLL for (int l = 0; l < bands; l++) {
        middles[l] = to + (size_t)(l * l + l) * stride;
        LMPI_OPAQUE(middles[l]);
    }
    vf c = vf_set(1), s = vf_set(0);
    LMPI_UNROLL for (int m = 0; m < bands; m += 2) {
        vf p0 = vf_set(0), p1 = vf_set(diagonal[m]), q0 = vf_set(0), q1 = vf_set(diagonal[m + 1]);
        LMPI_OPAQUE_LANES(p1);
        LMPI_OPAQUE_LANES(q1);
        if (m > 0)
            basis_rotate(m, x, y, &c, &s);
        const vf cp = c, sp = s;
        basis_rotate(m + 1, x, y, &c, &s);
        LMPI_UNROLL for (int l = m; l < bands; l++) {
            basis_pair_put(a, b, l, m, z, &p0, &p1, cp, sp, middles[l], stride);
            if (l > m)
                basis_pair_put(a, b, l, m + 1, z, &q0, &q1, c, s, middles[l], stride);
        }
    }
}

/* Takes the faster order of columns for a constant number of bands: up to 8 bands, and with radial
 * factors, the CPU has enough other work to fill the waits. */
LMPI_INLINE void basis_straight(int bands, const vf axis[3], const vf *radial, float *to,
                                size_t stride) {
    if (LMPI_LANES > 1 && !radial && bands > 8)
        basis_straight_pairs(bands, axis, to, stride);
    else
        basis_straight_columns(bands, axis, radial, to, stride);
}

/* Does basis_straight_columns for any number of bands. */
LMPI_INLINE void basis_columns(int bands, const vf axis[3], const vf *radial, float *to,
                               size_t stride) {
    const float *a = lmpi_table_a, *b = lmpi_table_b;
    vf c = vf_set(1), s = vf_set(0);
    for (int m = 0; m < bands; m++) {
        vf q0 = vf_set(0), q1 = vf_set(lmpi_table_diagonal[m]);
        if (m > 0)
            basis_rotate(m, axis[0], axis[1], &c, &s);
        for (int l = m; l < bands; l++) {
            if (l > m) {
                const vf q2 = basis_step(a, b, l, m, axis[2], q1, q0);
                q0 = q1;
                q1 = q2;
            }
            const vf value = radial ? q1 * radial[l] : q1;
            const size_t middle = (size_t)(l * l + l);
            vf_store(to + (middle + (size_t)m) * stride, m > 0 ? value * c : value);
            if (m > 0)
                vf_store(to + (middle - (size_t)m) * stride, value * s);
        }
    }
}

/* A column of BASIS_BLOCKS full blocks side by side. Addresses advance from band to band, because
 * integer instructions share the decoders with those of vectors. */
typedef struct basis_wide {
    vf (*axis)[3], (*radial)[LMP_BANDS_MAX];
    vf c[BASIS_BLOCKS], s[BASIS_BLOCKS];
    float *plus, *minus;
    size_t step, stride;
} basis_wide;

LMPI_INLINE void basis_put_wide(basis_wide *w, int l, int m, const vf q[BASIS_BLOCKS]) {
    LMPI_UNROLL for (int k = 0; k < BASIS_BLOCKS; k++) {
        const vf value = w->radial ? q[k] * w->radial[k][l] : q[k];
        vf_store(w->plus + k * LMPI_LANES, m > 0 ? value * w->c[k] : value);
        if (m > 0)
            vf_store(w->minus + k * LMPI_LANES, value * w->s[k]);
    }
    w->plus += w->step;
    w->minus += w->step;
    w->step += 2 * w->stride;
}

/* Writes a column, two bands per iteration, because exchanging registers would cost moves. */
LMPI_INLINE void basis_column_wide(int bands, int m, basis_wide *w) {
    const float *a = lmpi_table_a, *b = lmpi_table_b;
    vf even[BASIS_BLOCKS], odd[BASIS_BLOCKS];
    LMPI_UNROLL for (int k = 0; k < BASIS_BLOCKS; k++) even[k] = vf_set(lmpi_table_diagonal[m]);
    basis_put_wide(w, m, m, even);
    if (m + 1 == bands)
        return;
    LMPI_UNROLL for (int k = 0; k < BASIS_BLOCKS; k++) odd[k] =
        basis_step(a, b, m + 1, m, w->axis[k][2], even[k], vf_set(0));
    for (int l = m + 1;;) {
        basis_put_wide(w, l, m, odd);
        if (++l == bands)
            return;
        LMPI_UNROLL for (int k = 0; k < BASIS_BLOCKS; k++) even[k] =
            basis_step(a, b, l, m, w->axis[k][2], odd[k], even[k]);
        basis_put_wide(w, l, m, even);
        if (++l == bands)
            return;
        LMPI_UNROLL for (int k = 0; k < BASIS_BLOCKS; k++) odd[k] =
            basis_step(a, b, l, m, w->axis[k][2], even[k], odd[k]);
    }
}

/* Does basis_columns for BASIS_BLOCKS full blocks side by side and any number of bands. */
LMPI_INLINE void basis_columns_wide(int bands, vf (*axis)[3], vf (*radial)[LMP_BANDS_MAX],
                                    float *to, size_t stride) {
    basis_wide w = { .axis = axis, .radial = radial, .stride = stride };
    LMPI_UNROLL for (int k = 0; k < BASIS_BLOCKS; k++) {
        w.c[k] = vf_set(1);
        w.s[k] = vf_set(0);
    }
    for (int m = 0; m < bands; m++) {
        w.plus = to + (size_t)(m * m + 2 * m) * stride;
        w.minus = to + (size_t)(m * m) * stride;
        w.step = (size_t)(2 * m + 2) * stride;
        if (m == 0) {
            basis_column_wide(bands, 0, &w);
            continue;
        }
        LMPI_UNROLL for (int k = 0; k < BASIS_BLOCKS; k++)
            basis_rotate(m, axis[k][0], axis[k][1], &w.c[k], &w.s[k]);
        basis_column_wide(bands, m, &w);
    }
}

/* Computes bands first … end-1 into planes l*l+l±m - from, column by column, with the recurrences'
 * state in `columns`. C_m and S_m are recomputed, because the stack has no room for them. */
LMPI_INLINE void basis_stretch(int first, int end, const vf axis[3], const vf *radial,
                               basis_column *columns, float *planes, int from) {
    const float *a = lmpi_table_a, *b = lmpi_table_b;
    vf c = vf_set(1), s = vf_set(0);
    for (int m = 0; m < end; m++) {
        basis_column *column = &columns[m];
        const vf z = axis[2];
        int l = first;
        if (m > 0)
            basis_rotate(m, axis[0], axis[1], &c, &s);
        if (m >= first) {
            l = m;
            column->q0 = vf_set(0);
            column->q1 = vf_set(lmpi_table_diagonal[m]);
        }
        vf q0 = column->q0, q1 = column->q1;
        float *middle = planes + (l * l + l - from) * LMPI_LANES;
        for (; l < end; l++) {
            if (l > m) {
                const vf q2 = basis_step(a, b, l, m, z, q1, q0);
                q0 = q1;
                q1 = q2;
            }
            const vf value = radial ? q1 * radial[l] : q1;
            vf_store(middle + m * LMPI_LANES, m > 0 ? value * c : value);
            if (m > 0)
                vf_store(middle - m * LMPI_LANES, value * s);
            middle += (2 * l + 2) * LMPI_LANES;
        }
        column->q0 = q0;
        column->q1 = q1;
    }
}

static inline void basis_bands(int bands, const vf axis[3], const vf *radial,
                               const lmpi_kernel_out *out, size_t element, size_t live) {
    basis_column columns[LMP_BANDS_MAX];
    float LMPI_ALIGNED waiting[BASIS_WAITING * LMPI_LANES];
    int sent = 0;
    for (int first = 0, end; first < bands; first = end) {
        end = first + 1;
        while (end < bands && (end + 1) * (end + 1) - sent <= BASIS_WAITING)
            end++;
        basis_stretch(first, end, axis, radial, columns, waiting, sent);
        /* Whole groups of 16 are written, because their rows fill cache lines; the rest waits. */
        const int ready = end == bands ? end * end - sent : (end * end - sent) & ~15;
        layout_put(waiting, (size_t)sent, (size_t)ready, out, element, live);
        memmove(waiting, waiting + ready * LMPI_LANES,
                (size_t)(end * end - sent - ready) * LMPI_LANES * sizeof(float));
        sent += ready;
    }
}

/* Writes the bands^2 values of one block. */
static LMPI_NOINLINE void basis_put(int bands, const vf axis[3], const vf *radial,
                                    const lmpi_kernel_out *out, size_t element, size_t count) {
    const size_t live = layout_live(count, element);
    if (LMPI_LANES == 1 || (out->planar && live == LMPI_LANES))
        basis_columns(bands, axis, radial, out->at + element * (out->planar ? 1 : out->stride),
                      out->planar ? out->stride : 1);
    else
        basis_bands(bands, axis, radial, out, element, live);
}

/* Writes the values of one block for a constant number of bands up to BASIS_STRAIGHT. */
LMPI_INLINE void basis_put_straight(int bands, const vf axis[3], const vf *radial,
                                    const lmpi_kernel_out *out, size_t element, size_t count) {
    const size_t live = layout_live(count, element);
    if (LMPI_LANES == 1 || (out->planar && live == LMPI_LANES)) {
        basis_straight(bands, axis, radial, out->at + element * (out->planar ? 1 : out->stride),
                       out->planar ? out->stride : 1);
        return;
    }
    float LMPI_ALIGNED block[BASIS_STRAIGHT * BASIS_STRAIGHT * LMPI_LANES];
    basis_straight(bands, axis, radial, block, LMPI_LANES);
    layout_put(block, 0, (size_t)(bands * bands), out, element, live);
}

/* Calls body(BANDS, 1, …) with BANDS a constant from 1 to 10, else body(bands, 0, …). */
#define BASIS_SPECIALISE(bands, body, ...)                                                         \
    switch (bands) {                                                                               \
        LMPI_SMALL_CASES(body, 1, __VA_ARGS__)                                                     \
    default:                                                                                       \
        body(bands, 0, __VA_ARGS__);                                                               \
    }

#endif
