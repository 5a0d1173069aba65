/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"
#include "src/light/cap.h"
#include "src/sh/column.h"

#include <lampion/light.h>

#include <math.h>
#include <string.h>

static const float pi = 3.14159265f;

static lmp_rgb scaled(lmp_rgb color, float factor) {
    return (lmp_rgb) { color.r * factor, color.g * factor, color.b * factor };
}

static lmp_vec3 opposite(lmp_vec3 v) {
    return (lmp_vec3) { -v.x, -v.y, -v.z };
}

/* --- each kind as a cap ----------------------------------------------------------------------- */

/* A cap of cos a = ±(1 - one_minus_cos); obtuse: all directions less the complementary cap. */
static void set_cap(lmp_vec3 axis, bool obtuse, float sin2, float one_minus_cos, lmp_rgb radiance,
                    lmp_cap *cap) {
    cap->axis = obtuse ? opposite(axis) : axis;
    cap->sin2 = sin2;
    cap->one_minus_cos = one_minus_cos;
    cap->strength = scaled(radiance, obtuse ? -pi * sin2 : pi * sin2);
    cap->ambient = obtuse ? radiance : (lmp_rgb) { 0, 0, 0 };
}

static void set_sphere(const lmp_light *light, lmp_vec3 point, lmp_cap *cap) {
    lmp_sight sight;
    lmp_sight_sphere(light->position, light->radius, point, &sight);
    set_cap(sight.axis, sight.inside, sight.sin2, sight.one_minus_cos, light->radiance, cap);
}

static void set_angle(const lmp_light *light, lmp_cap *cap) {
    const bool obtuse = light->angle > pi / 2;
    const float half = sinf((obtuse ? pi - light->angle : light->angle) / 2);
    const float one_minus_cos = 2 * half * half;
    set_cap(light->direction, obtuse, one_minus_cos * (2 - one_minus_cos), one_minus_cos,
            light->radiance, cap);
}

lmp_kernel_cone lmp_light_cone(const lmp_light *spot) {
    const float inner = cosf(spot->inner), outer = cosf(spot->outer);
    return (lmp_kernel_cone) { spot->position, spot->direction, outer,
                               fmaxf(inner - outer, 1e-3f) };
}

/* 1 inside the inner cone, 0 outside the outer one, of the direction from the light. */
static float spot_falloff(const lmp_light *light, lmp_vec3 from_light) {
    const lmp_kernel_cone cone = lmp_light_cone(light);
    const lmp_vec3 d = cone.axis;
    const float cosine = d.x * from_light.x + d.y * from_light.y + d.z * from_light.z;
    const float position = (cosine - cone.outer) / cone.width;
    const float held = fminf(fmaxf(position, 0), 1);
    return held * held;
}

static void set_point(const lmp_light *light, lmp_vec3 point, lmp_cap *cap) {
    lmp_sight sight;
    lmp_sight_sphere(light->position, 0, point, &sight);
    const float distance = fmaxf(sight.distance, LMP_POINT_DISTANCE_MIN);
    const float falloff =
        light->kind == LMP_LIGHT_SPOT ? spot_falloff(light, opposite(sight.axis)) : 1;
    cap->axis = sight.axis;
    cap->strength = scaled(light->intensity, falloff / (distance * distance));
}

static void set_hemisphere(const lmp_light *light, lmp_cap *cap) {
    const lmp_rgb sky = light->radiance, ground = light->ground;
    const lmp_rgb difference = { sky.r - ground.r, sky.g - ground.g, sky.b - ground.b };
    set_cap(light->direction, false, 1, 1, difference, cap);
    cap->ambient = ground;
}

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
               inner <= outer && outer <= pi;
    case LMP_LIGHT_DIRECTIONAL:
        return lmp_is_unit(light->direction);
    case LMP_LIGHT_CAP:
        return lmp_is_unit(light->direction) && light->angle >= 0 && light->angle <= pi;
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

void lmp_light_cap(const lmp_light *light, lmp_vec3 point, lmp_cap *cap) {
    assert(lmp_is_light(light) && lmp_is_point(point));
    *cap = (lmp_cap) { .axis = light->direction };
    switch (light->kind) {
    case LMP_LIGHT_SPHERE:
        set_sphere(light, point, cap);
        break;
    case LMP_LIGHT_POINT:
    case LMP_LIGHT_SPOT:
        set_point(light, point, cap);
        break;
    case LMP_LIGHT_DIRECTIONAL:
        cap->strength = light->irradiance;
        break;
    case LMP_LIGHT_CAP:
        set_angle(light, cap);
        break;
    case LMP_LIGHT_HEMISPHERE:
        set_hemisphere(light, cap);
        break;
    }
}

/* --- coefficients ----------------------------------------------------------------------------- */

void lmp_light_zonal(int bands, const lmp_light *light, lmp_vec3 point, float *zonal,
                     lmp_vec3 *axis) {
    assert(lmp_is_bands(bands));
    lmp_light unit = *light;
    lmp_cap cap;
    unit.radiance = (lmp_rgb) { 1, 1, 1 };
    unit.ground = (lmp_rgb) { 0, 0, 0 };
    lmp_light_cap(&unit, point, &cap);
    const bool away = cap.ambient.r > 0;
    lmp_cap_polynomials(bands, cap.one_minus_cos, zonal);
    for (int l = 0; l < bands; l++)
        zonal[l] *= lmp_table_pole[l] * (away && l % 2 != 0 ? -cap.strength.r : cap.strength.r);
    zonal[0] += cap.ambient.r / lmp_table_pole[0];
    *axis = away ? opposite(cap.axis) : cap.axis;
}

static void add_column(int low, int high, int m, const float *radial, lmp_azimuth a, float strength,
                       float *plane) {
    const size_t first = LMP_SH_COUNT(low);
    for (int l = m > low ? m : low; l < high; l++) {
        plane[LMP_SH_INDEX(l, m) - first] += strength * (radial[l] * a.c);
        if (m > 0)
            plane[LMP_SH_INDEX(l, -m) - first] += strength * (radial[l] * a.s);
    }
}

/* Bands whose values are found before any is added, which leaves the sums to vectors. */
#define CAP_BANDS 32

/* All bands of a cap, at most CAP_BANDS. */
LMP_INLINE void cap_put(int bands, const lmp_cap *cap, float *sh) {
    float r[LMP_BANDS_MAX];
    lmp_cap_polynomials(bands, cap->one_minus_cos, r);
    lmp_sh_put(bands, cap->axis, r, NULL, sh);
}
static void add_at_once(int bands, const lmp_cap *cap, const float strength[3],
                        float *const planes[3]) {
    float sh[LMP_SH_COUNT(CAP_BANDS)];
    LMP_STRAIGHT_SMALL(bands, cap_put, cap, sh)
    for (int c = 0; c < 3; c++)
        for (size_t i = 0; planes[c] && i < LMP_SH_COUNT(bands); i++)
            planes[c][i] += strength[c] * sh[i];
}

void lmp_cap_add(int low, int high, const lmp_cap *cap, float *const planes[3]) {
    const float strength[3] = { cap->strength.r, cap->strength.g, cap->strength.b };
    const float ambient[3] = { cap->ambient.r, cap->ambient.g, cap->ambient.b };
    float r[LMP_BANDS_MAX], q[LMP_BANDS_MAX];
    lmp_azimuth a = { 1, 0 };
    for (int c = 0; low == 0 && c < 3; c++)
        if (planes[c])
            planes[c][0] += ambient[c] / lmp_table_pole[0];
    if (low == 0 && high <= CAP_BANDS) {
        add_at_once(high, cap, strength, planes);
        return;
    }
    lmp_cap_polynomials(high, cap->one_minus_cos, r);
    for (int m = 0; m < high; m++) {
        lmp_sh_column(high, m, cap->axis.z, q);
        for (int l = m > low ? m : low; l < high; l++)
            q[l] *= r[l];
        for (int c = 0; c < 3; c++)
            if (planes[c])
                add_column(low, high, m, q, a, strength[c], planes[c]);
        a = lmp_azimuth_next(a, cap->axis);
    }
}

void lmp_light_project_channels(int bands, const lmp_light *lights, size_t count, lmp_vec3 point,
                                float *red, float *green, float *blue) {
    assert(lmp_is_bands(bands));
    float *const planes[3] = { red, green, blue };
    for (int c = 0; c < 3; c++)
        assert(!planes[c] || !planes[(c + 1) % 3] ||
               lmp_are_apart(planes[c], LMP_SH_COUNT(bands), planes[(c + 1) % 3],
                             LMP_SH_COUNT(bands)));
    for (int c = 0; c < 3; c++)
        if (planes[c])
            memset(planes[c], 0, LMP_SH_COUNT(bands) * sizeof *planes[c]);
    for (size_t i = 0; i < count; i++) {
        lmp_cap cap;
        lmp_light_cap(&lights[i], point, &cap);
        lmp_cap_add(0, bands, &cap, planes);
    }
}

void lmp_light_project(int bands, const lmp_light *lights, size_t count, lmp_vec3 point,
                       float *sh) {
    const size_t plane = LMP_SH_COUNT(bands);
    lmp_light_project_channels(bands, lights, count, point, sh, sh + plane, sh + 2 * plane);
}
