/* SPDX-License-Identifier: MIT */
#include "src/lobe/response.h"
#include "src/base/precondition.h"

#include "src/light/cap.h"

void lmp_lobe_weights(int bands, const float *lambda, float *weights) {
    for (int l = 0; l < bands; l++) {
        weights[l] = lmp_table_pole[l] * lmp_table_pole[l] * lambda[l];
        LMP_ONE_BY_ONE(l);
    }
}

/* P_l(q·w) by differences from 1 - |q·w| = |q ∓ w|²/2, as exact as q and w are where a narrow lobe
 * points at the light; the rounding of q·w itself would cost l² units there. */
float lmp_lobe_sum(int bands, const float *weights, const float *r, lmp_vec3 q, lmp_vec3 w) {
    const float sign = q.x * w.x + q.y * w.y + q.z * w.z < 0 ? -1.f : 1.f;
    const float x = q.x - sign * w.x, y = q.y - sign * w.y, z = q.z - sign * w.z;
    const float one_minus_cos = (x * x + y * y + z * z) / 2;
    float even = weights[0] * r[0], odd = 0, difference = 0, legendre = 1;
    for (int l = 1; l < bands; l++) {
        difference = lmp_table_legendre_d[l] * difference -
                     lmp_table_legendre_t[l] * (one_minus_cos * legendre);
        legendre += difference;
        const float term = weights[l] * r[l] * legendre;
        if (l % 2 != 0)
            odd += term;
        else
            even += term;
    }
    return even + sign * odd;
}

void lmp_lobe_add(const lmp_cap *cap, float response, float lambda_0, lmp_rgb *sum) {
    sum->r += cap->strength.r * response + cap->ambient.r * lambda_0;
    sum->g += cap->strength.g * response + cap->ambient.g * lambda_0;
    sum->b += cap->strength.b * response + cap->ambient.b * lambda_0;
}

lmp_rgb lmp_lobe_response(int bands, const float *lambda, lmp_vec3 axis, const lmp_light *lights,
                          size_t count, lmp_vec3 point) {
    assert(lmp_is_bands(bands) && lmp_is_unit(axis));
    float weights[LMP_BANDS_MAX], r[LMP_BANDS_MAX];
    lmp_rgb sum = { 0, 0, 0 };
    lmp_lobe_weights(bands, lambda, weights);
    for (size_t i = 0; i < count; i++) {
        lmp_cap cap;
        lmp_light_cap(&lights[i], point, &cap);
        lmp_cap_polynomials(bands, cap.one_minus_cos, r);
        lmp_lobe_add(&cap, lmp_lobe_sum(bands, weights, r, axis, cap.axis), lambda[0], &sum);
    }
    return sum;
}
