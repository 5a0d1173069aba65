/* SPDX-License-Identifier: MIT */
/* sheen.h - white fibers as KHR_materials_sheen writes them down, in double precision: nothing of
 * the library. The normal is z; light and view are unit and above the horizon. */
#ifndef LAMPION_ORACLE_SHEEN_H
#define LAMPION_ORACLE_SHEEN_H

double oracle_sheen(double roughness, const double light[3], const double view[3]);

/* E, what a whole sky gives to a view at an angle from the normal. */
double oracle_sheen_albedo(double roughness, double angle);

/* What a cap of radiance 1 gives, its middle at `to` from the normal in the plane of the view and
 * on its side; the horizon cuts it. */
double oracle_sheen_cap(double roughness, double to, double half, double angle);

#endif
