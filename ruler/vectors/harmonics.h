/* SPDX-License-Identifier: MIT */
/* harmonics.h - real spherical harmonics, caps and quadrature in ball arithmetic, from what Arb
 * has. */
#ifndef LAMPION_VECTORS_HARMONICS_H
#define LAMPION_VECTORS_HARMONICS_H

#include <acb.h>

#define VECTORS_PRECISION 560 /* bits */

/* Y_lm of the real basis (docs/design.md) in the direction of w, which may be complex and of any
 * length but must not be near the poles then. */
void harmonics_at(acb_t value, int l, int m, acb_srcptr w);
void harmonics_at_real(arb_t value, int l, int m, arb_srcptr w);

/* 2 pi times the integral of the Legendre polynomial over z from the cap's cosine to 1. */
void harmonics_cap(acb_t value, int l, const acb_t cosine);

/* Of a sphere of `radius` around `center` - t along axis k as seen from the origin: its
 * coefficient. Inside it the cosine is minus the root of 1 - d²/r². */
void harmonics_sphere(acb_t value, int l, int m, const double center[3], double radius, int k,
                      const acb_t t);

/* Its derivative by t at 0: a central difference, and what Cauchy bounds it to be off by. */
void harmonics_sphere_derivative(arb_t value, int l, int m, const double center[3], double radius,
                                 int k);

/* The integral of f over the sphere, exact for polynomials of a degree below 2 n. */
typedef void harmonics_function(arb_t value, arb_srcptr w, void *user);
void harmonics_integrate(arb_t value, int n, harmonics_function *f, void *user);

#endif
