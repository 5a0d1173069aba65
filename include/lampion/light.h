/* SPDX-License-Identifier: MIT */
/* lampion/light.h - lights, and their exact projection onto spherical harmonics.
 *
 * Seen from a point, a sphere of radius r at distance d covers a spherical cap of half angle a,
 * sin a = r/d, around the direction w to its center. Uniform radiance L makes its coefficients
 *
 *     Z_l  = sqrt(pi (2l+1)) / 2 L sin²a R_l(cos a)   where z is w       (paper Eq. 12)
 *     L_lm = pi L sin²a R_l(cos a) Y_lm(w)            in any frame       (paper Eq. 13)
 *
 * with R_l the Jacobi polynomial P^(1,1)_(l-1) scaled to R_l(1) = 1, and R_0 = 2 / (1 + cos a).
 * R_l is evaluated by its differences, which keeps float32 exact for lights however small or far;
 * paper Eq. 12 as printed loses them below r/d = 0.01 (docs/accuracy.md).
 *
 * Inside the sphere (d < r) the cap goes on growing, from the hemisphere at the surface to the full
 * sphere at the center: sin²a = d²/r², cos a = -sqrt(1 - sin²a). That is a convention, not physics;
 * values are continuous everywhere, at the surface and at the center too.
 *
 * Coordinates and radii are at most LMP_LENGTH_MAX in magnitude. Lengths below 1e-18 lose digits,
 * for their squares do, and may count as 0. A release build, which asserts nothing (base.h), gives
 * finite values for finite lights and points as long as the squares of their distances are finite
 * (1e19), of no meaning where these are out of range. */
#ifndef LAMPION_LIGHT_H
#define LAMPION_LIGHT_H

#include <lampion/sh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* So that the square of any distance is a float32. */
#define LMP_LENGTH_MAX 1e17f

typedef enum lmp_light_kind {
    LMP_LIGHT_SPHERE = 0,  /* position, radius, radiance */
    LMP_LIGHT_POINT,       /* position, intensity */
    LMP_LIGHT_SPOT,        /* position, direction (axis, from the light), inner, outer, intensity */
    LMP_LIGHT_DIRECTIONAL, /* direction (to the light), irradiance */
    LMP_LIGHT_CAP,         /* direction (to the light), angle, radiance: a sun */
    LMP_LIGHT_HEMISPHERE   /* direction (up), radiance above, ground below: a sky */
} lmp_light_kind;
#define LMP_LIGHT_KINDS (LMP_LIGHT_HEMISPHERE + 1) /* of the last one */

/* A light; zero-initialize it and set the members its kind names. Unused members are ignored. */
typedef struct lmp_light {
    lmp_light_kind kind;
    lmp_vec3 position;
    lmp_vec3 direction; /* unit */
    float radius;       /* >= 0, in the unit of position */
    float angle;        /* half angle of a cap, radians, 0 … pi */
    float inner, outer; /* half angles of a spot, radians, 0 <= inner <= outer <= pi */
    union {
        lmp_rgb radiance;   /* W·sr⁻¹·m⁻² */
        lmp_rgb intensity;  /* W·sr⁻¹ */
        lmp_rgb irradiance; /* W·m⁻², on a surface that faces the light */
    };
    lmp_rgb ground; /* radiance of a hemisphere light's lower half */
} lmp_light;

/* What any light is from one point: a cap of at most a hemisphere, plus ambient light,
 *
 *     L_lm = strength R_l(1 - one_minus_cos) Y_lm(axis)  +  2 sqrt(pi) ambient  for l = m = 0
 *
 *   sphere, cap      strength pi L sin²a. Seen as more than a hemisphere (from inside a sphere, or
 *                    angle > pi/2): ambient L less the complementary cap, so strength is negative
 *                    and the axis points away from the light
 *   point            a Dirac (one_minus_cos 0) of strength intensity / d²
 *   spot             the same, times saturate((cos - cos outer) / (cos inner - cos outer))² of the
 *                    angle off its axis (as glTF's KHR_lights_punctual; the difference is held to
 *                    1e-3 and up)
 *   directional      a Dirac of strength irradiance
 *   hemisphere       one_minus_cos 1, strength pi (radiance - ground), ambient ground
 *
 * A point or spot light closer than LMP_POINT_DISTANCE_MIN counts as that far; at d = 0 the axis is
 * z. */
#define LMP_POINT_DISTANCE_MIN 1e-6f
typedef struct lmp_cap {
    lmp_vec3 axis;       /* unit */
    float sin2;          /* sin²a, exact however small; 0 for a Dirac */
    float one_minus_cos; /* 1 - cos a in 0 … 1, exact however small; 0 for a Dirac */
    lmp_rgb strength;    /* see above */
    lmp_rgb ambient;     /* radiance from every direction */
} lmp_cap;

/* The cap that `light` is from `point`, at any distance. */
LMP_API void lmp_light_cap(const lmp_light *light, lmp_vec3 point, lmp_cap *cap);

/* --- one sphere ------------------------------------------------------------------------------- */

/* Zonal coefficients Z_l of a sphere of unit radiance (paper Eq. 12).
 *
 * radius >= 0, distance >= 0; zonal receives `bands` values, in the frame whose z points to the
 * center (inside as well) */
LMP_API void lmp_sphere_zonal(int bands, float radius, float distance, float *zonal);

/* Coefficients at `point` of a sphere of unit radiance (paper Eq. 12 and 13 in one).
 *
 * radius >= 0; sh receives LMP_SH_COUNT(bands) values */
LMP_API void lmp_sphere_project(int bands, lmp_vec3 center, float radius, lmp_vec3 point,
                                float *sh);

/* The same in double, for research (sh.h). */
LMP_API void lmp_sphere_project_double(int bands, const double center[3], double radius,
                                       const double point[3], double *sh);

/* lmp_sphere_project, with the derivatives of every coefficient by the point's position.
 *
 * gradient receives three planes of LMP_SH_COUNT(bands) values: d/dx, d/dy, d/dz. The derivative
 * is infinite on the sphere's surface: its 1/|cos a| is held to 1/LMP_COS_MIN. At the center the
 * direction is taken as z. radius and distance not both 0 */
#define LMP_COS_MIN 0.02f
LMP_API void lmp_sphere_project_gradient(int bands, lmp_vec3 center, float radius, lmp_vec3 point,
                                         float *sh, float *gradient);

/* --- any light -------------------------------------------------------------------------------- */

/* Zonal coefficients at `point` of a light of unit strength, and the axis they are around: towards
 * the light (a hemisphere light: up).
 *
 * zonal receives `bands` values for radiance, intensity or irradiance 1 (a hemisphere light: for
 * radiance 1 above and 0 below); multiply by the light's color */
LMP_API void lmp_light_zonal(int bands, const lmp_light *light, lmp_vec3 point, float *zonal,
                             lmp_vec3 *axis);

/* RGB coefficients at `point` of the sum of `count` lights.
 *
 * sh receives three planes, red green blue, of LMP_SH_COUNT(bands) values; count may be 0 */
LMP_API void lmp_light_project(int bands, const lmp_light *lights, size_t count, lmp_vec3 point,
                               float *sh);

/* The same to channels wherever they are, LMP_SH_COUNT(bands) values each: a probe whose planes are
 * padded, or one channel alone. Of those that are NULL nothing is written. */
LMP_API void lmp_light_project_channels(int bands, const lmp_light *lights, size_t count,
                                        lmp_vec3 point, float *red, float *green, float *blue);

/* Irradiance, W·m⁻², at `point` of a surface that faces `normal`, of the sum of `count` lights: no
 * series but the closed form of a cap that the surface's horizon may cut, exact to 1e-6 of what the
 * lights give a surface that faces them. Ambient light counts pi times.
 *
 * normal must be unit; count may be 0 */
LMP_API lmp_rgb lmp_light_irradiance(const lmp_light *lights, size_t count, lmp_vec3 point,
                                     lmp_vec3 normal);

/* --- batches (sh.h) -----------------------------------------------------------------------------
 * Distances and radii are 0 or in 1e-15 … 1e15; geometry is otherwise free, as above. */

/* Sphere lights, wherever their members are: lmp_spheres_of reads an array of lmp_light. Stride 0
 * makes one value serve all. */
typedef struct lmp_spheres {
    lmp_vec3_array center;
    lmp_float_array radius;
    lmp_vec3_array radiance; /* red, green, blue */
} lmp_spheres;
static inline lmp_spheres lmp_spheres_of(const lmp_light *lights) {
    lmp_spheres spheres = { { NULL, NULL, NULL, sizeof(lmp_light) },
                            { NULL, sizeof(lmp_light) },
                            { NULL, NULL, NULL, sizeof(lmp_light) } };
    if (lights) {
        spheres.center.x = &lights->position.x;
        spheres.center.y = &lights->position.y;
        spheres.center.z = &lights->position.z;
        spheres.radius.at = &lights->radius;
        spheres.radiance.x = &lights->radiance.r;
        spheres.radiance.y = &lights->radiance.g;
        spheres.radiance.z = &lights->radiance.b;
    }
    return spheres;
}

/* lmp_sphere_zonal of many pairs of radius and distance: `bands` values an element. */
LMP_API void lmp_sphere_zonal_n(int bands, lmp_float_array radii, lmp_float_array distances,
                                size_t count, lmp_sh_layout layout, size_t stride, float *zonal);

/* lmp_sphere_project of sphere i at point i: LMP_SH_COUNT(bands) values an element, for radiance 1;
 * radiance is not read. */
LMP_API void lmp_sphere_project_n(int bands, const lmp_spheres *spheres, lmp_vec3_array points,
                                  size_t count, lmp_sh_layout layout, size_t stride, float *sh);

/* The same for every pair: element p * sphere_count + i is sphere i at point p. */
LMP_API void lmp_sphere_project_all(int bands, const lmp_spheres *spheres, size_t sphere_count,
                                    lmp_vec3_array points, size_t point_count, lmp_sh_layout layout,
                                    size_t stride, float *sh);

/* lmp_light_project of the same spheres at many points: 3 * LMP_SH_COUNT(bands) values an element,
 * red, then green, then blue. Spheres are added in their order: the bits of a point do not depend
 * on the other points of the call. Scratch (base.h) pays from 16 bands on. */
LMP_API void lmp_sphere_accumulate_n(const lmp_scratch *scratch, int bands,
                                     const lmp_spheres *spheres, size_t sphere_count,
                                     lmp_vec3_array points, size_t point_count,
                                     lmp_sh_layout layout, size_t stride, float *sh);

/* The same of what comes past your own blockers: visibility[i * point_count + p], 0 … 1, of sphere
 * i at point p multiplies its light there; NULL: all comes, the same bits. */
LMP_API void lmp_sphere_accumulate_visible_n(const lmp_scratch *scratch, int bands,
                                             const lmp_spheres *spheres, size_t sphere_count,
                                             const float *visibility, lmp_vec3_array points,
                                             size_t point_count, lmp_sh_layout layout,
                                             size_t stride, float *sh);

/* lmp_sphere_accumulate_n, and the derivatives by the point's position, as
 * lmp_sphere_project_gradient: gradient receives 9 * LMP_SH_COUNT(bands) values an element, d/dx of
 * red, green, blue, then d/dy, d/dz. */
LMP_API void lmp_sphere_accumulate_gradient_n(const lmp_scratch *scratch, int bands,
                                              const lmp_spheres *spheres, size_t sphere_count,
                                              lmp_vec3_array points, size_t point_count,
                                              lmp_sh_layout layout, size_t stride, float *sh,
                                              size_t gradient_stride, float *gradient);

/* lmp_light_project at many points: 3 * LMP_SH_COUNT(bands) values an element, red, then green,
 * then blue, of the sum of lights of any kinds. visibility as above, for every light; NULL: all
 * comes, the same bits.
 *
 * Sums have one order, whatever points a call is about: spheres alone are added as
 * lmp_sphere_accumulate_n adds them, to the bit. Of other lights those at positions come first, in
 * groups of LMP_LIGHT_GROUP whose sums are added one after the other, then the others one by one,
 * whose coefficients are the same everywhere and are found once for many points. */
#define LMP_LIGHT_GROUP 32
LMP_API void lmp_light_project_n(const lmp_scratch *scratch, int bands, const lmp_light *lights,
                                 size_t light_count, const float *visibility, lmp_vec3_array points,
                                 size_t point_count, lmp_sh_layout layout, size_t stride,
                                 float *sh);

/* The same added to what sh holds: lights that are switched on. One whose colors are negated is
 * taken away again, up to rounding, of each time 2^-23 of the most that sh held. */
LMP_API void lmp_light_add_n(const lmp_scratch *scratch, int bands, const lmp_light *lights,
                             size_t light_count, const float *visibility, lmp_vec3_array points,
                             size_t point_count, lmp_sh_layout layout, size_t stride, float *sh);

/* --- lights that do not matter ------------------------------------------------------------------
 */

/* The distance from its position beyond which a light gives any surface at most this irradiance, in
 * every channel; so much, too, is the error of leaving it out there. That of n bands of its
 * coefficients, the root of the sum of their squares, is then at most n / sqrt(pi) times as much,
 * and half of that where the light looks small. Irradiances of lights left out add up.
 *
 * irradiance > 0. 0: it is never more. INFINITY: the light has no position, and is more everywhere
 */
LMP_API float lmp_light_range(const lmp_light *light, float irradiance);

/* --- units ------------------------------------------------------------------------------------ */

/* Of a sphere with uniform radiance L: power 4 pi² r² L, intensity pi r² L, both exact at any
 * distance. radius > 0. */
LMP_API float lmp_sphere_power_from_radiance(float radiance, float radius);
LMP_API float lmp_sphere_radiance_from_power(float power, float radius);
LMP_API float lmp_sphere_intensity_from_radiance(float radiance, float radius);
LMP_API float lmp_sphere_radiance_from_intensity(float intensity, float radius);

/* Of a cap of half angle `angle` <= pi/2: normal irradiance pi sin²a L. angle > 0. */
LMP_API float lmp_cap_irradiance_from_radiance(float radiance, float angle);
LMP_API float lmp_cap_radiance_from_irradiance(float irradiance, float angle);

#ifdef __cplusplus
}
#endif
#endif
