/* SPDX-License-Identifier: MIT */
/* domain.h - the directions of a cap above the horizon of a pole, in polar coordinates around it.
 *
 * The pole is a surface's normal or the axis of a lobe. Where circles around the pole lie within
 * the cap, the coordinate x is the angle theta from the pole; where the cap's rim cuts them, theta
 * = middle + spread cos 2x, which removes the square roots at both ends: everything is analytic in
 * x, and the horizon is one of its ends. */
#ifndef LAMPION_RULER_DOMAIN_H
#define LAMPION_RULER_DOMAIN_H

#include <acb.h>
#include <stdbool.h>

#define RULER_PRECISION 64 /* in bits */

/* An angle in radians, which may be known exactly in hundredths of a degree. */
typedef struct ruler_angle {
    arb_t radians;
    bool exact;
    int hundredths;
} ruler_angle;

void ruler_angle_init(ruler_angle *angle);
void ruler_angle_clear(ruler_angle *angle);
void ruler_angle_set(ruler_angle *angle, int hundredths);

/* A part of the cap, x from low to high. */
typedef struct ruler_domain {
    bool whole;        /* whole circles; otherwise arcs */
    arb_t low, high;   /* ends of x */
    arb_t first, last; /* theta where arcs begin and end */
    arb_t middle, spread;
    int first_sign, last_sign; /* of t - a and pi - t - a: which root of the arc vanishes there */
} ruler_domain;
#define RULER_DOMAINS 3

void ruler_domain_init(ruler_domain *domain);
void ruler_domain_clear(ruler_domain *domain);

/* Finds the parts of the cap of half angle `a` whose axis is `t` from the pole; returns how many
 * there are. Ends the program where they cannot be decided. */
int ruler_domains_of_cap(const ruler_angle *t, const ruler_angle *a,
                         ruler_domain domains[RULER_DOMAINS]);

/* Evaluates theta, |d theta/dx|, and half the arc, in radians of azimuth, at x. They are not finite
 * where they are not analytic in the ball x. */
void ruler_domain_at(const ruler_domain *domain, const acb_t x, acb_t theta, acb_t stretch,
                     acb_t arc);

#endif
