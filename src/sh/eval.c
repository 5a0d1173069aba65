/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"
#include "src/kernels/single.h"
#include "src/sh/column.h"

#include <lampion/sh.h>

void lmp_sh_values(int bands, lmp_vec3 direction, float *sh) {
    if (bands <= LMP_SINGLE_BANDS) {
        lmp_single_get()->eval[bands](direction, sh);
        return;
    }
    LMP_STRAIGHT_SMALL(bands, lmp_sh_put, direction, NULL, NULL, sh)
}

void lmp_sh_eval(int bands, lmp_vec3 direction, float *sh) {
    assert(lmp_is_bands(bands));
    assert(lmp_is_unit(direction));
    if (bands <= LMP_SINGLE_BANDS)
        lmp_single_get()->eval[bands](direction, sh);
    else
        lmp_sh_values(bands, direction, sh);
}

void lmp_sh_zonal_bands(int low, int high, const float *factors, lmp_vec3 axis, float *sh) {
    const size_t first = LMP_SH_COUNT(low);
    float q[LMP_BANDS_MAX];
    lmp_azimuth a = { 1, 0 };
    for (int m = 0; m < high; m++) {
        lmp_sh_column(high, m, axis.z, q);
        for (int l = m > low ? m : low; l < high; l++) {
            sh[LMP_SH_INDEX(l, -m) - first] = factors[l] * q[l] * a.s;
            sh[LMP_SH_INDEX(l, m) - first] = factors[l] * q[l] * a.c;
        }
        a = lmp_azimuth_next(a, axis);
    }
}

float lmp_sh_dot(int bands, const float *a, const float *b) {
    assert(lmp_is_bands(bands));
    if (bands <= LMP_SINGLE_BANDS)
        return lmp_single_get()->dot[bands](a, b);
    float sum = 0;
    for (int l = 0; l < bands; l++) {
        float band = 0;
        for (int m = -l; m <= l; m++)
            band += a[LMP_SH_INDEX(l, m)] * b[LMP_SH_INDEX(l, m)];
        sum += band;
    }
    return sum;
}

float lmp_sh_reconstruct(int bands, const float *sh, lmp_vec3 direction) {
    assert(lmp_is_bands(bands) && lmp_is_unit(direction));
    float q[LMP_BANDS_MAX], sum = 0;
    lmp_azimuth a = { 1, 0 };
    for (int m = 0; m < bands; m++) {
        lmp_sh_column(bands, m, direction.z, q);
        float cosine = 0, sine = 0;
        for (int l = m; l < bands; l++) {
            cosine += q[l] * sh[LMP_SH_INDEX(l, m)];
            sine += q[l] * sh[LMP_SH_INDEX(l, -m)];
        }
        sum += cosine * a.c + sine * a.s;
        a = lmp_azimuth_next(a, direction);
    }
    return sum;
}

void lmp_sh_from_zonal(int bands, const float *zonal, lmp_vec3 axis, float *sh) {
    assert(lmp_is_bands(bands));
    assert(lmp_are_apart(zonal, (size_t)bands, sh, LMP_SH_COUNT(bands)));
    float weights[LMP_BANDS_MAX];
    for (int l = 0; l < bands; l++)
        weights[l] = zonal[l] / lmp_table_pole[l];
    lmp_sh_eval(bands, axis, sh);
    lmp_sh_window_apply(bands, weights, sh, sh);
}

void lmp_sh_combine(int bands, float s, const float *a, float t, const float *b, float *sh) {
    assert(lmp_is_bands(bands));
    assert(lmp_are_same_or_apart(a, sh, LMP_SH_COUNT(bands)));
    assert(lmp_are_same_or_apart(b, sh, LMP_SH_COUNT(bands)));
    if (bands <= LMP_SINGLE_BANDS) {
        lmp_single_get()->combine[bands](s, a, t, b, sh);
        return;
    }
    for (size_t i = 0; i < LMP_SH_COUNT(bands); i++)
        sh[i] = s * a[i] + t * b[i];
}

/* --- gradient --------------------------------------------------------------------------------- */

/* The derivatives of the polynomial q(z) C, without their part along the direction w: those of
 * Y(v/|v|) at w. */
static void put_gradient(lmp_vec3 g, lmp_vec3 w, size_t i, size_t plane, float *gradient) {
    const float along = g.x * w.x + g.y * w.y + g.z * w.z;
    gradient[i] = g.x - along * w.x;
    gradient[plane + i] = g.y - along * w.y;
    gradient[2 * plane + i] = g.z - along * w.z;
}

void lmp_sh_eval_gradient(int bands, lmp_vec3 direction, float *sh, float *gradient) {
    assert(lmp_is_bands(bands));
    assert(lmp_is_unit(direction));
    assert(lmp_are_apart(sh, LMP_SH_COUNT(bands), gradient, 3 * LMP_SH_COUNT(bands)));
    const size_t plane = LMP_SH_COUNT(bands);
    float q[LMP_BANDS_MAX + 1], above[LMP_BANDS_MAX + 1]; /* q_l^m and q_l^(m+1) */
    lmp_azimuth a = { 1, 0 }, below = { 0, 0 };           /* (x + iy)^m and ^(m-1) */
    lmp_sh_column(bands, 0, direction.z, q);
    for (int m = 0; m < bands; m++) {
        const float *slope = lmp_table_slope + lmp_table_index(m, m), k = (float)m;
        above[m] = 0;
        if (m + 1 < bands)
            lmp_sh_column(bands, m + 1, direction.z, above);
        for (int l = m; l < bands; l++) {
            const float dz = slope[l - m] * above[l];
            const lmp_vec3 sine = { k * q[l] * below.s, k * q[l] * below.c, dz * a.s };
            const lmp_vec3 cosine = { k * q[l] * below.c, -k * q[l] * below.s, dz * a.c };
            /* -m first: at m = 0 both are one coefficient, and cosine wins */
            sh[LMP_SH_INDEX(l, -m)] = q[l] * a.s;
            put_gradient(sine, direction, LMP_SH_INDEX(l, -m), plane, gradient);
            sh[LMP_SH_INDEX(l, m)] = q[l] * a.c;
            put_gradient(cosine, direction, LMP_SH_INDEX(l, m), plane, gradient);
        }
        below = a;
        a = lmp_azimuth_next(a, direction);
        for (int l = m + 1; l < bands; l++)
            q[l] = above[l];
    }
}
