/* SPDX-License-Identifier: MIT */
/* oracle.h - the reference the library is held to: double precision, slow, written from the
 * definitions (associated Legendre functions, angles, quadrature), without calling the library.
 *
 * Directions are normalized here, so they may have any length. Arrays are as in lampion/sh.h. */
#ifndef LAMPION_ORACLE_H
#define LAMPION_ORACLE_H

#include <stddef.h>

#define ORACLE_BANDS_MAX 128
#define ORACLE_PI        3.14159265358979323846

/* Computes P_l(t), l < bands. */
void oracle_legendre(int bands, double t, double *p);

/* Computes Y_lm(w), paper Eq. 1-2 with the Condon-Shortley sign. */
void oracle_sh_eval(int bands, const double w[3], double *sh);

/* Computes nodes and weights of Gauss-Legendre quadrature on [-1, 1]; nodes ascend. */
void oracle_gauss_legendre(int count, double *nodes, double *weights);

/* Computes the coefficients of a function by Gauss-Legendre in z (`nodes` of them) and 2*nodes
 * azimuths: exact for functions band-limited to degree 2*nodes - bands. */
typedef double (*oracle_function)(const double w[3], void *user);
void oracle_project(int bands, oracle_function function, void *user, int nodes, double *sh);

/* Computes the zonal coefficients of a cap of radiance 1, one_minus_cos = 1 - cos a in 0 … 2: the
 * integral of Y_l0 over the cap. */
void oracle_cap_zonal(int bands, double one_minus_cos, double *zonal);

/* Returns the irradiance of a surface whose normal has this cosine with the axis of a cap of
 * radiance 1, by quadrature over the part of the cap above the horizon. */
double oracle_irradiance(double cosine, double one_minus_cos);

/* Computes the coefficients of a cap around `axis` by quadrature over the cap itself, in two
 * dimensions. */
void oracle_cap(int bands, const double axis[3], double one_minus_cos, double *sh);

/* Computes the coefficients at `point` of a sphere of radiance 1; on and inside it, by the
 * convention of lampion/light.h. gradient (may be NULL) receives three planes d/dx d/dy d/dz by the
 * point's position. */
void oracle_sphere(int bands, const double center[3], double radius, const double point[3],
                   double *sh, double *gradient);

/* Compute lambda_l = 2 pi ∫ k(t) P_l(t) dt by quadrature, for the kernels of lampion/lobe.h. */
void oracle_lobe_diffuse(int bands, double *lambda);
void oracle_lobe_phong(int bands, double exponent, double *lambda);
void oracle_lobe_vmf(int bands, double concentration, double *lambda);

/* Computes the matrices M^l of f'(w) = f(R^T w), R row-major, by exact quadrature: M^l_mk = ∫
 * Y_lm(Rw) Y_lk(w) dw. Costs bands^5: for few bands. */
void oracle_rotation(int bands, const double rotation[9], double *matrices);

/* Computes the rotation matrix of a quaternion (x, y, z, w) of any length. */
void oracle_quaternion_matrix(const double q[4], double rotation[9]);

#endif
