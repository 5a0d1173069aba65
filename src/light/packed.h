/* SPDX-License-Identifier: MIT */
/* packed.h - lights by their form (lmp_packed_light, src/kernels/kernels.h): here alone is a
 * light's kind asked for.
 *
 * Inline, for the program packs lights too, and may be linked to a library that shows its public
 * functions alone. */
#ifndef LAMPION_LIGHT_PACKED_H
#define LAMPION_LIGHT_PACKED_H

#include "src/kernels/kernels.h"

#include <lampion/light.h>

#define LMP_PACKED_PI 3.14159265f

static inline lmp_light_form lmp_light_form_of(const lmp_light *light) {
    switch (light->kind) {
    case LMP_LIGHT_SPHERE:
        return LMP_FORM_SPHERE;
    case LMP_LIGHT_POINT:
    case LMP_LIGHT_DIRECTIONAL:
        return LMP_FORM_DIRAC;
    case LMP_LIGHT_SPOT:
        return LMP_FORM_CONE;
    case LMP_LIGHT_CAP:
    case LMP_LIGHT_HEMISPHERE:
        break;
    }
    return LMP_FORM_CAP;
}

/* Whether it is the same from every point. */
static inline bool lmp_light_is_fixed(const lmp_light *light) {
    return lmp_light_form_of(light) == LMP_FORM_CAP || light->kind == LMP_LIGHT_DIRECTIONAL;
}

static inline lmp_rgb lmp_packed_opposite(lmp_rgb color) {
    return (lmp_rgb) { -color.r, -color.g, -color.b };
}

/* A cap of more than a hemisphere: ambient light less the complementary cap. */
static inline void lmp_pack_cap(const lmp_light *cap, lmp_packed_light *packed) {
    const bool obtuse = cap->angle > LMP_PACKED_PI / 2;
    const float half = sinf((obtuse ? LMP_PACKED_PI - cap->angle : cap->angle) / 2);
    const lmp_vec3 d = cap->direction;
    packed->size = 2 * half * half;
    if (obtuse) {
        packed->at = (lmp_vec3) { -d.x, -d.y, -d.z };
        packed->color = lmp_packed_opposite(cap->radiance);
        packed->ambient = cap->radiance;
    }
}

static inline void lmp_pack_hemisphere(const lmp_light *sky, lmp_packed_light *packed) {
    const lmp_rgb above = sky->radiance, below = sky->ground;
    packed->size = 1;
    packed->color = (lmp_rgb) { above.r - below.r, above.g - below.g, above.b - below.b };
    packed->ambient = below;
}

/* As KHR_lights_punctual, whose difference of cosines is held to 1e-3. */
static inline void lmp_pack_cone(const lmp_light *spot, lmp_packed_light *packed) {
    packed->axis = spot->direction;
    packed->outer = cosf(spot->outer);
    packed->width = fmaxf(cosf(spot->inner) - packed->outer, 1e-3f);
}

/* What does not belong to its form is not set. */
static inline void lmp_light_pack(const lmp_light *light, lmp_packed_light *packed) {
    packed->form = lmp_light_form_of(light);
    packed->fixed = lmp_light_is_fixed(light);
    packed->at = packed->fixed ? light->direction : light->position;
    packed->size = packed->form == LMP_FORM_SPHERE ? light->radius : LMP_DIRAC;
    packed->color = light->radiance; /* intensity and irradiance lie there, too */
    packed->ambient = (lmp_rgb) { 0, 0, 0 };
    packed->per_reach = 0;
    if (packed->form == LMP_FORM_CONE)
        lmp_pack_cone(light, packed);
    else if (packed->form == LMP_FORM_CAP && light->kind == LMP_LIGHT_CAP)
        lmp_pack_cap(light, packed);
    else if (packed->form == LMP_FORM_CAP)
        lmp_pack_hemisphere(light, packed);
}

/* What of the light of a cone comes in a direction from it: 1 inside the inner angle, 0 outside the
 * outer one. */
static inline float lmp_cone_falloff(const lmp_packed_light *cone, lmp_vec3 from_light) {
    const lmp_vec3 a = cone->axis;
    const float cosine = a.x * from_light.x + a.y * from_light.y + a.z * from_light.z;
    const float held = fminf(fmaxf((cosine - cone->outer) / cone->width, 0), 1);
    return held * held;
}

/* Whether a field has it but near it: what falls off evenly around a position. */
static inline bool lmp_light_fades(const lmp_light *light) {
    const lmp_light_form form = lmp_light_form_of(light);
    return form == LMP_FORM_SPHERE || (form == LMP_FORM_DIRAC && !lmp_light_is_fixed(light));
}

#endif
