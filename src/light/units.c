/* SPDX-License-Identifier: MIT */
#include <lampion/light.h>

#include <assert.h>
#include <math.h>

static const float pi = 3.14159265f;

float lmp_sphere_power_from_radiance(float radiance, float radius) {
    return 4 * pi * lmp_sphere_intensity_from_radiance(radiance, radius);
}

float lmp_sphere_radiance_from_power(float power, float radius) {
    return lmp_sphere_radiance_from_intensity(power / (4 * pi), radius);
}

float lmp_sphere_intensity_from_radiance(float radiance, float radius) {
    assert(radius > 0 && isfinite(radius));
    return pi * radius * radius * radiance;
}

float lmp_sphere_radiance_from_intensity(float intensity, float radius) {
    assert(radius > 0 && isfinite(radius));
    return intensity / (pi * radius * radius);
}

float lmp_cap_irradiance_from_radiance(float radiance, float angle) {
    assert(angle > 0 && angle <= pi / 2);
    const float sine = sinf(angle);
    return pi * sine * sine * radiance;
}

float lmp_cap_radiance_from_irradiance(float irradiance, float angle) {
    assert(angle > 0 && angle <= pi / 2);
    const float sine = sinf(angle);
    return irradiance / (pi * sine * sine);
}
