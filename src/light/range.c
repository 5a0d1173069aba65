/* SPDX-License-Identifier: MIT */
#include "src/light/area.h"
#include "src/light/packed.h"
#include "src/light/valid.h"
#include "src/sphere/sphere.h"

#include <lampion/light.h>

#include <math.h>

static const float pi = 3.14159265f;

static float brightest(lmp_rgb color) {
    return fmaxf(fmaxf(fabsf(color.r), fabsf(color.g)), fabsf(color.b));
}

/* Returns the largest irradiance that a cap and its ambient light give any surface. */
static float most_of_cap(const lmpi_packed_light *cap) {
    const float sin2 = cap->size * (2 - cap->size);
    const lmp_rgb far = cap->ambient,
                  near = { far.r + sin2 * cap->color.r, far.g + sin2 * cap->color.g,
                           far.b + sin2 * cap->color.b };
    return pi * fmaxf(brightest(near), brightest(far));
}

/* Returns a bound of the distance for an area: as if all of it were at its point nearest to the
 * surface and faced that, or for the sphere around it, whichever is less. */
static float range_of_area(const lmp_light *area, float color, float irradiance) {
    const lmpi_area_size size = lmpi_area_measure(area);
    const double ratio = (double)color / (double)irradiance;
    const double near = size.radius + sqrt(ratio * size.facing);
    const double around = size.radius * sqrt((double)pi * ratio);
    return (double)pi * ratio > 1 ? (float)fmin(near, around) : 0;
}

float lmp_light_range(const lmp_light *light, float irradiance) {
    assert(lmpi_is_light(light) && irradiance > 0 && isfinite(irradiance));
    lmpi_packed_light packed;
    lmpi_light_pack(light, &packed);
    const float color = brightest(packed.color), ratio = color / irradiance;
    if (packed.form == LMPI_FORM_AREA)
        return range_of_area(light, color, irradiance);
    if (packed.form == LMPI_FORM_SPHERE) /* the irradiance on its surface and inside it is pi L */
        return pi * ratio > 1 ? packed.size * sqrtf(pi * ratio) : 0;
    if (!packed.fixed)
        return sqrtf(ratio);
    const float most = packed.form == LMPI_FORM_CAP ? most_of_cap(&packed) : color;
    return most > irradiance ? INFINITY : 0;
}
