/* SPDX-License-Identifier: MIT */
/* single_rotate_tmpl.h - rotates one vector of few bands by a matrix. Band 1 is a vector and, where
 * nothing is above it, band 2 a symmetric matrix without trace; else bands take R = Rz(last) X^-1
 * Rz(middle) X Rz(first), X a quarter turn around x whose matrices are three quarters 0 (euler.h):
 * single_rotate_bands, which the build chooses. */
#ifndef LAMPION_KERNELS_SINGLE_ROTATE_TMPL_H
#define LAMPION_KERNELS_SINGLE_ROTATE_TMPL_H

#include "src/kernels/single_angles_tmpl.h"

/* Rotates band 1, Y_1 = (-y, z, -x), as a vector. */
LMPI_INLINE void rotate_vector(const float r[9], const float *in, float *out) {
    out[0] = r[3] * in[2] + r[4] * in[0] - r[5] * in[1];
    out[1] = r[8] * in[1] - r[6] * in[2] - r[7] * in[0];
    out[2] = r[0] * in[2] + r[1] * in[0] - r[2] * in[1];
}

/* Rotates band 2 as a symmetric matrix: w^T S w is its function up to a factor, and S becomes R S
 * R^T. */
LMPI_INLINE void rotate_symmetric(const float r[9], const float *in, float *out) {
    const float third = 0.577350269f * in[2], half_root3 = 0.866025404f;
    const float s[9] = { in[4] - third, in[0],  -in[3], in[0],    -in[4] - third,
                         -in[1],        -in[3], -in[1], 2 * third };
    float t[9];
    LMPI_UNROLL for (int i = 0; i < 3; i++) LMPI_UNROLL for (int k = 0; k < 3; k++) t[3 * i + k] =
        r[3 * i] * s[k] + r[3 * i + 1] * s[3 + k] + r[3 * i + 2] * s[6 + k];
    const float xx = t[0] * r[0] + t[1] * r[1] + t[2] * r[2];
    const float yy = t[3] * r[3] + t[4] * r[4] + t[5] * r[5];
    out[0] = t[0] * r[3] + t[1] * r[4] + t[2] * r[5];
    out[1] = -(t[3] * r[6] + t[4] * r[7] + t[5] * r[8]);
    out[2] = half_root3 * (t[6] * r[6] + t[7] * r[7] + t[8] * r[8]);
    out[3] = -(t[0] * r[6] + t[1] * r[7] + t[2] * r[8]);
    out[4] = (xx - yy) / 2;
}

LMPI_INLINE void straight_rotate(int bands, const float r[9], const float *sh, float *rotated) {
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
