/* SPDX-License-Identifier: MIT */
/* lampion/light.h - lights of every kind, and their exact projection onto spherical harmonics.
 *
 * Seen from a point, a light is a cap (that of a sphere, sphere.h, or one of a fixed angle), a
 * single direction, or, if it is an area, the region that its outline bounds. The ranges of
 * lengths, and what a release build does outside them, are those of sphere.h. */
#ifndef LAMPION_LIGHT_H
#define LAMPION_LIGHT_H

#include <lampion/sphere.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lmp_light_kind {
    LMP_LIGHT_SPHERE = 0,  /* position, radius, radiance */
    LMP_LIGHT_POINT,       /* position, intensity */
    LMP_LIGHT_SPOT,        /* position, direction (axis, from the light), inner, outer, intensity */
    LMP_LIGHT_DIRECTIONAL, /* direction (to the light), irradiance */
    LMP_LIGHT_CAP,         /* direction (to the light), angle, radiance: a sun */
    LMP_LIGHT_HEMISPHERE,  /* direction (up), radiance above, ground below: a sky */
    /* areas */
    LMP_LIGHT_RECTANGLE, /* position, half[0] and [1], two_sided, radiance */
    LMP_LIGHT_DISK,      /* position, direction (normal), radius, two_sided, radiance */
    LMP_LIGHT_TUBE,      /* position, half[0], radius, radiance */
    LMP_LIGHT_POLYGON    /* position, corner_count, corner[0] …, two_sided, radiance */
} lmp_light_kind;
#define LMP_LIGHT_KIND_COUNT (LMP_LIGHT_POLYGON + 1)

/* A light. Zero-initialize it and set the members listed for its kind; the others are ignored.
 *
 * Areas shine with the same radiance in all directions: a rectangle, a disk or a polygon from the
 * side of its normal, or from both if two_sided, and not along its own plane. The position of the
 * first three is their center, and
 *
 *   rectangle   half[0] and half[1] lead from it to the middles of two adjacent sides, at any angle
 *               to each other; the normal is that of half[0] x half[1]
 *   tube        half[0] leads from it to an end of the axis; the tube is all that lies within the
 *               radius of the axis, so its ends are round. Inside, it is the sphere of that radius
 *               around the nearest point of the axis
 *   polygon     corners are relative to the position, in a plane, and counter-clockwise as seen
 *               from the side of the normal; the sides must not cross */
#define LMP_LIGHT_CORNERS_MAX 8
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
    lmp_rgb ground;   /* radiance of a hemisphere light's lower half */
    bool two_sided;   /* whether an area shines from both sides */
    int corner_count; /* 3 … LMP_LIGHT_CORNERS_MAX */
    union {
        lmp_vec3 half[2];
        lmp_vec3 corner[LMP_LIGHT_CORNERS_MAX];
    };
} lmp_light;

/* A light that is not an area, as seen from one point: a cap of at most a hemisphere, plus ambient
 * light,
 *
 *     L_lm = strength R_l(1 - one_minus_cos) Y_lm(axis)  +  2 sqrt(pi) ambient  for l = m = 0
 *
 *   sphere, cap      strength pi L sin²a. If it covers more than a hemisphere (from inside a
 *                    sphere, or angle > pi/2): ambient L minus the complementary cap, so strength
 *                    is negative and the axis points away from the light
 *   point            a Dirac (one_minus_cos 0) of strength intensity / d²
 *   spot             as a point, times saturate((cos - cos outer) / (cos inner - cos outer))²,
 *                    cos being that of the angle from the axis (as in glTF's KHR_lights_punctual;
 *                    the denominator is clamped to at least 1e-3)
 *   directional      a Dirac of strength irradiance
 *   hemisphere       one_minus_cos 1, strength pi (radiance - ground), ambient ground
 *
 * A point or spot light closer than LMP_POINT_DISTANCE_MIN is treated as being that far away; at
 * d = 0 the axis is z. */
#define LMP_POINT_DISTANCE_MIN 1e-6f
typedef struct lmp_cap {
    lmp_vec3 axis;       /* unit */
    float sin2;          /* sin²a, exact however small; 0 for a Dirac */
    float one_minus_cos; /* 1 - cos a in 0 … 1, exact however small; 0 for a Dirac */
    lmp_rgb strength;    /* as listed above for each kind */
    lmp_rgb ambient;     /* radiance from every direction */
} lmp_cap;

/* Finds the cap of `light`, which must not be an area, as seen from `point`, at any distance. */
LMP_API void lmp_light_find_cap(const lmp_light *light, lmp_vec3 point, lmp_cap *cap);

/* --- any light -------------------------------------------------------------------------------- */

/* Computes the zonal coefficients at `point` of a light of unit strength, and their axis, which
 * points to the light (for a hemisphere light, up).
 *
 * light must not be an area, whose coefficients around an axis are not all zonal; zonal receives
 * `bands` values for radiance, intensity or irradiance 1 (for a hemisphere light, radiance 1 above
 * and 0 below); multiply by the light's color */
LMP_API void lmp_light_project_zonal(int bands, const lmp_light *light, lmp_vec3 point,
                                     float *zonal, lmp_vec3 *axis);

/* Projects the sum of `count` lights onto RGB coefficients at `point`.
 *
 * sh receives three planes, red green blue, of LMP_SH_COUNT(bands) values; count may be 0 */
LMP_API void lmp_light_project(int bands, const lmp_light *lights, size_t count, lmp_vec3 point,
                               float *sh);

/* Projects a light of unit strength as lmp_light_project does, and differentiates it with respect
 * to `point`, which may be anywhere but on the outline of an area, where the derivative is
 * infinite.
 *
 * light may be of any kind; its color is not read. sh receives LMP_SH_COUNT(bands) values as in
 * lmp_light_project_zonal, gradient three planes of them, apart from sh: d/dx, d/dy, d/dz. Spheres
 * are differentiated as by lmp_sphere_project_gradient; lights that look alike from everywhere have
 * derivatives of 0, as has a point light at its own position. Inside a tube the derivative is that
 * of the sphere around the nearest point of its axis */
LMP_API void lmp_light_project_gradient(int bands, const lmp_light *light, lmp_vec3 point,
                                        float *sh, float *gradient);

/* Projects the sum of `count` lights as lmp_light_project does, into channels anywhere in memory,
 * LMP_SH_COUNT(bands) values each: those of a probe with padded planes, say, or a single channel. A
 * channel that is NULL is not written. */
LMP_API void lmp_light_project_channels(int bands, const lmp_light *lights, size_t count,
                                        lmp_vec3 point, float *red, float *green, float *blue);

/* Computes the irradiance, W·m⁻², of the sum of `count` lights on a surface at `point` that faces
 * `normal`. It is not a series but the closed form for a cap or an outline that the surface's
 * horizon may cut, exact to 1e-6 of the irradiance on a surface that faces the lights. Ambient
 * light contributes pi times its radiance.
 *
 * normal must be unit; count may be 0 */
LMP_API lmp_rgb lmp_light_irradiance(const lmp_light *lights, size_t count, lmp_vec3 point,
                                     lmp_vec3 normal);

/* --- batches (sh.h) -----------------------------------------------------------------------------
 * Distances and radii are 0 or in 1e-15 … 1e15; otherwise geometry is unrestricted, as above. */

/* Describes the spheres of an array of lights, which may be NULL if it is empty. */
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

/* Sums lights of any kinds at many points, as lmp_light_project does at one: 3 *
 * LMP_SH_COUNT(bands) values per element, red, then green, then blue. visibility[i * point_count +
 * p], 0 … 1, multiplies light i at point p; NULL gives the same bits as 1 everywhere.
 *
 * The order of summation does not depend on which points a call covers. If all lights are spheres,
 * they are added as lmp_sphere_sum_n adds them, to the bit. Otherwise spheres, points and spots
 * come first, in groups of LMP_LIGHT_GROUP whose sums are added in order; the rest follow one by
 * one. The coefficients of those without a position, which are the same everywhere, are computed
 * once for many points, those of areas point by point. */
#define LMP_LIGHT_GROUP 32
LMP_API void lmp_light_project_n(const lmp_scratch *scratch, int bands, const lmp_light *lights,
                                 size_t light_count, const float *visibility, lmp_vec3_array points,
                                 size_t point_count, lmp_sh_array sh);

/* Adds lights to the coefficients that sh already holds, for example when lights are switched on;
 * the arguments are those of lmp_light_project_n. Adding a light with negated colors removes it
 * again, up to a rounding error, each time, of 2^-23 of the largest value that sh held. */
LMP_API void lmp_light_add_n(const lmp_scratch *scratch, int bands, const lmp_light *lights,
                             size_t light_count, const float *visibility, lmp_vec3_array points,
                             size_t point_count, lmp_sh_array sh);

/* --- negligible lights ------------------------------------------------------------------------ */

/* Returns the distance from a light's position beyond which it gives any surface at most this
 * irradiance in every channel. Leaving it out there causes no larger an error in irradiance. The
 * error in n bands of coefficients, as the root of the sum of squares, is at most n / sqrt(pi)
 * times as large, and half that where the light appears small. The irradiances of all lights left
 * out add up.
 *
 * irradiance > 0. Returns 0 if the light never gives more, INFINITY if it has no position and gives
 * more everywhere */
LMP_API float lmp_light_range(const lmp_light *light, float irradiance);

/* --- shaders ---------------------------------------------------------------------------------- */

/* Writes the LMP_AREA_TEXELS texels of 4 values by which area.glsl, which says what they are,
 * lights with `area`, a light that must be one. A rectangle needs the first 7 only, a polygon 3
 * more than it has corners, disks and tubes 3; the rest are 0. */
#define LMP_AREA_TEXELS (3 + LMP_LIGHT_CORNERS_MAX)
LMP_EXPERIMENTAL LMP_API void lmp_light_copy_area_texels(const lmp_light *area, float *texels);

/* --- units ------------------------------------------------------------------------------------ */

/* Convert between the radiance L of a cap of half angle `angle` and its normal irradiance pi sin²a
 * L. 0 < angle <= pi/2. */
LMP_API float lmp_light_cap_irradiance_from_radiance(float radiance, float angle);
LMP_API float lmp_light_cap_radiance_from_irradiance(float irradiance, float angle);

/* Convert between the radiance L of an area and its power, pi L times all of its surface that
 * shines, or its largest intensity, L times the largest area that it turns to any direction. Of the
 * light, which must be an area of more than 0, its color is not read. */
LMP_API float lmp_light_power_from_radiance(const lmp_light *area, float radiance);
LMP_API float lmp_light_radiance_from_power(const lmp_light *area, float power);
LMP_API float lmp_light_intensity_from_radiance(const lmp_light *area, float radiance);
LMP_API float lmp_light_radiance_from_intensity(const lmp_light *area, float intensity);

#ifdef __cplusplus
}
#endif
#endif
