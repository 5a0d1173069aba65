/* SPDX-License-Identifier: MIT */
#include "src/light/valid.h"

#include "src/light/packed.h"
#include "src/sphere/sphere.h"

static bool is_color(lmp_rgb color) {
    return isfinite(color.r) && isfinite(color.g) && isfinite(color.b);
}

static bool are_corners(const lmp_vec3 *corner, int count) {
    for (int i = 0; i < count; i++)
        if (!lmpi_is_point(corner[i]))
            return false;
    return true;
}

bool lmpi_is_light(const lmp_light *light) {
    const float inner = light->inner, outer = light->outer;
    if (!is_color(light->radiance))
        return false;
    switch (light->kind) {
    case LMP_LIGHT_SPHERE:
        return lmpi_is_point(light->position) && lmpi_is_length(light->radius);
    case LMP_LIGHT_POINT:
        return lmpi_is_point(light->position);
    case LMP_LIGHT_SPOT:
        return lmpi_is_point(light->position) && lmpi_is_unit(light->direction) && inner >= 0 &&
               inner <= outer && outer <= LMPI_PACKED_PI;
    case LMP_LIGHT_DIRECTIONAL:
        return lmpi_is_unit(light->direction);
    case LMP_LIGHT_CAP:
        return lmpi_is_unit(light->direction) && light->angle >= 0 &&
               light->angle <= LMPI_PACKED_PI;
    case LMP_LIGHT_HEMISPHERE:
        return lmpi_is_unit(light->direction) && is_color(light->ground);
    case LMP_LIGHT_RECTANGLE:
        return lmpi_is_point(light->position) && are_corners(light->half, 2);
    case LMP_LIGHT_DISK:
        return lmpi_is_point(light->position) && lmpi_is_unit(light->direction) &&
               lmpi_is_length(light->radius);
    case LMP_LIGHT_TUBE:
        return lmpi_is_point(light->position) && are_corners(light->half, 1) &&
               lmpi_is_length(light->radius);
    case LMP_LIGHT_POLYGON:
        return lmpi_is_point(light->position) && light->corner_count >= 3 &&
               light->corner_count <= LMP_LIGHT_CORNERS_MAX &&
               are_corners(light->corner, light->corner_count);
    }
    return false;
}

bool lmpi_are_lights(const lmp_light *lights, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!lmpi_is_light(&lights[i]))
            return false;
    return true;
}
