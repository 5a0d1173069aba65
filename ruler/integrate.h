/* SPDX-License-Identifier: MIT */
/* integrate.h - integrates a lobe over a part of a cap, with a proven bound of the error. */
#ifndef LAMPION_RULER_INTEGRATE_H
#define LAMPION_RULER_INTEGRATE_H

#include "ruler/lobe.h"

/* Adds the integral, its error below about `tolerance`, to `sum`, whose radius then holds it.
 *
 * Gauss-Legendre of n points over an interval of half length h errs by at most h (64/15) M
 * rho^(2-2n) / (1 - rho^-2) where |f| <= M within the ellipse of parameter rho around it
 * (Trefethen, Approximation Theory and Approximation Practice, theorem 19.3). M comes from one
 * evaluation in balls that cover the ellipse; with two variables the errors add, the other one
 * being real. Rectangles are halved until few points suffice. */
void ruler_integrate(arb_t sum, const ruler_lobe *lobe, const ruler_domain *domain,
                     double tolerance);

/* Frees the nodes. */
void ruler_integrate_cleanup(void);

#endif
