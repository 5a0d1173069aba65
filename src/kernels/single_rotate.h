/* SPDX-License-Identifier: MIT */
/* single_rotate.h - one vector of few bands by a matrix. Band 1 is a vector and, where nothing is
 * above it, band 2 a symmetric matrix without trace; else bands take R = Rz(last) X^-1 Rz(middle) X
 * Rz(first), X a quarter turn around x whose matrices are three quarters 0 (euler.h). */
#ifndef LAMPION_KERNELS_SINGLE_ROTATE_H
#define LAMPION_KERNELS_SINGLE_ROTATE_H

#include "src/base/tables.h"
#include "src/kernels/lanes.h"
#include "src/kernels/single.h"

#include <math.h>

/* Y_1 = (-y, z, -x). */
LMP_INLINE void rotate_vector(const float r[9], const float *in, float *out) {
    out[0] = r[3] * in[2] + r[4] * in[0] - r[5] * in[1];
    out[1] = r[8] * in[1] - r[6] * in[2] - r[7] * in[0];
    out[2] = r[0] * in[2] + r[1] * in[0] - r[2] * in[1];
}

/* w^T S w is the function of band 2, up to a factor; S turns into R S R^T. */
LMP_INLINE void rotate_symmetric(const float r[9], const float *in, float *out) {
    const float third = 0.577350269f * in[2], half = 0.866025404f;
    const float s[9] = { in[4] - third, in[0],  -in[3], in[0],    -in[4] - third,
                         -in[1],        -in[3], -in[1], 2 * third };
    float t[9];
    LMP_UNROLL for (int i = 0; i < 3; i++) LMP_UNROLL for (int k = 0; k < 3; k++) t[3 * i + k] =
        r[3 * i] * s[k] + r[3 * i + 1] * s[3 + k] + r[3 * i + 2] * s[6 + k];
    const float xx = t[0] * r[0] + t[1] * r[1] + t[2] * r[2];
    const float yy = t[3] * r[3] + t[4] * r[4] + t[5] * r[5];
    out[0] = t[0] * r[3] + t[1] * r[4] + t[2] * r[5];
    out[1] = -(t[3] * r[6] + t[4] * r[7] + t[5] * r[8]);
    out[2] = half * (t[6] * r[6] + t[7] * r[7] + t[8] * r[8]);
    out[3] = -(t[0] * r[6] + t[1] * r[7] + t[2] * r[8]);
    out[4] = (xx - yy) / 2;
}

typedef float single_three __attribute__((vector_size(16))); /* first, middle, last, nothing */

/* Cosines and sines of m times the angles. */
typedef struct single_angles {
    single_three c[LMP_SINGLE_BANDS], s[LMP_SINGLE_BANDS];
} single_angles;

LMP_INLINE void single_per_root(const single_three *of, single_three *per) {
#if LMP_LANES > 1 && defined(__SSE2__)
    *per = (single_three)_mm_div_ps(_mm_set1_ps(1), _mm_sqrt_ps((__m128)*of));
#else
    for (int i = 0; i < 4; i++)
        (*per)[i] = 1 / sqrtf((*of)[i]);
#endif
}

/* As lmp_euler_of, in float and without a branch. An angle that is so small that its square would
 * not keep its digits is none. */
LMP_INLINE void single_euler(const float r[9], single_angles *angles) {
    const float sign = r[8] < 0 ? -1.f : 1.f;
    const float both_c = r[4] + sign * r[0], both_s = r[3] - sign * r[1];
    const float across2 = r[2] * r[2] + r[5] * r[5];
    const float x = across2 < 1e-30f ? 1 : r[2], y = across2 < 1e-30f ? 0 : r[5];
    const float a2 = across2 < 1e-30f ? 0 : across2, h2 = across2 < 1e-30f ? 1 : across2;
    const single_three of = { both_c * both_c + both_s * both_s, h2, a2 + r[8] * r[8], 1 };
    single_three per;
    single_per_root(&of, &per);
    const float c = x * per[1], s = y * per[1], sum_c = both_c * per[0], sum_s = both_s * per[0];
    angles->c[1] = (single_three) { sum_c * c + sign * (sum_s * s), r[8] * per[2], c, 1 };
    angles->s[1] = (single_three) { sum_s * c - sign * (sum_c * s), a2 * per[1] * per[2], s, 0 };
}

/* i and k make i + k. */
LMP_INLINE void single_add_angles(single_angles *angles, int i, int k) {
    const single_three ci = angles->c[i], si = angles->s[i], ck = angles->c[k], sk = angles->s[k];
    angles->c[i + k] = ci * ck - si * sk;
    angles->s[i + k] = ci * sk + si * ck;
}
LMP_INLINE void single_multiples(int bands, single_angles *angles) {
    single_add_angles(angles, 1, 1);
    single_add_angles(angles, 1, 2);
    if (bands > 4)
        single_add_angles(angles, 2, 2);
    if (bands > 5)
        single_add_angles(angles, 1, 4);
}

#ifdef __AVX512F__
#include "src/kernels/single_rotate_lanes.h"
#else

LMP_INLINE void single_z(int l, const single_angles *angles, int which, const float *in,
                         float *out) {
    out[0] = in[0];
    LMP_UNROLL for (int m = 1; m <= l; m++) {
        const float c = angles->c[m][which], s = angles->s[m][which];
        const float plus = in[m], minus = in[-m];
        out[m] = c * plus - s * minus;
        out[-m] = s * plus + c * minus;
    }
}

/* The last one, after X^-1 = X S: S, a half turn around x, is but signs, and takes the angle to its
 * opposite. */
LMP_INLINE void single_last(int l, const single_angles *angles, const float *in, float *out) {
    out[0] = l % 2 ? -in[0] : in[0];
    LMP_UNROLL for (int m = 1; m <= l; m++) {
        const float c = (l + m) % 2 ? -angles->c[m][2] : angles->c[m][2];
        const float s = (l + m) % 2 ? -angles->s[m][2] : angles->s[m][2];
        out[m] = c * in[m] + s * in[-m];
        out[-m] = s * in[m] - c * in[-m];
    }
}

LMP_INLINE void single_quarter(int l, const float *table, const float *in, float *out) {
    LMP_UNROLL for (int m = -l; m <= l; m++) {
        const int first = lmp_table_quarter_first(l, m), count = lmp_table_quarter_count(l, m);
        float sum = *table++ * in[first];
        LMP_UNROLL for (int k = 1; k < count; k++) sum += *table++ * in[first + 2 * k];
        out[m] = sum;
    }
}

LMP_INLINE void single_rotate_bands(int bands, const single_angles *angles, const float *sh,
                                    float *rotated) {
    const float *table = lmp_table_quarter + 4; /* after bands 0 and 1 */
    LMP_UNROLL for (int l = 2; l < bands; l++) {
        float one[2 * LMP_SINGLE_BANDS], other[2 * LMP_SINGLE_BANDS];
        single_z(l, angles, 0, sh + l * (l + 1), one + l);
        single_quarter(l, table, one + l, other + l);
        single_z(l, angles, 1, other + l, other + l);
        single_quarter(l, table, other + l, one + l);
        single_last(l, angles, one + l, rotated + l * (l + 1));
        table += (2 * l + 1) * (2 * l + 1) / 4 + 1;
    }
}
#endif

LMP_INLINE void straight_rotate(int bands, const float r[9], const float *sh, float *rotated) {
    rotated[0] = sh[0];
    if (bands > 1)
        rotate_vector(r, sh + 1, rotated + 1);
    if (bands == 3)
        rotate_symmetric(r, sh + 4, rotated + 4);
    if (bands <= 3)
        return;
    single_angles angles;
    single_euler(r, &angles);
    single_multiples(bands, &angles);
    single_rotate_bands(bands, &angles, sh, rotated);
}

#endif
