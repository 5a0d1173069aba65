/* SPDX-License-Identifier: MIT */
/* gradient.c - how the coefficients of a light change with the point that it is seen from. */
#include "src/base/precondition.h"
#include "src/light/packed.h"
#include "src/light/seen.h"

#include <lampion/light.h>
#include <lampion/sphere.h>

#include <string.h>

static const double pi = 3.14159265358979323846;

/* A light of a single direction: the way to it, its strength, and how that changes. */
typedef struct dirac {
    lmpi_vector to;
    double strength;
    lmpi_vector change;
} dirac;

static lmpi_vector combined(double s, lmpi_vector a, double t, lmpi_vector b) {
    return lmpi_vector_add(lmpi_vector_scale(a, s), lmpi_vector_scale(b, t));
}

/* Writes the derivatives of strength Y(w), w = to / |to|; uses sh. */
static void differentiate(int bands, const dirac *d, float *sh, float *gradient) {
    const size_t count = LMP_SH_COUNT(bands);
    const double distance = lmpi_vector_length(d->to);
    if (!(distance > 0 && d->strength > 0))
        return;
    const float sideways = (float)(-d->strength / distance);
    const lmp_vec3 change = lmpi_vector_rounded(d->change);
    const float changes[3] = { change.x, change.y, change.z };
    lmp_sh_eval_gradient(bands, lmpi_vector_rounded(lmpi_vector_unit(d->to)), sh, gradient);
    for (size_t a = 0; a < 3; a++)
        for (size_t i = 0; i < count; i++)
            gradient[a * count + i] = sideways * gradient[a * count + i] + changes[a] * sh[i];
}

/* A point, or a spot: saturate((cos - outer) / width)² / d². */
static dirac see_point(const lmp_light *light, lmpi_vector to) {
    const double d = lmpi_vector_length(to), d2 = d * d;
    dirac seen = { to, 1 / d2, lmpi_vector_scale(to, 2 / (d2 * d2)) };
    if (lmpi_light_form_of(light) == LMPI_FORM_CONE) {
        lmpi_packed_light cone;
        lmpi_pack_cone(light, &cone);
        const lmpi_vector axis = lmpi_vector_of(cone.axis), away = lmpi_vector_scale(to, -1 / d);
        const double cosine = lmpi_vector_dot(axis, away);
        const double inside = (cosine - (double)cone.outer) / (double)cone.width;
        const double x = fmin(fmax(inside, 0), 1), slope = inside < 1 ? x : 0;
        const lmpi_vector across = combined(1, axis, -cosine, away);
        seen.change =
            combined(x * x, seen.change, 2 * slope / ((double)cone.width * d2 * d), across);
        seen.strength *= x * x;
    }
    return seen;
}

/* A flat area that looks small. */
static dirac see_flat(const lmpi_area *area, lmpi_vector to) {
    const lmpi_vector center = lmpi_vector_add(to, area->centroid);
    const double d = lmpi_vector_length(center), facing = lmpi_vector_dot(area->area, center);
    const double d3 = d * d * d, side = facing < 0 ? -1 : 1;
    return (dirac) { center, side * facing / d3,
                     combined(-side / d3, area->area, 3 * side * facing / (d3 * d * d), center) };
}

/* A tube that looks small, r (4 half sin + pi r) / d². */
static dirac see_tube(const lmpi_area *area, lmpi_vector to) {
    const double r = (double)area->light->radius, along = lmpi_vector_dot(to, area->axis);
    const lmpi_vector rest = combined(1, to, -along, area->axis);
    const double d = lmpi_vector_length(to), beside = lmpi_vector_length(rest), d2 = d * d;
    const double side = 4 * r * area->half / (d2 * d), end = pi * r * r / d2;
    return (
        dirac) { to, side * beside + end,
                 combined((3 * side * beside + 2 * end) / d2, to, -side, lmpi_vector_unit(rest)) };
}

/* Where a tube is seen as a sphere: the end that faces the point or, from inside, the sphere around
 * the nearest point of the axis, which moves along between the ends. */
static void differentiate_sphere(int bands, const lmpi_area *area, lmpi_vector to,
                                 const lmp_cap *cap, float *sh, float *gradient) {
    const size_t count = LMP_SH_COUNT(bands);
    const float sine = sqrtf(cap->sin2), radius = area->light->radius;
    const bool inside = cap->ambient.r > 0;
    const float distance = inside ? -radius * sine : radius / sine;
    const lmp_vec3 center = { cap->axis.x * distance, cap->axis.y * distance,
                              cap->axis.z * distance };
    lmp_sphere_project_gradient(bands, center, radius, (lmp_vec3) { 0, 0, 0 }, sh, gradient);
    if (!inside || fabs(lmpi_vector_dot(to, area->axis)) > area->half)
        return;
    const lmp_vec3 axis = lmpi_vector_rounded(area->axis);
    for (size_t i = 0; i < count; i++) {
        float *x = gradient + i, *y = x + count, *z = y + count;
        const float along = *x * axis.x + *y * axis.y + *z * axis.z;
        *x -= along * axis.x, *y -= along * axis.y, *z -= along * axis.z;
    }
}

/* Projects an area, whose color must be white, as well as its derivatives. */
static LMPI_NOINLINE void differentiate_area(int bands, const lmp_light *light, lmp_vec3 point,
                                             float *sh, float *gradient) {
    float *const planes[3] = { sh, NULL, NULL };
    const lmpi_vector to = lmpi_vector_sub(lmpi_vector_of(light->position), lmpi_vector_of(point));
    lmpi_area area;
    lmpi_seen seen;
    lmpi_area_prepare(light, &area);
    lmpi_area_see(&area, point, &seen);
    lmpi_seen_close(&seen);
    if (seen.is_loop) {
        lmpi_loop_gradient(bands, &seen.loop, gradient);
    } else if (seen.cap.sin2 > 0) {
        differentiate_sphere(bands, &area, to, &seen.cap, sh, gradient);
    } else if (seen.cap.strength.r > 0) {
        const dirac far = lmpi_area_is_tube(light) ? see_tube(&area, to) : see_flat(&area, to);
        differentiate(bands, &far, sh, gradient);
    }
    memset(sh, 0, LMP_SH_COUNT(bands) * sizeof *sh);
    lmpi_seen_add(0, bands, &seen, planes);
}

void lmp_light_project_gradient(int bands, const lmp_light *light, lmp_vec3 point, float *sh,
                                float *gradient) {
    const size_t count = LMP_SH_COUNT(bands);
    assert(lmpi_is_bands(bands) && lmpi_are_apart(sh, count, gradient, 3 * count));
    lmp_light unit = *light;
    unit.radiance = (lmp_rgb) { 1, 1, 1 };
    unit.ground = (lmp_rgb) { 0, 0, 0 };
    memset(gradient, 0, 3 * count * sizeof *gradient);
    if (lmpi_light_form_of(light) == LMPI_FORM_SPHERE) {
        lmp_sphere_project_gradient(bands, light->position, light->radius, point, sh, gradient);
        return;
    }
    if (lmpi_light_is_area(light)) {
        differentiate_area(bands, &unit, point, sh, gradient);
        return;
    }
    if (!lmpi_light_is_fixed(light)) {
        const dirac near = see_point(
            light, lmpi_vector_sub(lmpi_vector_of(light->position), lmpi_vector_of(point)));
        differentiate(bands, &near, sh, gradient);
    }
    lmp_light_project_channels(bands, &unit, 1, point, sh, NULL, NULL);
}
