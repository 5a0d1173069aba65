/* SPDX-License-Identifier: MIT */
/* packed.h - packs lights into their forms (lmpi_packed_light, src/kernels/packed_light.h): only
 * here and in valid.c does the library examine a light's kind. The functions are inline because the
 * program packs lights, too, and may be linked to a library that exports only its public
 * functions. */
#ifndef LAMPION_LIGHT_PACKED_H
#define LAMPION_LIGHT_PACKED_H

#include "src/kernels/packed_light.h"
#include "src/light/vector.h"

#include <lampion/light.h>

#define LMPI_PACKED_PI 3.14159265f

static inline lmpi_light_form lmpi_light_form_of(const lmp_light *light) {
    switch (light->kind) {
    case LMP_LIGHT_SPHERE:
        return LMPI_FORM_SPHERE;
    case LMP_LIGHT_POINT:
    case LMP_LIGHT_DIRECTIONAL:
        return LMPI_FORM_DIRAC;
    case LMP_LIGHT_SPOT:
        return LMPI_FORM_CONE;
    case LMP_LIGHT_CAP:
    case LMP_LIGHT_HEMISPHERE:
        return LMPI_FORM_CAP;
    case LMP_LIGHT_RECTANGLE:
    case LMP_LIGHT_DISK:
    case LMP_LIGHT_TUBE:
    case LMP_LIGHT_POLYGON:
        break;
    }
    return LMPI_FORM_AREA;
}

static inline bool lmpi_light_is_area(const lmp_light *light) {
    return lmpi_light_form_of(light) == LMPI_FORM_AREA;
}

static inline bool lmpi_is_any_area(const lmp_light *lights, size_t count) {
    bool any = false;
    for (size_t i = 0; i < count; i++)
        any |= lmpi_light_is_area(&lights[i]);
    return any;
}

/* Whether an area is a tube; the others are flat. */
static inline bool lmpi_area_is_tube(const lmp_light *area) {
    return area->kind == LMP_LIGHT_TUBE;
}

/* Finds the corners of a flat area, relative to its position and counter-clockwise around its
 * normal; returns how many, 0 for a disk. */
static inline int lmpi_area_find_corners(const lmp_light *area,
                                         lmpi_vector corner[LMP_LIGHT_CORNERS_MAX]) {
    if (area->kind == LMP_LIGHT_RECTANGLE) {
        const lmpi_vector x = lmpi_vector_of(area->half[0]), y = lmpi_vector_of(area->half[1]);
        corner[0] = lmpi_vector_scale(lmpi_vector_add(x, y), -1);
        corner[1] = lmpi_vector_sub(x, y);
        corner[2] = lmpi_vector_add(x, y);
        corner[3] = lmpi_vector_sub(y, x);
        return 4;
    }
    const int count = area->kind == LMP_LIGHT_POLYGON ? area->corner_count : 0;
    for (int i = 0; i < count; i++)
        corner[i] = lmpi_vector_of(area->corner[i]);
    return count;
}

/* Whether a light is a single direction, the same from every point. */
static inline bool lmpi_light_is_sun(const lmp_light *light) {
    return light->kind == LMP_LIGHT_DIRECTIONAL;
}

/* Whether a light looks the same from every point. */
static inline bool lmpi_light_is_fixed(const lmp_light *light) {
    return lmpi_light_form_of(light) == LMPI_FORM_CAP || lmpi_light_is_sun(light);
}

static inline bool lmpi_are_all_spheres(const lmp_light *lights, size_t count) {
    bool all = true;
    for (size_t i = 0; i < count; i++)
        all &= lmpi_light_form_of(&lights[i]) == LMPI_FORM_SPHERE;
    return all;
}

static inline lmp_rgb lmpi_packed_opposite(lmp_rgb color) {
    return (lmp_rgb) { -color.r, -color.g, -color.b };
}

/* Packs a cap; one of more than a hemisphere is ambient light minus the complementary cap. */
static inline void lmpi_pack_cap(const lmp_light *cap, lmpi_packed_light *packed) {
    const bool obtuse = cap->angle > LMPI_PACKED_PI / 2;
    const float half_sine = sinf((obtuse ? LMPI_PACKED_PI - cap->angle : cap->angle) / 2);
    const lmp_vec3 d = cap->direction;
    packed->size = 2 * half_sine * half_sine;
    if (obtuse) {
        packed->at = (lmp_vec3) { -d.x, -d.y, -d.z };
        packed->color = lmpi_packed_opposite(cap->radiance);
        packed->ambient = cap->radiance;
    }
}

static inline void lmpi_pack_hemisphere(const lmp_light *sky, lmpi_packed_light *packed) {
    const lmp_rgb above = sky->radiance, below = sky->ground;
    packed->size = 1;
    packed->color = (lmp_rgb) { above.r - below.r, above.g - below.g, above.b - below.b };
    packed->ambient = below;
}

/* Packs a spot as in KHR_lights_punctual, with the difference of the cosines clamped to at least
 * 1e-3. */
static inline void lmpi_pack_cone(const lmp_light *spot, lmpi_packed_light *packed) {
    packed->axis = spot->direction;
    packed->outer = cosf(spot->outer);
    packed->width = fmaxf(cosf(spot->inner) - packed->outer, 1e-3f);
}

/* Packs a light; members that its form does not use are not set. */
static inline void lmpi_light_pack(const lmp_light *light, lmpi_packed_light *packed) {
    packed->form = lmpi_light_form_of(light);
    packed->fixed = lmpi_light_is_fixed(light);
    packed->at = packed->fixed ? light->direction : light->position;
    packed->size = packed->form == LMPI_FORM_SPHERE ? light->radius : LMPI_DIRAC;
    packed->color = light->radiance; /* intensity and irradiance share the union with radiance */
    packed->ambient = (lmp_rgb) { 0, 0, 0 };
    packed->per_reach = 0;
    if (packed->form == LMPI_FORM_CONE)
        lmpi_pack_cone(light, packed);
    else if (packed->form == LMPI_FORM_CAP && light->kind == LMP_LIGHT_CAP)
        lmpi_pack_cap(light, packed);
    else if (packed->form == LMPI_FORM_CAP)
        lmpi_pack_hemisphere(light, packed);
}

/* Returns the fraction of a cone's light that leaves in a direction: 1 inside the inner angle, 0
 * outside the outer one. */
static inline float lmpi_cone_falloff(const lmpi_packed_light *cone, lmp_vec3 from_light) {
    const lmp_vec3 a = cone->axis;
    const float cosine = a.x * from_light.x + a.y * from_light.y + a.z * from_light.z;
    const float held = fminf(fmaxf((cosine - cone->outer) / cone->width, 0), 1);
    return held * held;
}

/* Whether a field can hold a light except near it: the light must have a position and fall off
 * equally in all directions from it. */
static inline bool lmpi_light_fades(const lmp_light *light) {
    const lmpi_light_form form = lmpi_light_form_of(light);
    return form == LMPI_FORM_SPHERE || (form == LMPI_FORM_DIRAC && !lmpi_light_is_fixed(light));
}

#endif
