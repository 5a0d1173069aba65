/* SPDX-License-Identifier: MIT */
/* gltf.h - surfaces under caps of light as glTF 2.0, appendix B says they look, integrated in
 * double precision: nothing of the library. The normal is z, and x lies in the plane of incidence,
 * on the mirror side. */
#ifndef LAMPION_ORACLE_GLTF_H
#define LAMPION_ORACLE_GLTF_H

typedef struct oracle_gltf {
    double alpha, view; /* angle of the view from the normal */
    double f0, f90, diffuse;
} oracle_gltf;

/* Radiance reflected from a cap of radiance 1, by its middle and half angle; the horizon cuts it.
 */
double oracle_gltf_cap(const oracle_gltf *surface, const double middle[3], double half_angle);

/* The part of a Phong lobe that integrates to 1 in a cap whose middle is `to` from its axis. */
double oracle_phong_cap(double exponent, double to, double half_angle);

#endif
