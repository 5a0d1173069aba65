/* SPDX-License-Identifier: MIT */
#include <lampion/sphere.h>

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
