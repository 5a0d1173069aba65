/* SPDX-License-Identifier: MIT */
#include "src/sphere/sphere.h"
#include "src/base/precondition.h"
#include "src/kernels/dispatch.h"
#include "src/sh/column.h"

#include <lampion/sphere.h>

#include <float.h>
#include <math.h>

static const float pi = 3.14159265f;

void lmpi_subtended_at_distance(float radius, float distance, lmpi_subtended_cap *subtended) {
    const bool inside = distance < radius;
    const float near = inside ? distance : radius, far = inside ? radius : distance;
    const bool nothing = far < FLT_MIN;
    const float per_far = nothing ? 0 : 1 / far, ratio = near * per_far;
    subtended->distance = distance;
    subtended->inside = inside;
    subtended->sin2 = ratio * ratio;
    /* not sqrt(1 - sin²a), which cancels for touching lights */
    subtended->cosine = nothing ? 1 : sqrtf((far - near) * (far + near)) * per_far;
    subtended->one_minus_cos = subtended->sin2 / (1 + subtended->cosine);
}

void lmpi_subtended_by_sphere(lmp_vec3 center, float radius, lmp_vec3 point,
                              lmpi_subtended_cap *subtended) {
    const lmp_vec3 v = { center.x - point.x, center.y - point.y, center.z - point.z };
    const float distance = sqrtf(v.x * v.x + v.y * v.y + v.z * v.z);
    lmpi_subtended_at_distance(radius, distance, subtended);
    subtended->axis = distance == 0 ? (lmp_vec3) { 0, 0, 1 }
                                    : (lmp_vec3) { v.x / distance, v.y / distance, v.z / distance };
}

/* Computes factors of L_lm = factors[l] Y_lm(axis), for radiance 1. Inside, cos a < 0: R_l has the
 * parity of l-1, and sin²a R_0 = 2 (1 - cos a). */
LMPI_INLINE void subtended_factors(int bands, const lmpi_subtended_cap *subtended, float *factors) {
    const float odd = pi * subtended->sin2, even = subtended->inside ? -odd : odd;
    lmpi_cap_polynomials(bands, subtended->one_minus_cos, factors);
    for (int l = 1; l < bands; l++)
        factors[l] *= l % 2 == 0 ? even : odd;
    factors[0] = 2 * pi * (subtended->inside ? 1 + subtended->cosine : subtended->one_minus_cos);
}

void lmp_sphere_project_zonal(int bands, float radius, float distance, float *zonal) {
    assert(lmpi_is_bands(bands) && lmpi_is_length(radius) && distance >= 0 && isfinite(distance));
    lmpi_subtended_cap subtended;
    lmpi_subtended_at_distance(radius, distance, &subtended);
    subtended_factors(bands, &subtended, zonal);
    for (int l = 0; l < bands; l++)
        zonal[l] *= lmpi_table_pole[l];
}

LMPI_INLINE void subtended_project(int bands, const lmpi_subtended_cap *subtended, float *sh) {
    float factors[LMP_BANDS_MAX];
    subtended_factors(bands, subtended, factors);
    lmpi_sh_put(bands, subtended->axis, NULL, factors, sh);
}

void lmp_sphere_project(int bands, lmp_vec3 center, float radius, lmp_vec3 point, float *sh) {
    assert(lmpi_is_bands(bands) && lmpi_is_length(radius));
    assert(lmpi_is_point(center) && lmpi_is_point(point));
    lmpi_subtended_cap subtended;
    lmpi_subtended_by_sphere(center, radius, point, &subtended);
    if (bands <= LMPI_SINGLE_BANDS) {
        lmpi_single_cap cap = { .axis = subtended.axis };
        LMPI_STRAIGHT(bands, subtended_factors, &subtended, cap.factors)
        lmpi_single_get()->cap[bands](&cap, sh);
        return;
    }
    LMPI_STRAIGHT_SMALL(bands, subtended_project, &subtended, sh)
}

/* --- the gradient ----------------------------------------------------------------------------- */

/* What the gradient of one band needs: with k = pi sin²a / d,
 * grad L_lm = k [ (2 P_l / cos a) Y_lm w - R_l gradT Y_lm ]. */
typedef struct band_slopes {
    lmp_vec3 axis;
    float radial[LMP_BANDS_MAX];     /* 2 k P_l / |cos a| */
    float tangential[LMP_BANDS_MAX]; /* k R_l */
} band_slopes;

static void prepare_slopes(int bands, const lmpi_subtended_cap *subtended, float radius,
                           band_slopes *slopes) {
    /* sin²a / d, which is d / r² inside */
    const float ratio = subtended->inside ? subtended->distance / radius / radius
                                          : subtended->sin2 / subtended->distance;
    const float cosine = subtended->cosine > LMP_COS_MIN ? subtended->cosine : LMP_COS_MIN;
    slopes->axis = subtended->axis;
    lmpi_legendre_polynomials(bands, subtended->one_minus_cos, slopes->radial);
    lmpi_cap_polynomials(bands, subtended->one_minus_cos, slopes->tangential);
    for (int l = 0; l < bands; l++) {
        /* at cos a < 0, P_l has the parity of l and R_l that of l-1 */
        const float p_sign = subtended->inside && l % 2 != 0 ? -1.f : 1.f;
        const float r_sign = subtended->inside && l % 2 == 0 ? -1.f : 1.f;
        slopes->radial[l] *= p_sign * (2 * pi * ratio / cosine);
        slopes->tangential[l] *= r_sign * (pi * ratio);
    }
}

/* Stores one coefficient's gradient, given the value y and the derivative g of its polynomial
 * extension, whose tangent part is g - (g·w) w. */
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
    assert(lmpi_is_bands(bands) && lmpi_is_length(radius));
    assert(lmpi_is_point(center) && lmpi_is_point(point));
    lmpi_subtended_cap subtended;
    lmpi_subtended_by_sphere(center, radius, point, &subtended);
    assert(subtended.distance > 0 || radius > 0);
    assert(lmpi_are_apart(sh, LMP_SH_COUNT(bands), gradient, 3 * LMP_SH_COUNT(bands)));
    float factors[LMP_BANDS_MAX];
    band_slopes slopes;
    subtended_factors(bands, &subtended, factors);
    prepare_slopes(bands, &subtended, radius, &slopes);

    float columns[2][LMP_BANDS_MAX + 1];
    lmpi_azimuth before = { 0, 0 }, now = { 1, 0 };
    lmpi_sh_column(bands, 0, subtended.axis.z, columns[0]);
    for (int m = 0; m < bands; m++) {
        const float *q = columns[m % 2];
        float *above = columns[(m + 1) % 2]; /* q_l^(m+1), 0 at l = m */
        if (m + 1 < bands)
            lmpi_sh_column(bands, m + 1, subtended.axis.z, above);
        above[m] = 0;
        for (int l = m; l < bands; l++) {
            const float slope = lmpi_table_slope[lmpi_table_index(l, m)] * above[l];
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
        now = lmpi_azimuth_next(now, subtended.axis);
    }
}
