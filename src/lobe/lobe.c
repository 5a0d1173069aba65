/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"

#include <lampion/lobe.h>

#include <math.h>

static const double pi = 3.14159265358979323846;

void lmp_lobe_make_diffuse(int bands, float *lambda) {
    assert(lmpi_is_bands(bands));
    double even = pi / 4; /* lambda of l = 2, 4, … */
    for (int l = 0; l < bands; l++) {
        if (l < 2) {
            lambda[l] = (float)(l == 0 ? pi : 2 * pi / 3);
        } else if (l % 2 != 0) {
            lambda[l] = 0;
        } else {
            lambda[l] = (float)even;
            even *= -(l - 1.0) / (l + 4.0);
        }
    }
}

void lmp_lobe_make_phong(int bands, float exponent, float *lambda) {
    assert(lmpi_is_bands(bands));
    assert(exponent >= 0 && isfinite(exponent));
    const double e = (double)exponent;
    double before = 1, now = (e + 1) / (e + 2); /* lambda_(l-1), lambda_l */
    lambda[0] = 1;
    for (int l = 1; l < bands; l++) {
        lambda[l] = (float)now;
        const double next = before * (e - (l + 1) + 2) / (e + (l + 1) + 1);
        before = now;
        now = next;
    }
}

/* Computes ratios of spherical Bessel functions by the downward recurrence: upward it would amplify
 * rounding. The recurrence forgets its start, which is exact above a concentration of 1e8. */
void lmp_lobe_make_vmf(int bands, float concentration, float *lambda) {
    assert(lmpi_is_bands(bands));
    assert(concentration > 0 && isfinite(concentration));
    const double k = (double)concentration;
    const int start = bands + 20 + (int)(6 * sqrt(fmin(fabs(k), 1e8)));
    double ratio = k / (start + 1 + sqrt((start + 1.0) * (start + 2.0) + k * k));
    double ratios[LMP_BANDS_MAX];
    for (int l = start; l >= 1; l--) {
        ratio = 1 / ((2 * l + 1) / k + ratio);
        if (l < bands)
            ratios[l] = ratio;
    }
    double value = 1;
    for (int l = 0; l < bands; l++) {
        value *= l > 0 ? ratios[l] : 1;
        lambda[l] = (float)value;
    }
}

void lmp_lobe_project(int bands, const float *lambda, lmp_vec3 axis, float *sh) {
    lmp_sh_eval(bands, axis, sh);
    lmp_sh_apply_window(bands, lambda, sh, sh);
}
