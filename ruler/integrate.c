/* SPDX-License-Identifier: MIT */
#include "ruler/integrate.h"

#include <arb_hypgeom.h>
#include <math.h>

#define NODES_MAX   24
#define DEPTH_MAX   60
#define ELLIPSE_MIN 2          /* rho of the narrowest ellipse tried */
#define SLACK       (1 + 1e-9) /* more than a bound loses by doubles */
#define P           RULER_PRECISION

/* Nodes and weights of every rule used so far, on -1 … 1. */
static arb_ptr nodes[NODES_MAX + 1], weights[NODES_MAX + 1];

static void make_rule(int n) {
    if (nodes[n])
        return;
    nodes[n] = _arb_vec_init(n);
    weights[n] = _arb_vec_init(n);
    for (int k = 0; k < n; k++)
        arb_hypgeom_legendre_p_ui_root(nodes[n] + k, weights[n] + k, (ulong)n, (ulong)k, P);
}

void ruler_integrate_cleanup(void) {
    for (int n = 0; n <= NODES_MAX; n++)
        if (nodes[n]) {
            _arb_vec_clear(nodes[n], n);
            _arb_vec_clear(weights[n], n);
            nodes[n] = weights[n] = NULL;
        }
}

/* An interval in the unit square, u along x, v along the arc. Its ends are dyadic, hence exact in
 * double. */
typedef struct interval {
    double low, high;
} interval;
typedef struct patch {
    interval side[2];
    double tolerance;
    int depth;
} patch;

typedef struct work {
    const ruler_lobe *lobe;
    const ruler_domain *domain;
    arb_t length; /* high - low of the domain */
    arb_ptr sum;
    double error;
    ruler_ring ring;
    acb_t u, v, value;
} work;

/* Finds a ball that covers the ellipse of parameter rho around the interval; rho 1 is the interval
 * itself. */
static void cover(acb_t ball, const interval *side, double rho) {
    const double half = (side->high - side->low) / 2;
    arb_set_d(acb_realref(ball), side->low + half);
    arb_zero(acb_imagref(ball));
    mag_set_d(arb_radref(acb_realref(ball)), SLACK * half * (rho + 1 / rho) / 2);
    if (rho > 1)
        mag_set_d(arb_radref(acb_imagref(ball)), SLACK * half * (rho - 1 / rho) / 2);
}

/* Sets the ring at u of the unit square. */
static void set_ring(work *w, const acb_t u) {
    acb_mul_arb(w->value, u, w->length, P);
    acb_add_arb(w->value, w->value, w->domain->low, P);
    ruler_ring_set(&w->ring, w->lobe, w->domain, w->value);
}

/* Returns a bound of |f|, HUGE_VAL where f is not proven to be analytic. */
static double largest(work *w, const patch *at, int direction, double rho) {
    mag_t bound;
    mag_init(bound);
    cover(w->u, &at->side[0], direction == 0 ? rho : 1);
    cover(w->v, &at->side[1], direction == 1 ? rho : 1);
    set_ring(w, w->u);
    acb_mul_2exp_si(w->v, w->v, 1);
    acb_sub_ui(w->v, w->v, 1, P);
    ruler_ring_bound(bound, &w->ring, w->lobe, w->v);
    const double most = mag_get_d(bound);
    mag_clear(bound);
    return most;
}

/* A rule in one direction: its number of points, and a bound of its error. */
typedef struct rule {
    int points;
    double error;
} rule;

/* Finds the rule with the fewest points; POINTS_UNKNOWN where no ellipse is proven to be free of
 * poles. */
#define POINTS_UNKNOWN 1000000
static rule choose_rule(work *w, const patch *at, int direction) {
    static const double ellipses[] = { ELLIPSE_MIN, 3, 4.5, 7, 12, 25, 80, 1000 };
    rule best = { POINTS_UNKNOWN, HUGE_VAL };
    const double area = (at->side[0].high - at->side[0].low) * (at->side[1].high - at->side[1].low);
    if (direction == 1 && ruler_lobe_is_zonal(w->lobe))
        return (rule) { 1, 0 };
    for (size_t k = 0; k < sizeof ellipses / sizeof *ellipses; k++) {
        const double rho = ellipses[k], most = largest(w, at, direction, rho);
        if (!(most < HUGE_VAL))
            break;
        const double factor = SLACK * area / 2 * (64.0 / 15) * most / (1 - 1 / (rho * rho));
        const double ratio = factor / (at->tolerance / 2);
        const int points =
            ratio > 1 ? 1 + (int)fmin(ceil(log(ratio) / (2 * log(rho))), POINTS_UNKNOWN) : 1;
        if (points > best.points)
            break;
        best = (rule) { points, SLACK * factor * pow(rho, 2 - 2 * points) };
    }
    return best;
}

/* Finds node k of n on an interval of the unit square. */
static void set_node(acb_t at, const interval *side, int n, int k) {
    arb_t half;
    arb_init(half);
    arb_set_d(half, (side->high - side->low) / 2);
    acb_set_d(at, side->low + (side->high - side->low) / 2);
    arb_addmul(acb_realref(at), half, nodes[n] + k, P);
    arb_clear(half);
}

static void add_points(work *w, const patch *at, const int points[2]) {
    arb_t ring, total;
    arb_init(ring);
    arb_init(total);
    make_rule(points[0]);
    make_rule(points[1]);
    for (int i = 0; i < points[0]; i++) {
        set_node(w->u, &at->side[0], points[0], i);
        set_ring(w, w->u);
        arb_zero(ring);
        for (int j = 0; j < points[1]; j++) {
            set_node(w->v, &at->side[1], points[1], j);
            acb_mul_2exp_si(w->v, w->v, 1);
            acb_sub_ui(w->v, w->v, 1, P);
            ruler_ring_at(w->value, &w->ring, w->lobe, w->v);
            arb_addmul(ring, acb_realref(w->value), weights[points[1]] + j, P);
        }
        arb_addmul(total, ring, weights[points[0]] + i, P);
    }
    arb_set_d(ring,
              (at->side[0].high - at->side[0].low) * (at->side[1].high - at->side[1].low) / 4);
    arb_addmul(w->sum, total, ring, P);
    arb_clear(ring);
    arb_clear(total);
}

/* Whether no ellipse along `direction` is free of poles, however short the other side is. */
static bool must_halve(work *w, const patch *at, int direction) {
    patch line = *at;
    interval *const other = &line.side[!direction];
    other->low = other->high = (other->low + other->high) / 2;
    return !(largest(w, &line, direction, ELLIPSE_MIN) < HUGE_VAL);
}

/* Returns the direction to halve: the one that needs more points; if no number is known for either,
 * one that must be halved whatever the other is. */
static int choose_direction(work *w, const patch *at, const rule rules[2]) {
    if (rules[0].points != rules[1].points)
        return rules[1].points > rules[0].points;
    if (rules[0].points == POINTS_UNKNOWN)
        for (int d = 0; d < 2; d++)
            if (must_halve(w, at, d))
                return d;
    return at->side[1].high - at->side[1].low > at->side[0].high - at->side[0].low;
}

static void integrate_patch(work *w, const patch *at) {
    const rule rules[2] = { choose_rule(w, at, 0), choose_rule(w, at, 1) };
    const bool few = rules[0].points <= NODES_MAX && rules[1].points <= NODES_MAX;
    if (few || at->depth == DEPTH_MAX) {
        const int points[2] = { rules[0].points, rules[1].points };
        w->error += rules[0].error + rules[1].error;
        if (few)
            add_points(w, at, points);
        return;
    }
    const int direction = choose_direction(w, at, rules);
    patch halves[2] = { *at, *at };
    const interval *const side = &at->side[direction];
    halves[0].side[direction].high = halves[1].side[direction].low = (side->low + side->high) / 2;
    for (int k = 0; k < 2; k++) {
        halves[k].tolerance /= 2;
        halves[k].depth++;
        integrate_patch(w, &halves[k]);
    }
}

void ruler_integrate(arb_t sum, const ruler_lobe *lobe, const ruler_domain *domain,
                     double tolerance) {
    work w = { .lobe = lobe, .domain = domain };
    arb_t part;
    arb_init(part);
    arb_init(w.length);
    ruler_ring_init(&w.ring);
    acb_init(w.u);
    acb_init(w.v);
    acb_init(w.value);
    arb_sub(w.length, domain->high, domain->low, P);
    w.sum = part;
    /* dphi = arc dy and dy = 2 dv; with dx = length du, that is `scale` times f as computed here */
    arb_t scale;
    arb_init(scale);
    arb_mul_2exp_si(scale, w.length, 1);
    const double most = arf_get_d(arb_midref(scale), ARF_RND_UP) * SLACK;
    const patch whole = { { { 0, 1 }, { 0, 1 } }, tolerance / most, 0 };
    integrate_patch(&w, &whole);
    mag_t error;
    mag_init(error);
    mag_set_d(error, w.error * SLACK);
    arb_add_error_mag(part, error);
    arb_addmul(sum, part, scale, P);
    mag_clear(error);
    arb_clear(scale);
    arb_clear(part);
    arb_clear(w.length);
    ruler_ring_clear(&w.ring);
    acb_clear(w.u);
    acb_clear(w.v);
    acb_clear(w.value);
}
