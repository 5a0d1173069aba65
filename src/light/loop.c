/* SPDX-License-Identifier: MIT */
#include "src/light/loop.h"

#include "src/base/unroll.h"
#include "src/light/angle.h"
#include "src/sh/column.h"

#include <lampion/sh.h>

#include <string.h>

static const double pi = 3.14159265358979323846;

typedef lmpi_pair pair;

/* --- arcs ------------------------------------------------------------------------------------- */

void lmpi_loop_begin(lmpi_loop *loop, lmpi_vector inner) {
    loop->inner = inner;
    loop->count = 0;
    loop->closed = false;
}

void lmpi_loop_add_edge(lmpi_loop *loop, lmpi_vector from, lmpi_vector edge, lmpi_vector normal) {
    const lmpi_vector to = lmpi_vector_add(from, edge);
    const double across = lmpi_vector_length(normal);
    if (!(across > 0))
        return; /* an edge of no length, or seen from its own line */
    lmpi_arc *arc = &loop->arc[loop->count++];
    arc->straight = true;
    arc->from = from;
    arc->to = to;
    arc->pole = lmpi_vector_scale(normal, 1 / across);
    arc->across = across;
    arc->along = lmpi_vector_dot(from, to);
}

/* Returns the next straight edge from arc i on; NULL if there is none. */
static lmpi_arc *next_edge(lmpi_loop *loop, int *i) {
    while (*i < loop->count && !loop->arc[*i].straight)
        ++*i;
    return *i < loop->count ? &loop->arc[(*i)++] : NULL;
}

void lmpi_loop_end(lmpi_loop *loop) {
    int i = 0;
    for (lmpi_arc *a, *b; (a = next_edge(loop, &i));) {
        b = next_edge(loop, &i);
        const pair both = lmpi_angles((pair) { a->across, b ? b->across : 0 },
                                      (pair) { a->along, b ? b->along : 1 });
        a->angle = both[0];
        if (b)
            b->angle = both[1];
    }
}

/* Finds the middle of a straight edge and what follows from it. */
static void complete_edge(lmpi_arc *arc) {
    const double across = arc->across, along = arc->along;
    const lmpi_vector a = lmpi_vector_unit(arc->from), b = lmpi_vector_unit(arc->to);
    /* The tangent of a quarter of the angle by that, or by the cotangent, of its half. */
    const double half = across / (sqrt(across * across + along * along) + fabs(along));
    const double root = sqrt(1 + half * half);
    const lmpi_vector middle =
        along < 0 ? lmpi_vector_cross(arc->pole, lmpi_vector_sub(a, b)) : lmpi_vector_add(a, b);
    arc->center = (lmpi_vector) { 0, 0, 0 };
    arc->middle = lmpi_vector_unit(middle);
    arc->side = lmpi_vector_cross(arc->pole, arc->middle);
    arc->end = along < 0 ? 1 / (half + root) : half / (1 + root);
    const double square = arc->end * arc->end, per = 1 / (1 + square);
    arc->cosine = (1 - square) * per;
    arc->sine = 2 * arc->end * per;
}

void lmpi_loop_add_arc(lmpi_loop *loop, lmpi_vector center, lmpi_vector middle, lmpi_vector side,
                       double end) {
    loop->arc[loop->count++] = (lmpi_arc) { center, middle, side, end, .straight = false };
}

/* Returns v·w or v·g of a pair of nodes. */
static pair part_along(lmpi_vector v, pair const of[3][LMPI_ARC_PAIRS], int k) {
    return v.x * of[0][k] + v.y * of[1][k] + v.z * of[2][k];
}

static double sum_of(pair p) {
    return p[0] + p[1];
}

/* --- straight edges --------------------------------------------------------------------------- */

enum { EDGE_PAIRS = LMPI_ARCS_MAX / 2 };

/* Straight edges seen from an axis q, by pairs: q·w at both ends of each and its slope there, the
 * part of q along the pole, and the angle. An edge that lacks is 0. */
typedef struct edges {
    int count;
    pair z[2][EDGE_PAIRS], slope[2][EDGE_PAIRS], out[EDGE_PAIRS], angle[EDGE_PAIRS];
} edges;

static void take_edge(const lmpi_arc *arc, lmpi_vector q, edges *to) {
    const int k = to->count / 2, i = to->count % 2;
    const double u = lmpi_vector_dot(q, arc->middle), v = lmpi_vector_dot(q, arc->side);
    if (i == 0)
        to->z[0][k] = to->z[1][k] = to->slope[0][k] = to->slope[1][k] = to->out[k] = to->angle[k] =
            (pair) { 0, 0 };
    to->z[0][k][i] = u * arc->cosine - v * arc->sine;
    to->z[1][k][i] = u * arc->cosine + v * arc->sine;
    to->slope[0][k][i] = v * arc->cosine + u * arc->sine;
    to->slope[1][k][i] = v * arc->cosine - u * arc->sine;
    to->out[k][i] = lmpi_vector_dot(q, arc->pole);
    to->angle[k][i] = arc->angle;
    to->count++;
}

/* Adds what straight edges contribute to ∫ P_l(q·w) dw, l >= 1, by the recurrence of Wang and
 * Ramamoorthi (2018): I_l = ∫ P_l ds and D_l = ∫ P'_l ds along an edge, for z(s) = q·w(s) between
 * the ends, where z and dz/ds are known. */
static void add_edge_moments(int bands, const edges *from, double *moments) {
    const int pairs = (from->count + 1) / 2;
    pair p[2][EDGE_PAIRS], p_below[2][EDGE_PAIRS], i[EDGE_PAIRS], i_below[EDGE_PAIRS];
    pair d[EDGE_PAIRS], d_below[EDGE_PAIRS];
    for (int k = 0; k < pairs; k++) {
        const pair zero = { 0, 0 };
        p[0][k] = p[1][k] = zero + 1;
        p_below[0][k] = p_below[1][k] = i_below[k] = d[k] = d_below[k] = zero;
        i[k] = from->angle[k];
    }
    for (int l = 0; l + 1 < bands; l++) {
        const double n = l, per = 1 / (n + 1), twice = 2 * n + 1;
        pair sum = { 0, 0 };
        for (int k = 0; k < pairs; k++) {
            const pair out = from->out[k];
            const pair ends = p[1][k] * from->slope[1][k] - p[0][k] * from->slope[0][k];
            const pair i_next =
                (n * per) * (n * per) * i_below[k] - twice * per * per * (ends + out * out * d[k]);
            const pair d_next = d_below[k] + twice * i[k];
            for (int end = 0; end < 2; end++) {
                const pair next =
                    twice * per * from->z[end][k] * p[end][k] - n * per * p_below[end][k];
                p_below[end][k] = p[end][k];
                p[end][k] = next;
            }
            i_below[k] = i[k], i[k] = i_next;
            d_below[k] = d[k], d[k] = d_next;
            sum += out * d_next;
        }
        moments[l + 1] += sum_of(sum) / ((n + 1) * (n + 2));
    }
}

/* --- the integrals ---------------------------------------------------------------------------- */

typedef struct solid_angle_sum {
    lmpi_vector inner;
    double sum;
} solid_angle_sum;

/* Adds (u·g) / (1 + u·w), whose integral around the loop is the solid angle for any u whose
 * opposite is not seen. */
static void add_solid_angle(const lmpi_arc_nodes *from, void *user) {
    solid_angle_sum *to = user;
    pair sum = { 0, 0 };
    for (int k = 0; k < from->pairs; k++)
        sum += part_along(to->inner, from->g, k) / (1 + part_along(to->inner, from->w, k));
    to->sum += sum_of(sum);
}

/* A triangle of the inner direction and a straight edge: its solid angle is twice the angle of
 * (x, y). */
static void triangle(const lmpi_arc *arc, lmpi_vector inner, double *x, double *y) {
    const double c = arc->cosine, s = arc->sine;
    *y = 2 * s * c * lmpi_vector_dot(inner, arc->pole);
    *x = 1 + (c - s) * (c + s) + 2 * c * lmpi_vector_dot(inner, arc->middle);
}

void lmpi_loop_close(lmpi_loop *loop) {
    solid_angle_sum total = { loop->inner, 0 };
    for (int i = 0; i < loop->count; i++) {
        const lmpi_arc *arc = &loop->arc[i];
        if (!arc->straight)
            lmpi_arc_visit(arc, -arc->end, arc->end, 1, add_solid_angle, &total);
    }
    int i = 0;
    for (lmpi_arc *a, *b; (a = next_edge(loop, &i));) {
        double x[2] = { 1, 1 }, y[2] = { 0, 0 };
        complete_edge(a);
        triangle(a, loop->inner, &x[0], &y[0]);
        if ((b = next_edge(loop, &i))) {
            complete_edge(b);
            triangle(b, loop->inner, &x[1], &y[1]);
        }
        total.sum += 2 * sum_of(lmpi_angles((pair) { y[0], y[1] }, (pair) { x[0], x[1] }));
    }
    loop->solid_angle = total.sum;
    loop->closed = true;
}

typedef struct moments_sum {
    int bands;
    lmpi_vector q;
    double *moments;
} moments_sum;

static void add_moments(const lmpi_arc_nodes *from, void *user) {
    const moments_sum *to = user;
    pair z[LMPI_ARC_PAIRS], r[LMPI_ARC_PAIRS], below[LMPI_ARC_PAIRS];
    for (int k = 0; k < from->pairs; k++) {
        z[k] = part_along(to->q, from->w, k);
        r[k] = part_along(to->q, from->g, k);
        below[k] = (pair) { 0, 0 };
    }
    for (int l = 1; l < to->bands; l++) {
        const double n = l, up = (2 * n + 1) / (n + 2), down = (n - 1) / (n + 2);
        pair sum = { 0, 0 };
        for (int k = 0; k < from->pairs; k++) {
            const pair next = up * z[k] * r[k] - down * below[k];
            sum += r[k];
            below[k] = r[k];
            r[k] = next;
        }
        to->moments[l] += sum_of(sum) / 2;
    }
}

void lmpi_loop_moments(int bands, const lmpi_loop *loop, lmpi_vector q, double *moments) {
    moments_sum to = { bands, q, moments };
    edges straight = { .count = 0 };
    moments[0] = loop->solid_angle;
    for (int l = 1; l < bands; l++)
        moments[l] = 0;
    for (int i = 0; i < loop->count; i++) {
        const lmpi_arc *arc = &loop->arc[i];
        /* The recurrence rounds by parts of 1, however short the edge is. */
        if (arc->straight && arc->angle > 0.01)
            take_edge(arc, q, &straight);
        else
            lmpi_arc_visit(arc, -arc->end, arc->end, bands, add_moments, &to);
    }
    if (straight.count > 0)
        add_edge_moments(bands, &straight, moments);
}

/* --- coefficients ----------------------------------------------------------------------------- */

/* Some columns of coefficients, m … m_end - 1: for each, `bands` sums for m, then for -m. */
enum { COLUMNS = 2 * LMP_BANDS_MAX };
typedef struct columns {
    int low, bands, m, m_end;
    double *sums;
} columns;

/* Powers of x + iy; and the parts of g · grad (q(z) (x+iy)^m) that multiply q and dq/dz. */
typedef struct azimuth {
    pair c, s;
} azimuth;
typedef struct azimuth_slopes {
    azimuth of_q, of_slope;
} azimuth_slopes;

static azimuth times(azimuth a, azimuth b) {
    return (azimuth) { a.c * b.c - a.s * b.s, a.c * b.s + a.s * b.c };
}

static azimuth power(azimuth a, int exponent) {
    const pair zero = { 0, 0 };
    azimuth to = { zero + 1, zero };
    for (; exponent > 0; exponent /= 2, a = times(a, a))
        if (exponent % 2)
            to = times(to, a);
    return to;
}

/* Adds a column of monic polynomials q_l^m: q_l = z q_(l-1) - b q_(l-2). */
static void add_column(const lmpi_arc_nodes *from, int m, const azimuth_slopes *slopes, int low,
                       int bands, double *sums) {
    pair q[LMPI_ARC_PAIRS], q_below[LMPI_ARC_PAIRS], d[LMPI_ARC_PAIRS], d_below[LMPI_ARC_PAIRS];
    for (int k = 0; k < from->pairs; k++) {
        q[k] = (pair) { 1, 1 };
        q_below[k] = d[k] = d_below[k] = (pair) { 0, 0 };
    }
    for (int l = m; l < bands; l++) {
        const double b = ((double)l * l - (double)m * m) / (4. * l * l - 1);
        pair c = { 0, 0 }, s = { 0, 0 };
        for (int k = 0; l >= low && k < from->pairs; k++) {
            c += q[k] * slopes[k].of_q.c + d[k] * slopes[k].of_slope.c;
            s += q[k] * slopes[k].of_q.s + d[k] * slopes[k].of_slope.s;
        }
        sums[l] += sum_of(c);
        sums[bands + l] += sum_of(s);
        for (int k = 0; k < from->pairs; k++) {
            const pair z = from->w[2][k], q_next = z * q[k] - b * q_below[k];
            const pair d_next = q[k] + z * d[k] - b * d_below[k];
            q_below[k] = q[k], q[k] = q_next;
            d_below[k] = d[k], d[k] = d_next;
        }
    }
}

static void add_columns(const lmpi_arc_nodes *from, void *user) {
    const columns *to = user;
    azimuth below[LMPI_ARC_PAIRS];
    azimuth_slopes slopes[LMPI_ARC_PAIRS];
    for (int k = 0; k < from->pairs; k++)
        below[k] = power((azimuth) { from->w[0][k], from->w[1][k] }, to->m > 0 ? to->m - 1 : 0);
    for (int m = to->m; m < to->m_end; m++) {
        for (int k = 0; k < from->pairs; k++) {
            const azimuth xy = { from->w[0][k], from->w[1][k] },
                          g = { from->g[0][k], from->g[1][k] };
            const azimuth now = m > 0 ? times(xy, below[k]) : below[k];
            const azimuth across = times(g, below[k]);
            const pair gz = from->g[2][k];
            slopes[k] =
                (azimuth_slopes) { { m * across.c, m * across.s }, { gz * now.c, gz * now.s } };
            below[k] = now;
        }
        add_column(from, m, slopes, to->low, to->bands,
                   to->sums + (ptrdiff_t)(2 * to->bands) * (m - to->m));
    }
}

/* Adds a column to the planes, times what the monic polynomials lack and 1/(l(l+1)). */
static void put_column(const columns *from, int m, double diagonal, const float scale[3],
                       float *const planes[3]) {
    const double *sums = from->sums + (ptrdiff_t)(2 * from->bands) * (m - from->m);
    const size_t before = LMP_SH_COUNT(from->low);
    double factor = diagonal;
    for (int l = m; l < from->bands; l++) {
        if (l > m)
            factor *= sqrt((4. * l * l - 1) / ((double)l * l - (double)m * m));
        if (l < from->low || l == 0)
            continue;
        const double each = factor / ((double)l * (l + 1));
        for (int c = 0; c < 3; c++) {
            if (!planes[c])
                continue;
            planes[c][LMP_SH_INDEX(l, m) - before] += scale[c] * (float)(sums[l] * each);
            if (m > 0)
                planes[c][LMP_SH_INDEX(l, -m) - before] +=
                    scale[c] * (float)(sums[from->bands + l] * each);
        }
    }
}

void lmpi_loop_add(int low, int high, const lmpi_loop *loop, const float scale[3],
                   float *const planes[3]) {
    double sums[2 * COLUMNS], diagonal = sqrt(1 / (4 * pi));
    const int together = COLUMNS / high;
    for (int c = 0; low == 0 && c < 3; c++)
        if (planes[c])
            planes[c][0] += scale[c] * (float)(loop->solid_angle * diagonal);
    for (int m = 0; m < high; m += together) {
        columns some = { low, high, m, m + together < high ? m + together : high, sums };
        memset(sums, 0, sizeof sums);
        for (int i = 0; i < loop->count; i++)
            lmpi_arc_visit(&loop->arc[i], -loop->arc[i].end, loop->arc[i].end, high, add_columns,
                           &some);
        for (int k = some.m; k < some.m_end; k++) {
            put_column(&some, k, diagonal, scale, planes);
            diagonal = lmpi_sh_next_diagonal(k, diagonal);
        }
    }
}

/* --- irradiance ------------------------------------------------------------------------------- */

/* The integral around what the horizon leaves: along the visible parts of the loop, and from where
 * one ends along the horizon to where the next begins. */
typedef struct horizon_sum {
    lmpi_vector n, first, last; /* the beginning of the first visible part, the end of the last */
    bool begun, hidden;         /* whether there was one, and whether what came last was hidden */
    bool cut;                   /* whether the horizon hides where the loop begins */
    double sum;
} horizon_sum;

static void add_irradiance(const lmpi_arc_nodes *from, void *user) {
    horizon_sum *to = user;
    pair sum = { 0, 0 };
    for (int k = 0; k < from->pairs; k++)
        sum += part_along(to->n, from->g, k);
    to->sum += sum_of(sum);
}

/* Adds the angle along the horizon from one direction to another, counter-clockwise around n. A
 * half turn stays one where rounding says that it goes the other way. */
static void add_along_horizon(horizon_sum *to, lmpi_vector from, lmpi_vector at) {
    const double across = lmpi_vector_dot(to->n, lmpi_vector_cross(from, at));
    const double along = lmpi_vector_dot(from, at);
    const bool opposite = along < 0 && fabs(across) < -1e-9 * along;
    to->sum += opposite ? pi : lmpi_angle(across, along);
}

/* Returns the angle of a part of a straight edge. */
static double angle_between(const lmpi_arc *edge, double low, double high) {
    const bool whole = high - low >= 2 * edge->end;
    return whole ? edge->angle : 2 * lmpi_angle(high - low, 1 + low * high);
}

static void add_part(const lmpi_arc *arc, double low, double high, horizon_sum *to) {
    const lmpi_vector first = lmpi_arc_at(arc, low);
    if (!(lmpi_vector_dot(to->n, lmpi_arc_at(arc, low + (high - low) / 2)) > 0)) {
        to->cut |= !to->begun;
        to->hidden = true;
        return;
    }
    if (arc->straight)
        to->sum += lmpi_vector_dot(to->n, arc->pole) * angle_between(arc, low, high);
    else
        lmpi_arc_visit(arc, low, high, 2, add_irradiance, to);
    if (!to->begun)
        to->first = first;
    else if (to->hidden)
        add_along_horizon(to, to->last, first);
    to->begun = true;
    to->hidden = false;
    to->last = lmpi_arc_at(arc, high);
}

/* Finds where an arc crosses the horizon, n·w = 0, a quadratic in t; returns how often. A straight
 * edge does not if its ends are above. */
static int crossings(const lmpi_arc *arc, lmpi_vector n, double at[2]) {
    const double c = lmpi_vector_dot(n, arc->center), m = lmpi_vector_dot(n, arc->middle);
    const double s = lmpi_vector_dot(n, arc->side), square = s * s + (m - c) * (m + c);
    if (arc->straight && m * arc->cosine > fabs(s) * arc->sine)
        return 0;
    const double sum = s + (s < 0 ? -sqrt(fmax(square, 0)) : sqrt(fmax(square, 0)));
    const double roots[2] = { sum / (m - c), -(m + c) / sum };
    int count = 0;
    for (int k = 0; square > 0 && k < 2; k++)
        if (roots[k] > -arc->end && roots[k] < arc->end)
            at[count++] = roots[k];
    if (count == 2 && at[0] > at[1]) {
        at[0] = roots[1];
        at[1] = roots[0];
    }
    return count;
}

/* Returns how many edges of a polygon begin above the horizon, or -1 for what is no polygon. */
static int edges_above(const lmpi_loop *loop, lmpi_vector n) {
    int above = 0;
    for (int i = 0; i < loop->count; i++) {
        if (!loop->arc[i].straight)
            return -1;
        above += lmpi_vector_dot(n, loop->arc[i].from) > 0;
    }
    return above;
}

double lmpi_loop_irradiance(const lmpi_loop *loop, lmpi_vector n) {
    horizon_sum to = { .n = n };
    const int above = edges_above(loop, n);
    for (int i = 0; i < loop->count && above == loop->count; i++)
        to.sum += lmpi_vector_dot(n, loop->arc[i].pole) * loop->arc[i].angle;
    for (int i = 0; i < loop->count && above != 0 && above != loop->count; i++) {
        const lmpi_arc *arc = &loop->arc[i];
        lmpi_arc completed;
        if (arc->straight && !loop->closed) {
            completed = *arc;
            complete_edge(&completed);
            arc = &completed;
        }
        double at[2], low = -arc->end;
        const int count = crossings(arc, n, at);
        for (int k = 0; k < count; low = at[k++])
            add_part(arc, low, at[k], &to);
        add_part(arc, low, arc->end, &to);
    }
    if (to.begun && (to.hidden || to.cut))
        add_along_horizon(&to, to.last, to.first);
    return fmax(to.sum / 2, 0);
}
