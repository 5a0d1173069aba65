/* SPDX-License-Identifier: MIT */
/* Rotation by Wigner's d, R = Rz(alpha) Ry(beta) Rz(gamma). For each (m, k) the three-term
 * recurrence in l starts from a closed form at l = max(|m|, |k|) and runs upward, its stable
 * direction; so float32 orthogonality holds to 128 bands, where the recurrence of Ivanic and
 * Ruedenberg has lost it. All in double: the entries, not the path to them, are float. */
#include "src/base/precondition.h"

#include <lampion/sh.h>

#include <math.h>
#include <stdlib.h>

enum { POWERS = 2 * LMP_BANDS_MAX };

/* What the entries are made of, for one rotation. */
typedef struct euler {
    double cos_beta;
    double cos_half[POWERS], sin_half[POWERS]; /* powers of cos and sin of beta/2 */
    double log_factorial[POWERS];
    double alpha_cos[LMP_BANDS_MAX], alpha_sin[LMP_BANDS_MAX]; /* of m alpha */
    double gamma_cos[LMP_BANDS_MAX], gamma_sin[LMP_BANDS_MAX]; /* of k gamma */
} euler;

static void euler_prepare(euler *angles, int bands, const double q[4]) {
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double c = hypot(z, w), s = hypot(x, y), length = hypot(c, s);
    assert(length > 0 && isfinite(length));
    /* q = qz(alpha) qy(beta) qz(gamma): the half angles come from q itself, without cancellation */
    const double half_sum = atan2(z, w), half_difference = atan2(-x, y);
    angles->cos_beta = (c - s) * (c + s) / (length * length);
    angles->cos_half[0] = angles->sin_half[0] = 1;
    angles->log_factorial[0] = 0;
    for (int i = 1; i < 2 * bands; i++) {
        angles->cos_half[i] = angles->cos_half[i - 1] * (c / length);
        angles->sin_half[i] = angles->sin_half[i - 1] * (s / length);
        angles->log_factorial[i] = angles->log_factorial[i - 1] + log(i);
    }
    for (int m = 0; m < bands; m++) {
        angles->alpha_cos[m] = cos(m * (half_sum + half_difference));
        angles->alpha_sin[m] = sin(m * (half_sum + half_difference));
        angles->gamma_cos[m] = cos(m * (half_sum - half_difference));
        angles->gamma_sin[m] = sin(m * (half_sum - half_difference));
    }
}

/* d^l_mk at l = max(m, |k|), m >= 0. An underflow to 0 is harmless: the recurrence multiplies it by
 * less than 1e80 up to 128 bands. */
static double wigner_first(const euler *angles, int m, int k) {
    const int l = m > abs(k) ? m : abs(k), other = m > abs(k) ? k : k < 0 ? -m : m;
    const double *f = angles->log_factorial;
    const double root = exp((f[2 * l] - f[l + other] - f[l - other]) / 2);
    const double size = root * angles->cos_half[l + other] * angles->sin_half[l - other];
    /* d^l_lk carries (-sin)^(l-k); d^l_ml = (-1)^(l-m) d^l_lm carries sin^(l-m) */
    const int odd = (l - other) % 2 != 0;
    return odd && (k <= m) ? -size : size;
}

/* d[l] = d^l_mk for l = max(m, |k|) … bands-1. */
static void wigner(const euler *angles, int bands, int m, int k, double *d) {
    const int first = m > abs(k) ? m : abs(k);
    const double mm = (double)m * m, kk = (double)k * k;
    double root = 0; /* sqrt((l²-m²)(l²-k²)) */
    d[first] = wigner_first(angles, m, k);
    for (int l = first; l + 1 < bands; l++) {
        const double up = (double)(l + 1) * (l + 1), tilt = l > 0 ? (double)m * k / l : 0;
        const double next = sqrt((up - mm) * (up - kk));
        double value = (2 * l + 1) * ((l + 1) * angles->cos_beta - tilt) * d[l];
        if (l > first)
            value -= (l + 1) * root / l * d[l - 1];
        d[l + 1] = value / next;
        root = next;
    }
}

/* Where the entries go: to floats or to doubles, the other NULL. */
typedef struct matrices_of {
    float *floats;
    double *doubles;
} matrices_of;

static void put(const matrices_of *matrices, int l, int m, int k, double value) {
    const size_t at = LMP_SH_ROTATION_COUNT(l) + (size_t)((l + m) * (2 * l + 1) + l + k);
    if (matrices->floats)
        matrices->floats[at] = (float)value;
    else
        matrices->doubles[at] = value;
}

/* The entries (±m, ±k) of all bands. From Y^m(Rw) = Σ_k exp(i m alpha) d_mk exp(i k gamma) Y^k(w)
 * for the complex harmonics, and Y_l,±m = sqrt(2) {Re, Im} Y^m. */
static void fill(const euler *angles, int bands, int m, int k, const matrices_of *matrices) {
    double plus[LMP_BANDS_MAX], minus[LMP_BANDS_MAX];
    wigner(angles, bands, m, k, plus);
    wigner(angles, bands, m, -k, minus);
    const double ca = angles->alpha_cos[m], sa = angles->alpha_sin[m];
    const double cg = angles->gamma_cos[k], sg = angles->gamma_sin[k];
    const double sum_c = ca * cg - sa * sg, sum_s = sa * cg + ca * sg;
    const double difference_c = ca * cg + sa * sg, difference_s = sa * cg - ca * sg;
    const double sign = k % 2 ? -1 : 1;
    for (int l = m > k ? m : k; l < bands; l++) {
        const double p = plus[l], s = sign * minus[l];
        if (m == 0 || k == 0) {
            /* one of ±m, ±k is one entry, where p = s */
            const double scale = m == 0 && k == 0 ? 1 : sqrt(2);
            put(matrices, l, -m, k, scale * p * sum_s);
            put(matrices, l, m, -k, scale * p * -sum_s);
            put(matrices, l, m, k, scale * p * sum_c);
        } else {
            put(matrices, l, m, k, p * sum_c + s * difference_c);
            put(matrices, l, m, -k, s * difference_s - p * sum_s);
            put(matrices, l, -m, k, p * sum_s + s * difference_s);
            put(matrices, l, -m, -k, p * sum_c - s * difference_c);
        }
    }
}

static void rotation_of(int bands, const double rotation[4], const matrices_of *matrices) {
    assert(lmp_is_bands(bands));
    euler angles;
    euler_prepare(&angles, bands, rotation);
    for (int m = 0; m < bands; m++)
        for (int k = 0; k < bands; k++)
            fill(&angles, bands, m, k, matrices);
}

void lmp_sh_rotation(int bands, lmp_quat rotation, float *matrices) {
    const double q[4] = { (double)rotation.x, (double)rotation.y, (double)rotation.z,
                          (double)rotation.w };
    rotation_of(bands, q, &(matrices_of) { .floats = matrices });
}

void lmp_sh_rotation_double(int bands, const double rotation[4], double *matrices) {
    rotation_of(bands, rotation, &(matrices_of) { .doubles = matrices });
}

/* One loop in two types: a block of each band times that band's coefficients. */
#define ROTATE(number)                                                                             \
    for (int l = 0; l < bands; l++) {                                                              \
        const number *in = sh + LMP_SH_COUNT(l);                                                   \
        for (int m = 0; m <= 2 * l; m++) {                                                         \
            number sum = 0;                                                                        \
            for (int k = 0; k <= 2 * l; k++)                                                       \
                sum += *matrices++ * in[k];                                                        \
            *rotated++ = sum;                                                                      \
        }                                                                                          \
    }

void lmp_sh_rotate(int bands, const float *matrices, const float *sh, float *rotated) {
    assert(lmp_is_bands(bands));
    assert(lmp_are_apart(sh, LMP_SH_COUNT(bands), rotated, LMP_SH_COUNT(bands)));
    assert(lmp_are_apart(matrices, LMP_SH_ROTATION_COUNT(bands), rotated, LMP_SH_COUNT(bands)));
    ROTATE(float)
}

void lmp_sh_rotate_double(int bands, const double *matrices, const double *sh, double *rotated) {
    const size_t size = LMP_SH_COUNT(bands) * sizeof *sh;
    assert(lmp_is_bands(bands) && lmp_are_bytes_apart(sh, size, rotated, size));
    assert(lmp_are_bytes_apart(matrices, LMP_SH_ROTATION_COUNT(bands) * sizeof *matrices, rotated,
                               size));
    (void)size;
    ROTATE(double)
}

/* The unit quaternion of a matrix, from its largest component so that nothing cancels. */
static lmp_quat quaternion_of(const float r[9]) {
    const float trace = r[0] + r[4] + r[8];
    const float four[4] = { 1 + 2 * r[0] - trace, 1 + 2 * r[4] - trace, 1 + 2 * r[8] - trace,
                            1 + trace };
    int largest = 0;
    for (int i = 1; i < 4; i++)
        if (four[i] > four[largest])
            largest = i;
    /* 4 q_i q_j for every pair of x, y, z, w */
    const float products[4][4] = {
        { four[0], r[1] + r[3], r[2] + r[6], r[7] - r[5] },
        { r[1] + r[3], four[1], r[5] + r[7], r[2] - r[6] },
        { r[2] + r[6], r[5] + r[7], four[2], r[3] - r[1] },
        { r[7] - r[5], r[2] - r[6], r[3] - r[1], four[3] },
    };
    const float *q = products[largest];
    return (lmp_quat) { q[0], q[1], q[2], q[3] };
}

void lmp_sh_rotation_from_matrix(int bands, const float rotation[9], float *matrices) {
    assert(lmp_is_rotation(rotation));
    lmp_sh_rotation(bands, quaternion_of(rotation), matrices);
}

void lmp_sh_rotate_z(int bands, float angle, const float *sh, float *rotated) {
    assert(lmp_is_bands(bands));
    assert(isfinite(angle) && lmp_are_same_or_apart(sh, rotated, LMP_SH_COUNT(bands)));
    const double step_c = cos((double)angle), step_s = sin((double)angle);
    double wide_c = 1, wide_s = 0; /* of m angles */
    for (int m = 0; m < bands; m++) {
        const float c = (float)wide_c, s = (float)wide_s;
        const double next_c = wide_c * step_c - wide_s * step_s;
        wide_s = wide_c * step_s + wide_s * step_c;
        wide_c = next_c;
        for (int l = m; l < bands; l++) {
            const float plus = sh[LMP_SH_INDEX(l, m)], minus = sh[LMP_SH_INDEX(l, -m)];
            /* -m first: at m = 0 both are one coefficient, which stays */
            rotated[LMP_SH_INDEX(l, -m)] = s * plus + c * minus;
            rotated[LMP_SH_INDEX(l, m)] = m > 0 ? c * plus - s * minus : plus;
        }
    }
}
