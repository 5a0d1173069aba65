/* SPDX-License-Identifier: MIT */
/* harmonics.h - real spherical harmonics, caps and quadrature in ball arithmetic, built on Arb. */
#ifndef LAMPION_VECTORS_HARMONICS_H
#define LAMPION_VECTORS_HARMONICS_H

#include <acb.h>

#define VECTORS_PRECISION 560 /* in bits */

/* Evaluates Y_lm of the real basis (docs/design.md) in the direction of w, which may be of any
 * length, and complex where it is not near the poles. */
void harmonics_at(acb_t value, int l, int m, acb_srcptr w);
void harmonics_at_real(arb_t value, int l, int m, arb_srcptr w);

/* Computes 2 pi times the integral of the Legendre polynomial over z from the cap's cosine to 1. */
void harmonics_cap(acb_t value, int l, const acb_t cosine);

/* Computes the coefficient of a sphere of `radius` around `center` - t along axis k, as seen from
 * the origin. Inside it the cosine is minus the root of 1 - d²/r². */
void harmonics_sphere(acb_t value, int l, int m, const double center[3], double radius, int k,
                      const acb_t t);

/* Computes the derivative of harmonics_sphere by t at 0: a central difference, with Cauchy's bound
 * of its error. */
void harmonics_sphere_derivative(arb_t value, int l, int m, const double center[3], double radius,
                                 int k);

/* Integrates f over the sphere, exactly for polynomials of a degree below 2 n. */
typedef void harmonics_function(arb_t value, arb_srcptr w, void *user);
void harmonics_integrate(arb_t value, int n, harmonics_function *f, void *user);

#endif
