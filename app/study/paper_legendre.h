/* SPDX-License-Identifier: MIT */
/* paper_legendre.h - Legendre polynomials and the cap's coefficients in double, for the steps that
 * verify formulas. */
#ifndef LAMPION_STUDY_PAPER_LEGENDRE_H
#define LAMPION_STUDY_PAPER_LEGENDRE_H

/* Evaluates P_l(x) by Bonnet's recurrence. */
double paper_legendre(int l, double x);

/* Integrates P_l over cos_a … 1 by quadrature: Delta_l of the paper's Eq. 10. */
double paper_delta(int l, double cos_a);

/* Evaluates Z_l = 2 pi K_l Delta_l of a cap of half angle a, paper Eq. 10, by quadrature. */
double paper_zonal(int l, double a);

#endif
