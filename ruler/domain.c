/* SPDX-License-Identifier: MIT */
#include "ruler/domain.h"

#include <stdio.h>
#include <stdlib.h>

void ruler_angle_init(ruler_angle *angle) {
    arb_init(angle->radians);
}

void ruler_angle_clear(ruler_angle *angle) {
    arb_clear(angle->radians);
}

void ruler_angle_set(ruler_angle *angle, int hundredths) {
    arb_const_pi(angle->radians, RULER_PRECISION);
    arb_mul_si(angle->radians, angle->radians, hundredths, RULER_PRECISION);
    arb_div_ui(angle->radians, angle->radians, 18000, RULER_PRECISION);
    angle->exact = true;
    angle->hundredths = hundredths;
}

/* Returns the sign of an angle; an angle that may be 0 must be known exactly. */
static int sign_of(const ruler_angle *angle) {
    if (angle->exact)
        return (angle->hundredths > 0) - (angle->hundredths < 0);
    if (arb_contains_zero(angle->radians)) {
        fprintf(stderr, "ruler: a light's rim touches the pole or the horizon: choose another\n");
        exit(1);
    }
    return arb_is_positive(angle->radians) ? 1 : -1;
}

/* Computes s t + u a + v right angles. */
static void combine(ruler_angle *sum, int s, const ruler_angle *t, int u, const ruler_angle *a,
                    int v) {
    arb_const_pi(sum->radians, RULER_PRECISION);
    arb_mul_si(sum->radians, sum->radians, v, RULER_PRECISION);
    arb_mul_2exp_si(sum->radians, sum->radians, -1);
    arb_addmul_si(sum->radians, t->radians, s, RULER_PRECISION);
    arb_addmul_si(sum->radians, a->radians, u, RULER_PRECISION);
    sum->exact = t->exact && a->exact;
    sum->hundredths = sum->exact ? s * t->hundredths + u * a->hundredths + v * 9000 : 0;
}

void ruler_domain_init(ruler_domain *domain) {
    arb_init(domain->low);
    arb_init(domain->high);
    arb_init(domain->first);
    arb_init(domain->last);
    arb_init(domain->middle);
    arb_init(domain->spread);
}

void ruler_domain_clear(ruler_domain *domain) {
    arb_clear(domain->low);
    arb_clear(domain->high);
    arb_clear(domain->first);
    arb_clear(domain->last);
    arb_clear(domain->middle);
    arb_clear(domain->spread);
}

/* Sets circles from theta = low to the horizon, or to `high` if that is above it. */
static void set_circles(ruler_domain *domain, const arb_t low, const arb_t high, bool below) {
    domain->whole = true;
    arb_set(domain->low, low);
    if (below) {
        arb_const_pi(domain->high, RULER_PRECISION);
        arb_mul_2exp_si(domain->high, domain->high, -1);
    } else {
        arb_set(domain->high, high);
    }
}

/* Sets arcs: x runs from where theta is the horizon, or the last arc, to pi/2, where theta is the
 * first one. */
static void set_arcs(ruler_domain *domain, bool below) {
    domain->whole = false;
    arb_add(domain->middle, domain->first, domain->last, RULER_PRECISION);
    arb_mul_2exp_si(domain->middle, domain->middle, -1);
    arb_sub(domain->spread, domain->last, domain->first, RULER_PRECISION);
    arb_mul_2exp_si(domain->spread, domain->spread, -1);
    arb_const_pi(domain->high, RULER_PRECISION);
    arb_mul_2exp_si(domain->high, domain->high, -1);
    arb_zero(domain->low);
    if (!below)
        return;
    arb_sub(domain->low, domain->high, domain->middle, RULER_PRECISION);
    arb_div(domain->low, domain->low, domain->spread, RULER_PRECISION);
    arb_acos(domain->low, domain->low, RULER_PRECISION);
    arb_mul_2exp_si(domain->low, domain->low, -1);
}

int ruler_domains_of_cap(const ruler_angle *t, const ruler_angle *a,
                         ruler_domain domains[RULER_DOMAINS]) {
    ruler_angle first, last, end;
    ruler_angle_init(&first);
    ruler_angle_init(&last);
    ruler_angle_init(&end);
    combine(&first, 1, t, -1, a, 0);
    combine(&last, -1, t, -1, a, 2);
    const int first_sign = sign_of(&first), last_sign = sign_of(&last);
    arb_abs(first.radians, first.radians);
    first.hundredths = abs(first.hundredths);
    combine(&last, last_sign < 0 ? -1 : 1, t, last_sign < 0 ? -1 : 1, a, last_sign < 0 ? 4 : 0);
    combine(&end, 1, &first, 0, a, -1);
    const bool first_below = sign_of(&end) >= 0;
    combine(&end, 1, &last, 0, a, -1);
    const bool last_below = sign_of(&end) > 0;
    /* A light around the pole, or of all directions, has only whole circles. */
    const bool round = t->exact && t->hundredths == 0;
    const bool all = a->exact && a->hundredths == 18000;

    arb_t pole;
    arb_init(pole);
    int count = 0;
    if (all || first_sign < 0)
        set_circles(&domains[count++], pole, first.radians, all || first_below);
    if (!all && !first_below && !round) {
        ruler_domain *const arcs = &domains[count++];
        arcs->first_sign = first_sign;
        arcs->last_sign = last_sign;
        arb_set(arcs->first, first.radians);
        arb_set(arcs->last, last.radians);
        set_arcs(arcs, last_below);
    }
    if (!all && last_sign < 0 && !last_below)
        set_circles(&domains[count++], last.radians, pole, true);
    arb_clear(pole);
    ruler_angle_clear(&first);
    ruler_angle_clear(&last);
    ruler_angle_clear(&end);
    return count;
}

/* Computes sqrt(sin(spread u²)) for analytic u, which may be 0: |u| is taken as u. */
static void vanishing_root(acb_t root, const acb_t u, const arb_t spread) {
    acb_t sine;
    acb_init(sine);
    acb_sqr(sine, u, RULER_PRECISION);
    acb_mul_arb(sine, sine, spread, RULER_PRECISION);
    acb_sinc(sine, sine, RULER_PRECISION);
    acb_mul_arb(sine, sine, spread, RULER_PRECISION);
    acb_sqrt_analytic(sine, sine, 1, RULER_PRECISION);
    acb_mul(root, sine, u, RULER_PRECISION);
    acb_clear(sine);
}

/* Computes sqrt(sin((theta + end)/2)). */
static void other_root(acb_t root, const acb_t theta, const arb_t end) {
    acb_add_arb(root, theta, end, RULER_PRECISION);
    acb_mul_2exp_si(root, root, -1);
    acb_sin(root, root, RULER_PRECISION);
    acb_sqrt_analytic(root, root, 1, RULER_PRECISION);
}

/* Multiplies tan(arc/2) = y/x by the roots of one end; equal roots cancel. */
static void multiply_roots(acb_t y, acb_t x, int sign, const acb_t u, const arb_t spread,
                           const acb_t theta, const arb_t end) {
    if (sign == 0)
        return;
    acb_t root;
    acb_init(root);
    vanishing_root(root, u, spread);
    acb_mul(sign > 0 ? y : x, sign > 0 ? y : x, root, RULER_PRECISION);
    other_root(root, theta, end);
    acb_mul(sign > 0 ? x : y, sign > 0 ? x : y, root, RULER_PRECISION);
    acb_clear(root);
}

/* Computes 2 atan(y/x) = -i (log(x + iy) - log(x - iy)), for x = 0 too. */
static void set_arc(acb_t arc, acb_t y, const acb_t x) {
    acb_t below;
    acb_init(below);
    acb_mul_onei(y, y);
    acb_sub(below, x, y, RULER_PRECISION);
    acb_add(arc, x, y, RULER_PRECISION);
    acb_log_analytic(arc, arc, 1, RULER_PRECISION);
    acb_log_analytic(below, below, 1, RULER_PRECISION);
    acb_sub(arc, arc, below, RULER_PRECISION);
    acb_div_onei(arc, arc);
    acb_clear(below);
}

void ruler_domain_at(const ruler_domain *domain, const acb_t x, acb_t theta, acb_t stretch,
                     acb_t arc) {
    if (domain->whole) {
        acb_set(theta, x);
        acb_one(stretch);
        acb_const_pi(arc, RULER_PRECISION);
        return;
    }
    acb_t sine, cosine, up, across;
    acb_init(sine);
    acb_init(cosine);
    acb_init(up);
    acb_init(across);
    acb_mul_2exp_si(theta, x, 1);
    acb_sin_cos(stretch, theta, theta, RULER_PRECISION);
    acb_mul_arb(stretch, stretch, domain->spread, RULER_PRECISION);
    acb_mul_2exp_si(stretch, stretch, 1);
    acb_mul_arb(theta, theta, domain->spread, RULER_PRECISION);
    acb_add_arb(theta, theta, domain->middle, RULER_PRECISION);
    acb_sin_cos(sine, cosine, x, RULER_PRECISION);
    acb_one(up);
    acb_one(across);
    multiply_roots(up, across, domain->first_sign, cosine, domain->spread, theta, domain->first);
    multiply_roots(up, across, domain->last_sign, sine, domain->spread, theta, domain->last);
    set_arc(arc, up, across);
    acb_clear(sine);
    acb_clear(cosine);
    acb_clear(up);
    acb_clear(across);
}
