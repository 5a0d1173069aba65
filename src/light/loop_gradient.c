/* SPDX-License-Identifier: MIT */
/* loop_gradient.c - how coefficients change as the viewer moves.
 *
 * As the viewer moves by dp, the boundary point x, seen at w = x/|x|, sweeps over the sphere by
 * -dp/|x|, less its part along w. Across the boundary that is, per dt, dp · (x x x')/|x|³, so
 *
 *     d/dp ∫ f(w) dw = ± ∮ f(w) (w x dw) / |x|,
 *
 * for f = 1 the law of Biot and Savart. */
#include "src/light/loop.h"
#include "src/sh/column.h"

#include <lampion/sh.h>

#include <string.h>

typedef lmpi_pair pair;

static const double pi = 3.14159265358979323846;

/* Some columns of coefficients, m … m_end - 1: for each, `bands` sums of each derivative for m,
 * then for -m. Along a straight edge, whose arc is around the viewer, `foot` · w is 1 over the
 * distance.
 */
enum { SUMS = 6 * 2 * LMP_BANDS_MAX };
typedef struct columns {
    int bands, m, m_end;
    const lmpi_arc *arc;
    lmpi_vector foot;
    double *sums;
} columns;

/* Powers of x + iy. */
typedef struct azimuth {
    pair c, s;
} azimuth;

static azimuth next_power(azimuth a, const lmpi_arc_nodes *nodes, int k) {
    const pair x = nodes->w[0][k], y = nodes->w[1][k];
    return (azimuth) { a.c * x - a.s * y, a.c * y + a.s * x };
}

static pair near_of(const columns *to, const lmpi_arc_nodes *from, int k) {
    if (!to->arc->straight)
        return from->near[k];
    return to->foot.x * from->w[0][k] + to->foot.y * from->w[1][k] + to->foot.z * from->w[2][k];
}

/* Adds a column of monic polynomials q_l^m: q_l = z q_(l-1) - b q_(l-2). */
static void add_column(const lmpi_arc_nodes *from, int m, const azimuth *power,
                       pair (*weight)[LMPI_ARC_PAIRS], int bands, double *sums) {
    pair q[LMPI_ARC_PAIRS], q_below[LMPI_ARC_PAIRS];
    for (int k = 0; k < from->pairs; k++) {
        q[k] = (pair) { 1, 1 };
        q_below[k] = (pair) { 0, 0 };
    }
    for (int l = m; l < bands; l++) {
        const double b = ((double)l * l - (double)m * m) / (4. * l * l - 1);
        for (int a = 0; a < 3; a++) {
            pair c = { 0, 0 }, s = { 0, 0 };
            for (int k = 0; k < from->pairs; k++) {
                c += q[k] * power[k].c * weight[a][k];
                s += q[k] * power[k].s * weight[a][k];
            }
            sums[2 * a * bands + l] += c[0] + c[1];
            sums[(2 * a + 1) * bands + l] += s[0] + s[1];
        }
        for (int k = 0; k < from->pairs; k++) {
            const pair q_next = from->w[2][k] * q[k] - b * q_below[k];
            q_below[k] = q[k], q[k] = q_next;
        }
    }
}

static void add_columns(const lmpi_arc_nodes *from, void *user) {
    const columns *to = user;
    azimuth power[LMPI_ARC_PAIRS];
    pair weight[3][LMPI_ARC_PAIRS];
    for (int k = 0; k < from->pairs; k++) {
        const pair near = near_of(to, from, k);
        power[k] = (azimuth) { { 1, 1 }, { 0, 0 } };
        for (int a = 0; a < 3; a++)
            weight[a][k] = near * from->g[a][k];
        for (int m = 0; m < to->m; m++)
            power[k] = next_power(power[k], from, k);
    }
    for (int m = to->m; m < to->m_end; m++) {
        add_column(from, m, power, weight, to->bands,
                   to->sums + (ptrdiff_t)(6 * to->bands) * (m - to->m));
        for (int k = 0; k < from->pairs; k++)
            power[k] = next_power(power[k], from, k);
    }
}

/* Writes a column, times what the monic polynomials lack. */
static void put_column(const columns *from, int m, double diagonal, float *gradient) {
    const int bands = from->bands;
    const double *sums = from->sums + (ptrdiff_t)(6 * bands) * (m - from->m);
    double factor = diagonal;
    for (int l = m; l < bands; l++) {
        if (l > m)
            factor *= sqrt((4. * l * l - 1) / ((double)l * l - (double)m * m));
        for (int a = 0; a < 3; a++) {
            float *plane = gradient + (size_t)a * LMP_SH_COUNT(bands);
            plane[LMP_SH_INDEX(l, m)] = (float)(factor * sums[2 * a * bands + l]);
            if (m > 0)
                plane[LMP_SH_INDEX(l, -m)] = (float)(factor * sums[(2 * a + 1) * bands + l]);
        }
    }
}

/* Finds what of a direction along a straight edge is 1 over the distance: the direction of the
 * nearest point of its line, over the distance of that. */
static lmpi_vector foot_of(const lmpi_arc *arc) {
    const lmpi_vector edge = lmpi_vector_sub(arc->to, arc->from);
    return lmpi_vector_scale(lmpi_vector_cross(edge, arc->pole), 1 / arc->across);
}

void lmpi_loop_gradient(int bands, const lmpi_loop *loop, float *gradient) {
    double sums[SUMS], diagonal = sqrt(1 / (4 * pi));
    const int together = SUMS / (6 * bands);
    for (int m = 0; m < bands; m += together) {
        columns some = { .bands = bands,
                         .m = m,
                         .m_end = m + together < bands ? m + together : bands,
                         .sums = sums };
        memset(sums, 0, sizeof sums);
        for (int i = 0; i < loop->count; i++) {
            some.arc = &loop->arc[i];
            if (some.arc->straight)
                some.foot = foot_of(some.arc);
            lmpi_arc_visit(some.arc, -some.arc->end, some.arc->end, bands, add_columns, &some);
        }
        for (int k = some.m; k < some.m_end; k++) {
            put_column(&some, k, diagonal, gradient);
            diagonal = lmpi_sh_next_diagonal(k, diagonal);
        }
    }
}
