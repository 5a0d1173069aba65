/* SPDX-License-Identifier: MIT */
#include "src/light/cap.h"

#include <lampion/light.h>

#include <math.h>

static const float pi = 3.14159265f;

static float brightest(lmp_rgb color) {
    return fmaxf(fmaxf(fabsf(color.r), fabsf(color.g)), fabsf(color.b));
}

float lmp_light_range(const lmp_light *light, float irradiance) {
    assert(lmp_is_light(light) && irradiance > 0 && isfinite(irradiance));
    const float color = brightest(light->radiance), ratio = color / irradiance;
    const float sine = sinf(fminf(light->angle, pi / 2));
    float most = 0; /* of what is the same everywhere */
    switch (light->kind) {
    case LMP_LIGHT_SPHERE: /* on its surface and inside it is pi L */
        return pi * ratio > 1 ? light->radius * sqrtf(pi * ratio) : 0;
    case LMP_LIGHT_POINT:
    case LMP_LIGHT_SPOT:
        return sqrtf(ratio);
    case LMP_LIGHT_DIRECTIONAL:
        most = color;
        break;
    case LMP_LIGHT_CAP:
        most = pi * sine * sine * color;
        break;
    case LMP_LIGHT_HEMISPHERE:
        most = pi * fmaxf(color, brightest(light->ground));
        break;
    }
    return most > irradiance ? INFINITY : 0;
}
