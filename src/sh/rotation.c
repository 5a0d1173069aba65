/* SPDX-License-Identifier: MIT */
/* rotation.c - rotation by Wigner's d, R = Rz(alpha) Ry(beta) Rz(gamma). For each (m, k) the
 * three-term recurrence in l starts from a closed form at l = max(|m|, |k|) and runs upward, its
 * stable direction; so float32 orthogonality holds to 128 bands, where the recurrence of Ivanic and
 * Ruedenberg has lost it. All is computed in double; only the entries are float. Angles are cosines
 * and sines from the start, so only the square root is taken from the C library. */
#include "src/base/precondition.h"
#include "src/kernels/dispatch.h"
#include "src/kernels/euler.h"

#include <lampion/sh.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POWERS = 2 * LMP_BANDS_MAX };

/* What the matrices of one rotation are computed from. */
typedef struct euler {
    double cos_beta;
    double cos_half[POWERS], sin_half[POWERS];                 /* powers of cos and sin of beta/2 */
    double alpha_cos[LMP_BANDS_MAX], alpha_sin[LMP_BANDS_MAX]; /* of m alpha */
    double gamma_cos[LMP_BANDS_MAX], gamma_sin[LMP_BANDS_MAX]; /* of k gamma */
} euler;

static void multiples(int bands, double c1, double s1, double *c, double *s) {
    c[0] = 1;
    s[0] = 0;
    for (int m = 1; m < bands; m++) {
        /* The product of two halves: an error of the angle grows with the logarithm of m, not with
         * m. */
        const int a = m / 2, b = m - a;
        c[m] = m == 1 ? c1 : c[a] * c[b] - s[a] * s[b];
        s[m] = m == 1 ? s1 : c[a] * s[b] + s[a] * c[b];
    }
}

static void euler_prepare(euler *angles, int bands, const double q[4]) {
    const double largest = fmax(fmax(fabs(q[0]), fabs(q[1])), fmax(fabs(q[2]), fabs(q[3])));
    assert(largest > 0 && isfinite(largest));
    const double x = q[0] / largest, y = q[1] / largest, z = q[2] / largest, w = q[3] / largest;
    const double c = sqrt(z * z + w * w), s = sqrt(x * x + y * y), length = sqrt(c * c + s * s);
    /* q = qz(alpha) qy(beta) qz(gamma): the half angles come from q itself, without cancellation;
     * (w, z) / c is half their sum, (y, -x) / s half their difference */
    const double sum_c = c > 0 ? w / c : 1, sum_s = c > 0 ? z / c : 0;
    const double difference_c = s > 0 ? y / s : 1, difference_s = s > 0 ? -x / s : 0;
    angles->cos_beta = (c - s) * (c + s) / (length * length);
    angles->cos_half[0] = angles->sin_half[0] = 1;
    for (int i = 1; i < 2 * bands; i++) {
        angles->cos_half[i] = angles->cos_half[i - 1] * (c / length);
        angles->sin_half[i] = angles->sin_half[i - 1] * (s / length);
    }
    multiples(bands, sum_c * difference_c - sum_s * difference_s,
              sum_s * difference_c + sum_c * difference_s, angles->alpha_cos, angles->alpha_sin);
    multiples(bands, sum_c * difference_c + sum_s * difference_s,
              sum_s * difference_c - sum_c * difference_s, angles->gamma_cos, angles->gamma_sin);
}

/* Computes d^l_mk and d^l_m,-k of l = m … bands-1, 0 <= k <= m, at index l. root is the square root
 * of (2m)! over (m+k)! (m-k)!. An underflow to 0 is harmless: the recurrence multiplies it by less
 * than 1e80 up to 128 bands. */
static void wigner(const euler *angles, int bands, int m, int k, double root, double *plus,
                   double *minus) {
    const double mm = (double)m * m, kk = (double)k * k;
    double before = 0; /* sqrt((l²-m²)(l²-k²)) */
    /* d^m_mk carries (-sin)^(m-k) */
    plus[m] = root * angles->cos_half[m + k] * angles->sin_half[m - k];
    minus[m] = root * angles->cos_half[m - k] * angles->sin_half[m + k];
    if ((m - k) % 2 != 0) {
        plus[m] = -plus[m];
        minus[m] = -minus[m];
    }
    for (int l = m; l + 1 < bands; l++) {
        const double up = (double)(l + 1) * (l + 1), tilt = l > 0 ? (double)m * k / l : 0;
        const double next = sqrt((up - mm) * (up - kk)), per = 1 / next, wide = 2 * l + 1;
        const double middle = (l + 1) * angles->cos_beta;
        double p = wide * (middle - tilt) * plus[l], s = wide * (middle + tilt) * minus[l];
        if (l > m) {
            const double back = (l + 1) * before / l;
            p -= back * plus[l - 1];
            s -= back * minus[l - 1];
        }
        plus[l + 1] = p * per;
        minus[l + 1] = s * per;
        before = next;
    }
}

/* Where the entries go: into matrices of floats or of doubles, or, times coefficients, into sums.
 * Unused members are NULL. */
typedef struct entries_to {
    float *floats;
    double *doubles;
    const float *sh;
    float *rotated;
} entries_to;

static inline void put(const entries_to *to, int l, int m, int k, double value) {
    const size_t at = LMP_SH_ROTATION_COUNT(l) + (size_t)((l + m) * (2 * l + 1) + l + k);
    if (to->floats)
        to->floats[at] = (float)value;
    else if (to->doubles)
        to->doubles[at] = value;
    else
        to->rotated[LMP_SH_INDEX(l, m)] += (float)value * to->sh[LMP_SH_INDEX(l, k)];
}

/* Computes the entries (±m, ±k) of bands first … bands-1 from d^l_mk and (-1)^k d^l_m,-k. They
 * follow from Y^m(Rw) = Σ_k exp(i m alpha) d_mk exp(i k gamma) Y^k(w) for the complex harmonics,
 * and Y_l,±m = sqrt(2) {Re, Im} Y^m. */
static void fill(const euler *angles, int bands, int m, int k, const double signs[2],
                 const double *plus, const double *minus, const entries_to *to) {
    const double ca = angles->alpha_cos[m], sa = angles->alpha_sin[m];
    const double cg = angles->gamma_cos[k], sg = angles->gamma_sin[k];
    const double sum_c = ca * cg - sa * sg, sum_s = sa * cg + ca * sg;
    const double difference_c = ca * cg + sa * sg, difference_s = sa * cg - ca * sg;
    for (int l = m > k ? m : k; l < bands; l++) {
        const double p = signs[0] * plus[l], s = signs[1] * minus[l];
        if (m == 0 || k == 0) {
            /* one of ±m, ±k is one entry, where p = s */
            const double scale = m == 0 && k == 0 ? 1 : sqrt(2);
            if (m > 0)
                put(to, l, -m, k, scale * p * sum_s);
            if (k > 0)
                put(to, l, m, -k, scale * p * -sum_s);
            put(to, l, m, k, scale * p * sum_c);
        } else {
            put(to, l, m, k, p * sum_c + s * difference_c);
            put(to, l, m, -k, s * difference_s - p * sum_s);
            put(to, l, -m, k, p * sum_s + s * difference_s);
            put(to, l, -m, -k, p * sum_c - s * difference_c);
        }
    }
}

/* Computes all entries; d_km = (-1)^(m-k) d_mk and d_k,-m = d_m,-k, so each is computed once. */
static void rotation_of(int bands, const double rotation[4], const entries_to *to) {
    assert(lmpi_is_bands(bands));
    euler angles;
    double plus[LMP_BANDS_MAX], minus[LMP_BANDS_MAX];
    euler_prepare(&angles, bands, rotation);
    for (int m = 0; m < bands; m++) {
        double root = 1; /* square root of the binomial of 2m over m+k */
        for (int k = m; k >= 0; k--) {
            const double sign_m = m % 2 ? -1 : 1, sign_k = k % 2 ? -1 : 1;
            wigner(&angles, bands, m, k, root, plus, minus);
            fill(&angles, bands, m, k, (double[]) { 1, sign_k }, plus, minus, to);
            if (k < m)
                fill(&angles, bands, k, m, (double[]) { sign_m * sign_k, sign_m }, plus, minus, to);
            root *= sqrt((double)(m + k) / (m - k + 1));
        }
    }
}

void lmp_sh_make_rotation(int bands, lmp_quat rotation, float *matrices) {
    const double q[4] = { (double)rotation.x, (double)rotation.y, (double)rotation.z,
                          (double)rotation.w };
    rotation_of(bands, q, &(entries_to) { .floats = matrices });
}

void lmp_sh_make_rotation_double(int bands, const double rotation[4], double *matrices) {
    rotation_of(bands, rotation, &(entries_to) { .doubles = matrices });
}

/* Rotates coefficients of either type: each band's block times that band's coefficients. */
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
    assert(lmpi_is_bands(bands));
    assert(lmpi_are_apart(sh, LMP_SH_COUNT(bands), rotated, LMP_SH_COUNT(bands)));
    assert(lmpi_are_apart(matrices, LMP_SH_ROTATION_COUNT(bands), rotated, LMP_SH_COUNT(bands)));
    ROTATE(float)
}

void lmp_sh_rotate_double(int bands, const double *matrices, const double *sh, double *rotated) {
    const size_t size = LMP_SH_COUNT(bands) * sizeof *sh;
    assert(lmpi_is_bands(bands) && lmpi_are_bytes_apart(sh, size, rotated, size));
    assert(lmpi_are_bytes_apart(matrices, LMP_SH_ROTATION_COUNT(bands) * sizeof *matrices, rotated,
                                size));
    (void)size;
    ROTATE(double)
}

/* Returns the unit quaternion of a matrix, from its largest component so that nothing cancels. */
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

void lmp_sh_make_rotation_from_matrix(int bands, const float rotation[9], float *matrices) {
    assert(lmpi_is_rotation(rotation));
    lmp_sh_make_rotation(bands, quaternion_of(rotation), matrices);
}

/* Rotates more bands than there is straight-line code for, by euler.h. */
static void rotate_by_angles(int bands, const float rotation[9], const float *sh, float *rotated) {
    float other[LMP_SH_COUNT(LMPI_EULER_BANDS)];
    lmpi_euler parts;
    lmpi_euler_angles angles;
    lmpi_euler_of(rotation, &parts);
    lmpi_euler_angles_of(bands, &parts, &angles);
    LMPI_EULER_Z(float, bands, &angles.first, sh, other)
    LMPI_EULER_QUARTER(float, bands, other, rotated)
    LMPI_EULER_Z(float, bands, &angles.middle, rotated, rotated)
    LMPI_EULER_QUARTER(float, bands, rotated, other)
    /* X^-1 is X times a half turn around x, which only changes signs. */
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++)
            if ((m < 0) != ((l + m) % 2 != 0))
                other[LMP_SH_INDEX(l, m)] = -other[LMP_SH_INDEX(l, m)];
    LMPI_EULER_Z(float, bands, &angles.last, other, rotated)
}

static LMPI_NOINLINE void rotate_any(int bands, const float rotation[9], const float *sh,
                                     float *rotated) {
    if (bands <= LMPI_SINGLE_BANDS)
        lmpi_single_get()->rotate[bands](bands, rotation, sh, rotated);
    else if (bands <= LMPI_EULER_BANDS)
        rotate_by_angles(bands, rotation, sh, rotated);
    else {
        const lmp_quat q = quaternion_of(rotation);
        memset(rotated, 0, LMP_SH_COUNT(bands) * sizeof *rotated);
        rotation_of(bands, (double[]) { (double)q.x, (double)q.y, (double)q.z, (double)q.w },
                    &(entries_to) { .sh = sh, .rotated = rotated });
    }
}

void lmp_sh_rotate_by_matrix(int bands, const float rotation[9], const float *sh, float *rotated) {
    assert(lmpi_is_bands(bands) && lmpi_is_rotation(rotation));
    assert(lmpi_are_apart(sh, LMP_SH_COUNT(bands), rotated, LMP_SH_COUNT(bands)));
    const lmpi_kernels *kernels = lmpi_single_for(bands);
    (kernels ? kernels->single->rotate[bands] : rotate_any)(bands, rotation, sh, rotated);
}

static LMPI_NOINLINE void rotate_z_any(int bands, float angle, const float *sh, float *rotated) {
    if (bands <= LMPI_SINGLE_BANDS && fabsf(angle) <= LMPI_SINGLE_ANGLE_MAX) {
        lmpi_single_get()->rotate_z[bands](bands, angle, sh, rotated);
        return;
    }
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

void lmp_sh_rotate_z(int bands, float angle, const float *sh, float *rotated) {
    assert(lmpi_is_bands(bands));
    assert(isfinite(angle) && lmpi_are_same_or_apart(sh, rotated, LMP_SH_COUNT(bands)));
    const lmpi_kernels *kernels = lmpi_single_for(bands);
    (kernels && fabsf(angle) <= LMPI_SINGLE_ANGLE_MAX ? kernels->single->rotate_z[bands]
                                                      : rotate_z_any)(bands, angle, sh, rotated);
}
