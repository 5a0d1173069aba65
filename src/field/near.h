/* SPDX-License-Identifier: MIT */
/* near.h - the lists of the lights that are near each block of cells. */
#ifndef LAMPION_FIELD_NEAR_H
#define LAMPION_FIELD_NEAR_H

#include "src/field/grid.h"
#include "src/light/packed.h"

#include <math.h>

/* Put a light into the lists of the blocks near it, remove it from them, or do both for a light
 * that was the sphere `was` when it was listed; unlist_all empties all lists. */
void lmpi_field_list(lmp_field *field, uint32_t light);
void lmpi_field_unlist(lmp_field *field, uint32_t light);
void lmpi_field_relist(lmp_field *field, uint32_t light, const field_sphere *was);
void lmpi_field_unlist_all(lmp_field *field);

/* A bit per light: those listed for some of the points given. */
typedef struct field_set {
    uint64_t bits[LMP_FIELD_LIGHTS_MAX / 64];
    size_t words;
} field_set;
void lmpi_field_set_clear(const lmp_field *field, field_set *set);
void lmpi_field_set_add(const lmp_field *field, uint32_t block, field_set *set);
void lmpi_field_set_add_all(const lmp_field *field, field_set *set);

/* Whether the field holds a light but where it fades. Reads the light itself only if it is in the
 * list of lights near everywhere. */
static inline bool lmpi_field_interpolates(const lmp_field *field, uint32_t light) {
    return !field->everywhere[light] || lmpi_light_fades(&field->lights[light]);
}

/* Returns the fraction of a light that the field does not hold at a point inside the grid. Inline,
 * because every point asks this of many lights, most of which are past their reach. */
static inline float lmpi_field_residual(const lmp_field *field, uint32_t light, lmp_vec3 point) {
    if (!lmpi_field_interpolates(field, light))
        return 1;
    const field_sphere *s = &field->spheres[light];
    const float x = s->center.x - point.x, y = s->center.y - point.y, z = s->center.z - point.z;
    const float d2 = x * x + y * y + z * z, end = lmpi_field_around(s, field->info.reach);
    if (d2 >= end * end)
        return 0;
    const float away = (sqrtf(d2) - lmpi_field_around(s, 0)) / field->info.reach;
    const float some = away > 0 ? away : 0, t = some < 1 ? some : 1, v = 1 - t * t;
    return v * v * v * (1 + 3 * t * t);
}

/* Whether the field may lack part of a light at some point of the box. Inline, because every run of
 * points asks this of many lights. */
static inline bool lmpi_field_is_near(const lmp_field *field, uint32_t light,
                                      const field_box *box) {
    const field_sphere *sphere = &field->spheres[light];
    const float reach = lmpi_field_around(sphere, field->info.reach) * 1.0001f;
    return (lmpi_field_distance2(box, sphere->center) < reach * reach) | field->everywhere[light];
}

/* Finds up to `capacity` lights of the set from *next on that the field may lack part of at some
 * point of the box, or any lights if box is NULL, in ascending order; returns how many. Sets *next
 * to the light to go on with, or to FIELD_NONE. */
size_t lmpi_field_set_find(const lmp_field *field, const field_set *set, const field_box *box,
                           size_t capacity, uint32_t *next, uint32_t *lights);

#endif
