/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"
#include "src/light/area.h"
#include "src/light/packed.h"
#include "src/light/valid.h"

static const float pi = 3.14159265f;

float lmp_light_cap_irradiance_from_radiance(float radiance, float angle) {
    assert(angle > 0 && angle <= pi / 2);
    const float sine = sinf(angle);
    return pi * sine * sine * radiance;
}

float lmp_light_cap_radiance_from_irradiance(float irradiance, float angle) {
    assert(angle > 0 && angle <= pi / 2);
    const float sine = sinf(angle);
    return irradiance / (pi * sine * sine);
}

static lmpi_area_size size_of(const lmp_light *area) {
    assert(lmpi_is_light(area) && lmpi_light_is_area(area));
    return lmpi_area_measure(area);
}

float lmp_light_power_from_radiance(const lmp_light *area, float radiance) {
    return (float)((double)pi * size_of(area).shining * (double)radiance);
}

float lmp_light_radiance_from_power(const lmp_light *area, float power) {
    return (float)((double)power / ((double)pi * size_of(area).shining));
}

float lmp_light_intensity_from_radiance(const lmp_light *area, float radiance) {
    return (float)(size_of(area).facing * (double)radiance);
}

float lmp_light_radiance_from_intensity(const lmp_light *area, float intensity) {
    return (float)((double)intensity / size_of(area).facing);
}
