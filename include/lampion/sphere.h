/* SPDX-License-Identifier: MIT */
/* lampion/sphere.h - uniform spheres, and their exact projection onto spherical harmonics.
 *
 * Seen from a point, a sphere of radius r at distance d covers a spherical cap of half angle a,
 * sin a = r/d, around the direction w to its center. For uniform radiance L its coefficients are
 *
 *     Z_l  = sqrt(pi (2l+1)) / 2 L sin²a R_l(cos a)   with z along w     (paper Eq. 12)
 *     L_lm = pi L sin²a R_l(cos a) Y_lm(w)            in any frame       (paper Eq. 13)
 *
 * where R_l is the Jacobi polynomial P^(1,1)_(l-1) scaled to R_l(1) = 1, and R_0 = 2 / (1 + cos a).
 * Built from differences, it is exact in float32 however small or far a light (docs/accuracy.md).
 *
 * Inside the sphere (d < r) the cap keeps growing, from the hemisphere at the surface to the full
 * sphere at the center: sin²a = d²/r², cos a = -sqrt(1 - sin²a). This is a convention, not physics,
 * and it is continuous everywhere.
 *
 * Coordinates and radii are at most LMP_LENGTH_MAX in magnitude. Lengths below 1e-18 lose digits,
 * because their squares do, and may count as 0. A release build, which asserts nothing (base.h),
 * gives finite values for finite lights and points as long as the squares of their distances are
 * finite (1e19), but meaningless ones outside the range. */
#ifndef LAMPION_SPHERE_H
#define LAMPION_SPHERE_H

#include <lampion/sh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The largest magnitude of coordinates and radii, for which squares of distances stay finite. */
#define LMP_LENGTH_MAX 1e17f

/* Computes the zonal coefficients Z_l of a sphere of unit radiance (paper Eq. 12).
 *
 * radius >= 0, distance >= 0; zonal receives `bands` values, in the frame whose z axis points to
 * the center (also from inside) */
LMP_API void lmp_sphere_project_zonal(int bands, float radius, float distance, float *zonal);

/* Projects a sphere of unit radiance onto coefficients at `point` (paper Eq. 12 and 13 combined).
 *
 * radius >= 0; sh receives LMP_SH_COUNT(bands) values */
LMP_API void lmp_sphere_project(int bands, lmp_vec3 center, float radius, lmp_vec3 point,
                                float *sh);

/* Projects a sphere as lmp_sphere_project does, in double, for research (sh.h). */
LMP_API void lmp_sphere_project_double(int bands, const double center[3], double radius,
                                       const double point[3], double *sh);

/* Projects a sphere as lmp_sphere_project does, and differentiates it with respect to `point`.
 *
 * gradient receives three planes of LMP_SH_COUNT(bands) values: d/dx, d/dy, d/dz. The derivative is
 * infinite on the sphere's surface, so its factor 1/|cos a| is clamped to 1/LMP_COS_MIN. At the
 * center the direction is taken to be z. radius and distance must not both be 0 */
#define LMP_COS_MIN 0.02f
LMP_API void lmp_sphere_project_gradient(int bands, lmp_vec3 center, float radius, lmp_vec3 point,
                                         float *sh, float *gradient);

/* --- batches (sh.h): distances and radii are 0 or in 1e-15 … 1e15 ----------------------------- */

/* Spheres in any memory layout; lmp_spheres_of (light.h) describes those of an array of lights. */
typedef struct lmp_spheres {
    lmp_vec3_array center;
    lmp_float_array radius;
    lmp_vec3_array radiance; /* red, green, blue */
} lmp_spheres;

/* Computes zonal coefficients for many pairs of radius and distance: `bands` values each. */
LMP_API void lmp_sphere_project_zonal_n(int bands, lmp_float_array radii, lmp_float_array distances,
                                        size_t count, lmp_sh_array zonal);

/* Projects sphere i at point i, for radiance 1: LMP_SH_COUNT(bands) values per element. */
LMP_API void lmp_sphere_project_n(int bands, const lmp_spheres *spheres, lmp_vec3_array points,
                                  size_t count, lmp_sh_array sh);

/* Projects every sphere at every point, for radiance 1: element p * sphere_count + i is sphere i at
 * point p, LMP_SH_COUNT(bands) values. */
LMP_API void lmp_sphere_project_all_n(int bands, const lmp_spheres *spheres, size_t sphere_count,
                                      lmp_vec3_array points, size_t point_count, lmp_sh_array sh);

/* Sums the same spheres at many points, as lmp_light_project does at one: 3 * LMP_SH_COUNT(bands)
 * values per element, red, then green, then blue. visibility[i * point_count + p], 0 … 1, is the
 * fraction of the light of sphere i that your own occluders let through to point p; NULL gives the
 * same bits as 1 everywhere. Spheres are added in order, so the bits of a point do not depend on
 * the other points in the call. Scratch memory (base.h) pays off from 16 bands on. */
LMP_API void lmp_sphere_sum_n(const lmp_scratch *scratch, int bands, const lmp_spheres *spheres,
                              size_t sphere_count, const float *visibility, lmp_vec3_array points,
                              size_t point_count, lmp_sh_array sh);

/* Sums the same spheres at many points, as lmp_sphere_sum_n does without visibility, and
 * differentiates the sums as lmp_sphere_project_gradient does: gradient receives 9 *
 * LMP_SH_COUNT(bands) values per element, d/dx of red, green, blue, then d/dy, then d/dz. */
LMP_API void lmp_sphere_sum_gradient_n(const lmp_scratch *scratch, int bands,
                                       const lmp_spheres *spheres, size_t sphere_count,
                                       lmp_vec3_array points, size_t point_count, lmp_sh_array sh,
                                       lmp_sh_array gradient);

/* --- units ------------------------------------------------------------------------------------ */

/* Convert between the radiance L of a uniform sphere and its power 4 pi² r² L or its intensity pi
 * r² L, both exact at any distance. radius > 0. */
LMP_API float lmp_sphere_power_from_radiance(float radiance, float radius);
LMP_API float lmp_sphere_radiance_from_power(float power, float radius);
LMP_API float lmp_sphere_intensity_from_radiance(float radiance, float radius);
LMP_API float lmp_sphere_radiance_from_intensity(float intensity, float radius);

#ifdef __cplusplus
}
#endif
#endif
