/* SPDX-License-Identifier: MIT */
/* sheen.h - white sheen as KHR_materials_sheen specifies them, in double precision without the
 * library. The normal is z; light and view are unit and above the horizon; cosines below 1e-4 are
 * taken as 1e-4. */
#ifndef LAMPION_ORACLE_SHEEN_H
#define LAMPION_ORACLE_SHEEN_H

/* Returns f_r by the specification's formulas, whose smooth sheen reflects more than arrives. */
double oracle_sheen_unlimited(double roughness, const double light[3], const double view[3]);

/* Returns what these formulas reflect of a uniform sky to a view of some cosine, within 0.1 %. */
double oracle_sheen_gain(double roughness, double cosine);

/* Returns f_r by the formulas, divided by the larger of the gains toward light and view where it
 * exceeds 1. */
double oracle_sheen(double roughness, const double light[3], const double view[3]);

/* Returns E, what a whole sky gives to a view at an angle from the normal. */
double oracle_sheen_albedo(double roughness, double angle);

/* Returns what a cap of radiance 1 gives; its middle lies at `to` from the normal in the plane of
 * the view and on its side, and the horizon cuts it. */
double oracle_sheen_cap(double roughness, double to, double half_angle, double angle);

#endif
