/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"
#include "src/light/cap.h"
#include "src/sh/column.h"

#include <lampion/light.h>

#include <float.h>
#include <math.h>

static const float pi = 3.14159265f;

void lmp_sight_distance(float radius, float distance, lmp_sight *sight) {
    const bool inside = distance < radius;
    const float near = inside ? distance : radius, far = inside ? radius : distance;
    const bool nothing = far < FLT_MIN;
    const float per_far = nothing ? 0 : 1 / far, ratio = near * per_far;
    sight->distance = distance;
    sight->inside = inside;
    sight->sin2 = ratio * ratio;
    /* not sqrt(1 - sin²a), which cancels for touching lights */
    sight->cosine = nothing ? 1 : sqrtf((far - near) * (far + near)) * per_far;
    sight->one_minus_cos = sight->sin2 / (1 + sight->cosine);
}

void lmp_sight_sphere(lmp_vec3 center, float radius, lmp_vec3 point, lmp_sight *sight) {
    const lmp_vec3 v = { center.x - point.x, center.y - point.y, center.z - point.z };
    const float distance = sqrtf(v.x * v.x + v.y * v.y + v.z * v.z);
    lmp_sight_distance(radius, distance, sight);
    sight->axis = distance == 0 ? (lmp_vec3) { 0, 0, 1 }
                                : (lmp_vec3) { v.x / distance, v.y / distance, v.z / distance };
}

/* L_lm = factors[l] Y_lm(axis), radiance 1. Inside, cos a < 0: R_l has the parity of l-1, and
 * sin²a R_0 = 2 (1 - cos a). */
LMP_INLINE void sight_factors(int bands, const lmp_sight *sight, float *factors) {
    const float odd = pi * sight->sin2, even = sight->inside ? -odd : odd;
    lmp_cap_polynomials(bands, sight->one_minus_cos, factors);
    for (int l = 1; l < bands; l++)
        factors[l] *= l % 2 == 0 ? even : odd;
    factors[0] = 2 * pi * (sight->inside ? 1 + sight->cosine : sight->one_minus_cos);
}

void lmp_sphere_zonal(int bands, float radius, float distance, float *zonal) {
    assert(lmp_is_bands(bands) && lmp_is_length(radius) && distance >= 0 && isfinite(distance));
    lmp_sight sight;
    lmp_sight_distance(radius, distance, &sight);
    sight_factors(bands, &sight, zonal);
    for (int l = 0; l < bands; l++)
        zonal[l] *= lmp_table_pole[l];
}

LMP_INLINE void sight_project(int bands, const lmp_sight *sight, float *sh) {
    float factors[LMP_BANDS_MAX];
    sight_factors(bands, sight, factors);
    lmp_sh_put(bands, sight->axis, NULL, factors, sh);
}

void lmp_sphere_project(int bands, lmp_vec3 center, float radius, lmp_vec3 point, float *sh) {
    assert(lmp_is_bands(bands) && lmp_is_length(radius));
    assert(lmp_is_point(center) && lmp_is_point(point));
    lmp_sight sight;
    lmp_sight_sphere(center, radius, point, &sight);
    LMP_STRAIGHT_SMALL(bands, sight_project, &sight, sh)
}

/* --- the gradient ----------------------------------------------------------------------------- */

/* What the gradient of one band needs: with k = pi sin²a / d,
 * grad L_lm = k [ (2 P_l / cos a) Y_lm w - R_l gradT Y_lm ]. */
typedef struct band_slopes {
    lmp_vec3 axis;
    float radial[LMP_BANDS_MAX];     /* 2 k P_l / |cos a| */
    float tangential[LMP_BANDS_MAX]; /* k R_l */
} band_slopes;

static void prepare_slopes(int bands, const lmp_sight *sight, float radius, band_slopes *slopes) {
    /* sin²a / d, which is d / r² inside */
    const float ratio =
        sight->inside ? sight->distance / radius / radius : sight->sin2 / sight->distance;
    const float cosine = sight->cosine > LMP_COS_MIN ? sight->cosine : LMP_COS_MIN;
    slopes->axis = sight->axis;
    lmp_legendre_polynomials(bands, sight->one_minus_cos, slopes->radial);
    lmp_cap_polynomials(bands, sight->one_minus_cos, slopes->tangential);
    for (int l = 0; l < bands; l++) {
        /* at cos a < 0, P_l has the parity of l and R_l that of l-1 */
        const float p_sign = sight->inside && l % 2 != 0 ? -1.f : 1.f;
        const float r_sign = sight->inside && l % 2 == 0 ? -1.f : 1.f;
        slopes->radial[l] *= p_sign * (2 * pi * ratio / cosine);
        slopes->tangential[l] *= r_sign * (pi * ratio);
    }
}

/* One coefficient's gradient from the value y and the derivative g of its polynomial extension,
 * whose tangent part is g - (g·w) w. */
static void store_gradient(const band_slopes *slopes, int bands, int l, int m, float y, lmp_vec3 g,
                           float *gradient) {
    const lmp_vec3 w = slopes->axis;
    const float t = slopes->tangential[l];
    const float along = slopes->radial[l] * y + t * (g.x * w.x + g.y * w.y + g.z * w.z);
    float *entry = gradient + LMP_SH_INDEX(l, m);
    entry[0] = along * w.x - t * g.x;
    entry[LMP_SH_COUNT(bands)] = along * w.y - t * g.y;
    entry[2 * LMP_SH_COUNT(bands)] = along * w.z - t * g.z;
}

void lmp_sphere_project_gradient(int bands, lmp_vec3 center, float radius, lmp_vec3 point,
                                 float *sh, float *gradient) {
    assert(lmp_is_bands(bands) && lmp_is_length(radius));
    assert(lmp_is_point(center) && lmp_is_point(point));
    lmp_sight sight;
    lmp_sight_sphere(center, radius, point, &sight);
    assert(sight.distance > 0 || radius > 0);
    assert(lmp_are_apart(sh, LMP_SH_COUNT(bands), gradient, 3 * LMP_SH_COUNT(bands)));
    float factors[LMP_BANDS_MAX];
    band_slopes slopes;
    sight_factors(bands, &sight, factors);
    prepare_slopes(bands, &sight, radius, &slopes);

    float columns[2][LMP_BANDS_MAX + 1];
    lmp_azimuth before = { 0, 0 }, now = { 1, 0 };
    lmp_sh_column(bands, 0, sight.axis.z, columns[0]);
    for (int m = 0; m < bands; m++) {
        const float *q = columns[m % 2];
        float *above = columns[(m + 1) % 2]; /* q_l^(m+1), 0 at l = m */
        if (m + 1 < bands)
            lmp_sh_column(bands, m + 1, sight.axis.z, above);
        above[m] = 0;
        for (int l = m; l < bands; l++) {
            const float slope = lmp_table_slope[lmp_table_index(l, m)] * above[l];
            const float side = (float)m * q[l];
            const float sine = q[l] * now.s, cosine = q[l] * now.c;
            if (m > 0) {
                const lmp_vec3 g = { side * before.s, side * before.c, slope * now.s };
                sh[LMP_SH_INDEX(l, -m)] = factors[l] * sine;
                store_gradient(&slopes, bands, l, -m, sine, g, gradient);
            }
            const lmp_vec3 g = { side * before.c, -side * before.s, slope * now.c };
            sh[LMP_SH_INDEX(l, m)] = factors[l] * cosine;
            store_gradient(&slopes, bands, l, m, cosine, g, gradient);
        }
        before = now;
        now = lmp_azimuth_next(now, sight.axis);
    }
}
