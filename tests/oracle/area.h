/* SPDX-License-Identifier: MIT */
/* area.h - areas by quadrature over their surface, which is divided until each part is small for
 * its distance: an integrand of the solid angle, where the library follows the outline. */
#ifndef LAMPION_AREA_H
#define LAMPION_AREA_H

#include <lampion/light.h>

/* A direction from the point and the solid angle that it stands for. */
typedef void oracle_direction(const double w[3], double solid_angle, void *user);

/* Hands over directions whose sum is the integral over all that is seen of an area from a point
 * outside it, for integrands of at most `bands` bands. */
void oracle_area(const lmp_light *light, const double point[3], int bands, oracle_direction *use,
                 void *user);

/* Computes the coefficients of an area of radiance 1, and ∫ P_l(q·w) dw. */
void oracle_area_project(const lmp_light *light, const double point[3], int bands, double *sh);
void oracle_area_moments(const lmp_light *light, const double point[3], int bands,
                         const double q[3], double *moments);
/* Computes the irradiance of a surface that faces the unit normal. */
double oracle_area_irradiance(const lmp_light *light, const double point[3],
                              const double normal[3]);

#endif
