/* SPDX-License-Identifier: MIT */
/* reference_quadrature.h - the radiance that a surface reflects, by deterministic quadrature. */
#ifndef LAMPION_TRUTH_REFERENCE_QUADRATURE_H
#define LAMPION_TRUTH_REFERENCE_QUADRATURE_H

#include "app/truth/reference_light.h"
#include "app/truth/reference_lobe.h"

/* Sums the light of all lights, no areas, that the lobes reflect, without visibility, to about 12
 * digits of the lobe's peak. With truncated lobes the result is the series' own sum, which may be
 * negative. */
void reference_quadrature(const reference_surface *surface, const scene_light *lights, size_t count,
                          double radiance[3]);

/* Integrates f over low … high by the tanh-sinh rule, halving the step until the sum converges. */
typedef double (*reference_integrand)(double x, void *user);
double reference_integrate(reference_integrand f, void *user, double low, double high);

#endif
