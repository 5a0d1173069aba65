/* SPDX-License-Identifier: MIT */
#include "src/lobe/response.h"

#include "src/base/precondition.h"
#include "src/sphere/sphere.h"

void lmpi_lobe_weights(int bands, const float *lambda, float *weights) {
    for (int l = 0; l < bands; l++) {
        weights[l] = lmpi_table_pole[l] * lmpi_table_pole[l] * lambda[l];
        LMPI_ONE_BY_ONE(l);
    }
}

/* Sums P_l(q·w) by differences from 1 - |q·w| = |q ∓ w|²/2, which is as exact as q and w are where
 * a narrow lobe points at the light; the rounding of q·w itself would cost l² units there. */
float lmpi_lobe_sum(int bands, const float *weights, const float *r, lmp_vec3 q, lmp_vec3 w) {
    const float sign = q.x * w.x + q.y * w.y + q.z * w.z < 0 ? -1.f : 1.f;
    const float x = q.x - sign * w.x, y = q.y - sign * w.y, z = q.z - sign * w.z;
    const float one_minus_cos = (x * x + y * y + z * z) / 2;
    float even = weights[0] * r[0], odd = 0, difference = 0, legendre = 1;
    for (int l = 1; l < bands; l++) {
        difference = lmpi_table_legendre_d[l] * difference -
                     lmpi_table_legendre_t[l] * (one_minus_cos * legendre);
        legendre += difference;
        const float term = weights[l] * r[l] * legendre;
        if (l % 2 != 0)
            odd += term;
        else
            even += term;
    }
    return even + sign * odd;
}

/* Returns Σ_l weights[l] ∫ P_l(q·w) dw over what is seen. */
static float loop_sum(int bands, const float *weights, const lmpi_loop *loop, lmp_vec3 q) {
    double moments[LMP_BANDS_MAX], sum = 0;
    lmpi_loop_moments(bands, loop, lmpi_vector_unit(lmpi_vector_of(q)), moments);
    for (int l = 0; l < bands; l++)
        sum += (double)weights[l] * moments[l];
    return (float)sum;
}

void lmpi_lobe_add(const lmp_cap *cap, float response, float lambda_0, lmp_rgb *sum) {
    sum->r += cap->strength.r * response + cap->ambient.r * lambda_0;
    sum->g += cap->strength.g * response + cap->ambient.g * lambda_0;
    sum->b += cap->strength.b * response + cap->ambient.b * lambda_0;
}

void lmpi_lobe_add_seen(int bands, const float *weights, float lambda_0, const float *r, lmp_vec3 q,
                        const lmpi_seen *seen, lmp_rgb *sum) {
    if (!seen->is_loop) {
        lmpi_lobe_add(&seen->cap, lmpi_lobe_sum(bands, weights, r, q, seen->cap.axis), lambda_0,
                      sum);
        return;
    }
    const float response = loop_sum(bands, weights, &seen->loop, q);
    sum->r += seen->radiance.r * response;
    sum->g += seen->radiance.g * response;
    sum->b += seen->radiance.b * response;
}

lmp_rgb lmp_lobe_response(int bands, const float *lambda, lmp_vec3 axis, const lmp_light *lights,
                          size_t count, lmp_vec3 point) {
    assert(lmpi_is_bands(bands) && lmpi_is_unit(axis));
    float weights[LMP_BANDS_MAX], r[LMP_BANDS_MAX];
    lmp_rgb sum = { 0, 0, 0 };
    lmpi_lobe_weights(bands, lambda, weights);
    for (size_t i = 0; i < count; i++) {
        lmpi_seen seen;
        lmpi_light_see(&lights[i], point, &seen);
        if (!seen.is_loop)
            lmpi_cap_polynomials(bands, seen.cap.one_minus_cos, r);
        lmpi_lobe_add_seen(bands, weights, lambda[0], r, axis, &seen, &sum);
    }
    return sum;
}
