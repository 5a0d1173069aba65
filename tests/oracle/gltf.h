/* SPDX-License-Identifier: MIT */
/* gltf.h - surfaces of glTF 2.0, appendix B under caps of light, integrated in double precision
 * without the library. The normal is z, and x lies in the plane of incidence, on the mirror side.
 */
#ifndef LAMPION_ORACLE_GLTF_H
#define LAMPION_ORACLE_GLTF_H

typedef struct oracle_gltf {
    double alpha, view; /* angle of the view from the normal */
    double f0, f90, diffuse;
} oracle_gltf;

/* Returns the BRDF times the cosine for light from a unit direction, 0 from below the horizon. */
double oracle_gltf_at(const oracle_gltf *surface, const double from[3]);

/* Returns the radiance reflected from a cap of radiance 1, given by its middle and half angle; the
 * horizon cuts it. */
double oracle_gltf_cap(const oracle_gltf *surface, const double middle[3], double half_angle);

/* Returns the fraction of a Phong lobe of integral 1 that lies in a cap whose middle is `to` from
 * its axis. */
double oracle_phong_cap(double exponent, double to, double half_angle);

#endif
