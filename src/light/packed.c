/* SPDX-License-Identifier: MIT */
/* packed.c - which of its members a light's kind names, and what they may be. */
#include "src/light/packed.h"

#include "src/light/cap.h"

static bool is_color(lmp_rgb color) {
    return isfinite(color.r) && isfinite(color.g) && isfinite(color.b);
}

bool lmp_is_light(const lmp_light *light) {
    const float inner = light->inner, outer = light->outer;
    if (!is_color(light->radiance))
        return false;
    switch (light->kind) {
    case LMP_LIGHT_SPHERE:
        return lmp_is_point(light->position) && lmp_is_length(light->radius);
    case LMP_LIGHT_POINT:
        return lmp_is_point(light->position);
    case LMP_LIGHT_SPOT:
        return lmp_is_point(light->position) && lmp_is_unit(light->direction) && inner >= 0 &&
               inner <= outer && outer <= LMP_PACKED_PI;
    case LMP_LIGHT_DIRECTIONAL:
        return lmp_is_unit(light->direction);
    case LMP_LIGHT_CAP:
        return lmp_is_unit(light->direction) && light->angle >= 0 && light->angle <= LMP_PACKED_PI;
    case LMP_LIGHT_HEMISPHERE:
        return lmp_is_unit(light->direction) && is_color(light->ground);
    }
    return false;
}

bool lmp_are_lights(const lmp_light *lights, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!lmp_is_light(&lights[i]))
            return false;
    return true;
}
