/* SPDX-License-Identifier: MIT */
/* areas.h - random areas, and points from which they look as strange as they can. */
#ifndef LAMPION_AREAS_H
#define LAMPION_AREAS_H

#include "tests/oracle/area.h"
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/lampion.h>

#include <math.h>
#include <string.h>

static const lmp_light_kind area_kinds[] = { LMP_LIGHT_RECTANGLE, LMP_LIGHT_DISK, LMP_LIGHT_TUBE,
                                             LMP_LIGHT_POLYGON };
static const char *const area_names[] = { "rectangle", "disk", "tube", "polygon" };
enum { AREA_KINDS = sizeof area_kinds / sizeof *area_kinds };

static inline lmp_vec3 area_sum(lmp_vec3 a, double factor, lmp_vec3 b) {
    const float f = (float)factor;
    return (lmp_vec3) { a.x + f * b.x, a.y + f * b.y, a.z + f * b.z };
}

/* Finds unit vectors x and y that make a right-handed frame with z. */
static inline void area_frame(lmp_vec3 z, lmp_vec3 *x, lmp_vec3 *y) {
    const lmp_vec3 d = check_random_direction();
    const lmp_vec3 c = { d.y * z.z - d.z * z.y, d.z * z.x - d.x * z.z, d.x * z.y - d.y * z.x };
    const float each = 1 / sqrtf(c.x * c.x + c.y * c.y + c.z * c.z);
    *x = (lmp_vec3) { c.x * each, c.y * each, c.z * each };
    *y = (lmp_vec3) { z.y * x->z - z.z * x->y, z.z * x->x - z.x * x->z, z.x * x->y - z.y * x->x };
}

/* Makes a square of 2 x 2 in the plane of x and y. */
static inline lmp_light area_square(bool two_sided) {
    return (lmp_light) { .kind = LMP_LIGHT_RECTANGLE,
                         .half = { { 1, 0, 0 }, { 0, 1, 0 } },
                         .two_sided = two_sided,
                         .radiance = { 1, 2, 3 } };
}

/* A light, and a point somewhere on it. */
typedef struct random_area {
    lmp_light light;
    double size; /* the distance of its farthest point from its position */
    lmp_vec3 normal, x, y, on;
} random_area;

/* Makes the corners of a star around the position, which need not be convex. */
static inline void area_corners(random_area *a, double size) {
    const int count = 3 + (int)(check_random() * (LMP_LIGHT_CORNERS_MAX - 2));
    const double start = check_random();
    a->light.corner_count = count;
    for (int i = 0; i < count; i++) {
        const double angle = 2 * ORACLE_PI * (i + start + 0.3 * check_random()) / count;
        const double r = size * check_random_between(0.4, 1);
        a->light.corner[i] =
            area_sum(area_sum((lmp_vec3) { 0, 0, 0 }, r * cos(angle), a->x), r * sin(angle), a->y);
    }
}

static inline random_area area_random(lmp_light_kind kind) {
    random_area a = { .light = { .kind = kind, .radiance = { 1, 1, 1 } } };
    const double size = pow(10, check_random_between(-1, 1));
    const double thin = pow(10, check_random_between(-2, 0)), r = size * sqrt(check_random());
    const double angle = check_random_between(0, 2 * ORACLE_PI), u = check_random_between(-1, 1);
    const double v = check_random_between(-1, 1);
    const lmp_vec3 none = { 0, 0, 0 };
    lmp_light *l = &a.light;
    l->position = area_sum(none, 3 * check_random(), check_random_direction());
    l->two_sided = check_random() < 0.5;
    a.normal = check_random_direction();
    area_frame(a.normal, &a.x, &a.y);
    a.size = size;
    if (kind == LMP_LIGHT_RECTANGLE) {
        l->half[0] = area_sum(none, size, a.x);
        l->half[1] = area_sum(none, thin * size, a.y);
        a.on = area_sum(area_sum(l->position, u, l->half[0]), v, l->half[1]);
    } else if (kind == LMP_LIGHT_DISK) {
        l->direction = a.normal;
        l->radius = (float)size;
        a.on = area_sum(area_sum(l->position, r * cos(angle), a.x), r * sin(angle), a.y);
    } else if (kind == LMP_LIGHT_TUBE) {
        l->half[0] = area_sum(none, size, a.x);
        l->radius = (float)(thin * size);
        a.on = area_sum(l->position, u, l->half[0]);
    } else {
        area_corners(&a, size);
        a.on = area_sum(l->position, check_random(), l->corner[0]);
    }
    return a;
}

/* Reangles a point at 1e-4 … 1e4 sizes from the light: in any direction from its middle or from a
 * point on it, straight over that point, or nearly in its plane. */
static inline lmp_vec3 area_point(const random_area *a) {
    const double distance = a->size * pow(10, check_random_between(-4, 4));
    const double choice = check_random(), angle = check_random_between(0, 2 * ORACLE_PI);
    if (a->light.kind == LMP_LIGHT_TUBE) {
        const double r = (double)a->light.radius;
        if (choice < 0.3) /* beside it, at a right angle to its axis */
            return area_sum(area_sum(a->on, (r + distance) * cos(angle), a->y),
                            (r + distance) * sin(angle), a->normal);
        if (choice < 0.4) /* nearly along its axis */
            return area_sum(area_sum(a->light.position, a->size + r + distance, a->x),
                            2 * r * check_random(), a->y);
        return area_sum(a->light.position, a->size + r + distance, check_random_direction());
    }
    if (choice < 0.25)
        return area_sum(a->on, distance, a->normal);
    if (choice < 0.5)
        return area_sum(a->on, distance, check_random_direction());
    if (choice < 0.75)
        return area_sum(a->light.position, distance, check_random_direction());
    const double away = a->size * check_random_between(1, 5);
    const lmp_vec3 level =
        area_sum(area_sum(a->light.position, away * cos(angle), a->x), away * sin(angle), a->y);
    return area_sum(level, (check_random() < 0.5 ? 1 : -1) * fmin(distance, a->size), a->normal);
}

#endif
