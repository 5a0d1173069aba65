/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"
#include "src/kernels/single.h"
#include "src/light/cap.h"
#include "src/light/packed.h"
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

/* --- each form as a cap ----------------------------------------------------------------------- */

/* Inside a sphere: all directions less the complementary cap. */
static void sphere_cap(const lmp_packed_light *sphere, lmp_vec3 point, lmp_cap *cap) {
    lmp_sight sight;
    lmp_sight_sphere(sphere->at, sphere->size, point, &sight);
    const float solid = pi * sight.sin2;
    cap->axis = sight.inside ? opposite(sight.axis) : sight.axis;
    cap->sin2 = sight.sin2;
    cap->one_minus_cos = sight.one_minus_cos;
    cap->strength = scaled(sphere->color, sight.inside ? -solid : solid);
    cap->ambient = sight.inside ? sphere->color : (lmp_rgb) { 0, 0, 0 };
}

static void dirac_cap(const lmp_packed_light *dirac, lmp_vec3 point, lmp_cap *cap) {
    lmp_sight sight;
    *cap = (lmp_cap) { .axis = dirac->at, .strength = dirac->color };
    if (dirac->fixed)
        return;
    lmp_sight_sphere(dirac->at, 0, point, &sight);
    const float distance = fmaxf(sight.distance, LMP_POINT_DISTANCE_MIN);
    const float falloff =
        dirac->form == LMP_FORM_CONE ? lmp_cone_falloff(dirac, opposite(sight.axis)) : 1;
    cap->axis = sight.axis;
    cap->strength = scaled(dirac->color, falloff / (distance * distance));
}

static void fixed_cap(const lmp_packed_light *fixed, lmp_cap *cap) {
    const float sin2 = fixed->size * (2 - fixed->size);
    *cap =
        (lmp_cap) { fixed->at, sin2, fixed->size, scaled(fixed->color, pi * sin2), fixed->ambient };
}

void lmp_light_cap(const lmp_light *light, lmp_vec3 point, lmp_cap *cap) {
    assert(lmp_is_light(light) && lmp_is_point(point));
    lmp_packed_light packed;
    lmp_light_pack(light, &packed);
    if (packed.form == LMP_FORM_SPHERE)
        sphere_cap(&packed, point, cap);
    else if (packed.form == LMP_FORM_CAP)
        fixed_cap(&packed, cap);
    else
        dirac_cap(&packed, point, cap);
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

/* The only light of few bands: nothing is added to. */
static void project_one(int bands, const lmp_light *light, lmp_vec3 point, float *const planes[3]) {
    lmp_cap cap;
    lmp_light_cap(light, point, &cap);
    lmp_single_cap single = { .axis = cap.axis };
    const lmp_rgb ambient = scaled(cap.ambient, 1 / lmp_table_pole[0]);
    if (cap.one_minus_cos > 0)
        LMP_STRAIGHT(bands, lmp_cap_polynomials, cap.one_minus_cos, single.factors)
    else
        for (int l = 0; l < LMP_SINGLE_BANDS; l++)
            single.factors[l] = 1;
    lmp_single_get()->colors[bands](&single, cap.strength, ambient, planes);
}

void lmp_light_project_channels(int bands, const lmp_light *lights, size_t count, lmp_vec3 point,
                                float *red, float *green, float *blue) {
    assert(lmp_is_bands(bands));
    float *const planes[3] = { red, green, blue };
    for (int c = 0; c < 3; c++)
        assert(!planes[c] || !planes[(c + 1) % 3] ||
               lmp_are_apart(planes[c], LMP_SH_COUNT(bands), planes[(c + 1) % 3],
                             LMP_SH_COUNT(bands)));
    if (count == 1 && bands <= LMP_SINGLE_BANDS && red && green && blue) {
        project_one(bands, lights, point, planes);
        return;
    }
    for (int c = 0; c < 3; c++)
        if (planes[c])
            memset(planes[c], 0, LMP_SH_COUNT(bands) * sizeof *planes[c]);
    for (size_t i = 0; i < count; i++) {
        lmp_cap cap;
        lmp_light_cap(&lights[i], point, &cap);
        lmp_cap_add(0, bands, &cap, planes);
    }
}

lmp_rgb lmp_light_irradiance(const lmp_light *lights, size_t count, lmp_vec3 point,
                             lmp_vec3 normal) {
    assert(lmp_is_unit(normal));
    lmp_rgb sum = { 0, 0, 0 };
    for (size_t i = 0; i < count; i++) {
        lmp_cap cap;
        lmp_light_cap(&lights[i], point, &cap);
        lmp_cap_add_irradiance(&cap, normal, &sum);
    }
    return sum;
}

void lmp_light_project(int bands, const lmp_light *lights, size_t count, lmp_vec3 point,
                       float *sh) {
    const size_t plane = LMP_SH_COUNT(bands);
    lmp_light_project_channels(bands, lights, count, point, sh, sh + plane, sh + 2 * plane);
}
