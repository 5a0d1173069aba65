/* SPDX-License-Identifier: MIT */
#include "src/sh/column.h"

#include <lampion/sh.h>

#include <assert.h>

void lmp_sh_eval(int bands, lmp_vec3 direction, float *sh) {
    assert(bands >= 1 && bands <= LMP_BANDS_MAX);
    float q[LMP_BANDS_MAX];
    lmp_azimuth a = { 1, 0 };
    for (int m = 0; m < bands; m++) {
        lmp_sh_column(bands, m, direction.z, q);
        for (int l = m; l < bands; l++) {
            /* -m first: at m = 0 both are one place, and cosine wins */
            sh[LMP_SH_INDEX(l, -m)] = q[l] * a.s;
            sh[LMP_SH_INDEX(l, m)] = q[l] * a.c;
        }
        a = lmp_azimuth_next(a, direction);
    }
}

float lmp_sh_dot(int bands, const float *a, const float *b) {
    assert(bands >= 1 && bands <= LMP_BANDS_MAX);
    float sum = 0;
    for (int l = 0; l < bands; l++) {
        float band = 0;
        for (int m = -l; m <= l; m++)
            band += a[LMP_SH_INDEX(l, m)] * b[LMP_SH_INDEX(l, m)];
        sum += band;
    }
    return sum;
}

float lmp_sh_filtered(int bands, const float *sh, const float *factors, lmp_vec3 direction) {
    assert(bands >= 1 && bands <= LMP_BANDS_MAX);
    float q[LMP_BANDS_MAX], sum = 0;
    lmp_azimuth a = { 1, 0 };
    for (int m = 0; m < bands; m++) {
        lmp_sh_column(bands, m, direction.z, q);
        float cosine = 0, sine = 0;
        for (int l = m; l < bands; l++) {
            const float weight = factors ? q[l] * factors[l] : q[l];
            cosine += weight * sh[LMP_SH_INDEX(l, m)];
            sine += weight * sh[LMP_SH_INDEX(l, -m)];
        }
        sum += cosine * a.c + sine * a.s;
        a = lmp_azimuth_next(a, direction);
    }
    return sum;
}

float lmp_sh_reconstruct(int bands, const float *sh, lmp_vec3 direction) {
    return lmp_sh_filtered(bands, sh, NULL, direction);
}

void lmp_sh_from_zonal(int bands, const float *zonal, lmp_vec3 axis, float *sh) {
    assert(bands >= 1 && bands <= LMP_BANDS_MAX);
    float weights[LMP_BANDS_MAX];
    for (int l = 0; l < bands; l++)
        weights[l] = zonal[l] / lmp_table_pole[l];
    lmp_sh_eval(bands, axis, sh);
    lmp_sh_window_apply(bands, weights, sh, sh);
}
