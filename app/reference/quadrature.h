/* SPDX-License-Identifier: MIT */
/* quadrature.h - the radiance that a surface reflects, by deterministic quadrature. */
#ifndef LAMPION_REFERENCE_QUADRATURE_H
#define LAMPION_REFERENCE_QUADRATURE_H

#include "app/reference/light.h"
#include "app/reference/lobe.h"

/* Of the lobes: the sum over the lights, without visibility, to about 12 digits of the lobe's peak
 * response. Of truncated lobes the sum is the series' own: it may be negative. */
void reference_quadrature(const reference_surface *surface, const scene_light *lights, size_t count,
                          double radiance[3]);

/* ∫ of f over low … high by the tanh-sinh rule, its step halved until the sum stands still. */
typedef double (*reference_integrand)(double x, void *user);
double reference_integrate(reference_integrand f, void *user, double low, double high);

#endif
