/* SPDX-License-Identifier: MIT */
#include "src/light/cap.h"
#include "src/light/packed.h"

#include <lampion/light.h>

#include <math.h>

static const float pi = 3.14159265f;

static float brightest(lmp_rgb color) {
    return fmaxf(fmaxf(fabsf(color.r), fabsf(color.g)), fabsf(color.b));
}

/* The most that a surface receives of a cap and of what is around it. */
static float most_of_cap(const lmp_packed_light *cap) {
    const float sin2 = cap->size * (2 - cap->size);
    const lmp_rgb far = cap->ambient,
                  near = { far.r + sin2 * cap->color.r, far.g + sin2 * cap->color.g,
                           far.b + sin2 * cap->color.b };
    return pi * fmaxf(brightest(near), brightest(far));
}

float lmp_light_range(const lmp_light *light, float irradiance) {
    assert(lmp_is_light(light) && irradiance > 0 && isfinite(irradiance));
    lmp_packed_light packed;
    lmp_light_pack(light, &packed);
    const float color = brightest(packed.color), ratio = color / irradiance;
    if (packed.form == LMP_FORM_SPHERE) /* on its surface and inside it is pi L */
        return pi * ratio > 1 ? packed.size * sqrtf(pi * ratio) : 0;
    if (!packed.fixed)
        return sqrtf(ratio);
    const float most = packed.form == LMP_FORM_CAP ? most_of_cap(&packed) : color;
    return most > irradiance ? INFINITY : 0;
}
