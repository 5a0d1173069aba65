/* SPDX-License-Identifier: MIT */
/* cap.c - lights that are caps as seen from a point, and the coefficients of caps. */
#include "src/light/cap.h"
#include "src/base/precondition.h"
#include "src/kernels/dispatch.h"
#include "src/kernels/single.h"
#include "src/light/packed.h"
#include "src/light/valid.h"
#include "src/sh/column.h"

#include <math.h>

static const float pi = 3.14159265f;

static lmp_rgb scaled(lmp_rgb color, float factor) {
    return (lmp_rgb) { color.r * factor, color.g * factor, color.b * factor };
}

static lmp_vec3 opposite(lmp_vec3 v) {
    return (lmp_vec3) { -v.x, -v.y, -v.z };
}

/* --- each form as a cap ----------------------------------------------------------------------- */

/* Returns the cap of a sphere; inside it, all directions less the complementary cap. */
static void sphere_cap(const lmpi_packed_light *sphere, lmp_vec3 point, lmp_cap *cap) {
    lmpi_subtended_cap subtended;
    lmpi_subtended_by_sphere(sphere->at, sphere->size, point, &subtended);
    const float solid = pi * subtended.sin2;
    cap->axis = subtended.inside ? opposite(subtended.axis) : subtended.axis;
    cap->sin2 = subtended.sin2;
    cap->one_minus_cos = subtended.one_minus_cos;
    cap->strength = scaled(sphere->color, subtended.inside ? -solid : solid);
    cap->ambient = subtended.inside ? sphere->color : (lmp_rgb) { 0, 0, 0 };
}

static void dirac_cap(const lmpi_packed_light *dirac, lmp_vec3 point, lmp_cap *cap) {
    lmpi_subtended_cap subtended;
    *cap = (lmp_cap) { .axis = dirac->at, .strength = dirac->color };
    if (dirac->fixed)
        return;
    lmpi_subtended_by_sphere(dirac->at, 0, point, &subtended);
    const float distance = fmaxf(subtended.distance, LMP_POINT_DISTANCE_MIN);
    const float falloff =
        dirac->form == LMPI_FORM_CONE ? lmpi_cone_falloff(dirac, opposite(subtended.axis)) : 1;
    cap->axis = subtended.axis;
    cap->strength = scaled(dirac->color, falloff / (distance * distance));
}

static void fixed_cap(const lmpi_packed_light *fixed, lmp_cap *cap) {
    const float sin2 = fixed->size * (2 - fixed->size);
    *cap =
        (lmp_cap) { fixed->at, sin2, fixed->size, scaled(fixed->color, pi * sin2), fixed->ambient };
}

void lmp_light_find_cap(const lmp_light *light, lmp_vec3 point, lmp_cap *cap) {
    assert(lmpi_is_light(light) && !lmpi_light_is_area(light) && lmpi_is_point(point));
    lmpi_packed_light packed;
    lmpi_light_pack(light, &packed);
    if (packed.form == LMPI_FORM_SPHERE)
        sphere_cap(&packed, point, cap);
    else if (packed.form == LMPI_FORM_CAP)
        fixed_cap(&packed, cap);
    else
        dirac_cap(&packed, point, cap);
}

/* --- coefficients ----------------------------------------------------------------------------- */

void lmp_light_project_zonal(int bands, const lmp_light *light, lmp_vec3 point, float *zonal,
                             lmp_vec3 *axis) {
    assert(lmpi_is_bands(bands));
    lmp_light unit = *light;
    lmp_cap cap;
    unit.radiance = (lmp_rgb) { 1, 1, 1 };
    unit.ground = (lmp_rgb) { 0, 0, 0 };
    lmp_light_find_cap(&unit, point, &cap);
    const bool away = cap.ambient.r > 0;
    lmpi_cap_polynomials(bands, cap.one_minus_cos, zonal);
    for (int l = 0; l < bands; l++)
        zonal[l] *= lmpi_table_pole[l] * (away && l % 2 != 0 ? -cap.strength.r : cap.strength.r);
    zonal[0] += cap.ambient.r / lmpi_table_pole[0];
    *axis = away ? opposite(cap.axis) : cap.axis;
}

static void add_column(int low, int high, int m, const float *radial, lmpi_azimuth a,
                       float strength, float *plane) {
    const size_t first = LMP_SH_COUNT(low);
    for (int l = m > low ? m : low; l < high; l++) {
        plane[LMP_SH_INDEX(l, m) - first] += strength * (radial[l] * a.c);
        if (m > 0)
            plane[LMP_SH_INDEX(l, -m) - first] += strength * (radial[l] * a.s);
    }
}

/* Bands whose values are computed before any is added, so that the sums can be vectorized. */
#define CAP_BANDS 32

/* Writes all bands of a cap, at most CAP_BANDS. */
LMPI_INLINE void cap_put(int bands, const lmp_cap *cap, float *sh) {
    float r[LMP_BANDS_MAX];
    lmpi_cap_polynomials(bands, cap->one_minus_cos, r);
    lmpi_sh_put(bands, cap->axis, r, NULL, sh);
}
static void put_few(int bands, const lmp_cap *cap, float *sh) {
    lmpi_single_cap single = { .axis = cap->axis };
    LMPI_STRAIGHT(bands, lmpi_cap_polynomials, cap->one_minus_cos, single.factors)
    lmpi_single_get()->cap[bands](&single, sh);
}
static void add_at_once(int bands, const lmp_cap *cap, const float strength[3],
                        float *const planes[3]) {
    float sh[LMP_SH_COUNT(CAP_BANDS)];
    if (bands <= LMPI_SINGLE_BANDS)
        put_few(bands, cap, sh);
    else
        LMPI_STRAIGHT_SMALL(bands, cap_put, cap, sh)
    for (int c = 0; c < 3; c++)
        for (size_t i = 0; planes[c] && i < LMP_SH_COUNT(bands); i++)
            planes[c][i] += strength[c] * sh[i];
}

void lmpi_cap_add(int low, int high, const lmp_cap *cap, float *const planes[3]) {
    const float strength[3] = { cap->strength.r, cap->strength.g, cap->strength.b };
    const float ambient[3] = { cap->ambient.r, cap->ambient.g, cap->ambient.b };
    float r[LMP_BANDS_MAX], q[LMP_BANDS_MAX];
    lmpi_azimuth a = { 1, 0 };
    for (int c = 0; low == 0 && c < 3; c++)
        if (planes[c])
            planes[c][0] += ambient[c] / lmpi_table_pole[0];
    if (low == 0 && high <= CAP_BANDS) {
        add_at_once(high, cap, strength, planes);
        return;
    }
    lmpi_cap_polynomials(high, cap->one_minus_cos, r);
    for (int m = 0; m < high; m++) {
        lmpi_sh_column(high, m, cap->axis.z, q);
        for (int l = m > low ? m : low; l < high; l++)
            q[l] *= r[l];
        for (int c = 0; c < 3; c++)
            if (planes[c])
                add_column(low, high, m, q, a, strength[c], planes[c]);
        a = lmpi_azimuth_next(a, cap->axis);
    }
}
