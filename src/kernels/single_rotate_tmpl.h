/* SPDX-License-Identifier: MIT */
/* single_rotate_tmpl.h - rotates one vector of few bands by a matrix, without its angles. Band 1 is
 * a vector and, where nothing is above it, band 2 a symmetric matrix without trace. Else bands are
 * rotated by their values: 2l+1 axes w_i tell all of band l, and the rotated function has at w_i
 * the value that the given one has at R^-1 w_i. Lanes are axes, then, after a fixed matrix, the
 * coefficients of a band. */
#ifndef LAMPION_KERNELS_SINGLE_ROTATE_TMPL_H
#define LAMPION_KERNELS_SINGLE_ROTATE_TMPL_H

#include "src/base/tables_few.h"
#include "src/kernels/lanes.h"
#include "src/kernels/single.h"

typedef float single_eight __attribute__((vector_size(32)));

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

/* --- bands by their values -------------------------------------------------------------------- */

/* Values of bands at the axes: that of band l at axis i in [l][i]. Fixed matrices read them one by
 * one, which costs less from memory than from a register. */
typedef struct rotate_axes {
    float values[LMPI_SINGLE_BANDS][LMPI_TABLE_ROTATE_AXES];
} rotate_axes;

/* Defines the two halves for a type of lanes, which stand for axes or coefficients from `lane` on:
 *
 * NAME_values evaluates bands first … bands-1 of the given function at R^-1 of axes; `sh` has the
 * factors of the monic polynomials in it.
 * NAME_coefficients makes rotated coefficients of band l of the values at all axes. */
#define ROTATE_LANES(name, number)                                                                 \
    /* Multiplies by q_l^m over its factor, an even function of z or z times one. */               \
    LMPI_INLINE void name##_monic(int l, int m, const number *z, const number *z2, number *sum) {  \
        LMPI_UNROLL for (int i = 0; i < (l - m) / 2; i++) *sum *=                                  \
            *z2 - lmpi_table_rotate_squares[l][m][i];                                              \
        if ((l - m) % 2)                                                                           \
            *sum *= *z;                                                                            \
    }                                                                                              \
    LMPI_INLINE void name##_values(int first, int bands, int lane, const float r[9],               \
                                   const float *sh, rotate_axes *axes) {                           \
        number w[3], c[LMPI_SINGLE_BANDS], s[LMPI_SINGLE_BANDS];                                   \
        LMPI_UNROLL for (int k = 0; k < 3; k++)                                                    \
            memcpy(&w[k], lmpi_table_rotate_axes[k] + lane, sizeof w[k]);                          \
        c[1] = r[0] * w[0] + r[3] * w[1] + r[6] * w[2];                                            \
        s[1] = r[1] * w[0] + r[4] * w[1] + r[7] * w[2];                                            \
        const number z = r[2] * w[0] + r[5] * w[1] + r[8] * w[2], z2 = z * z;                      \
        LMPI_UNROLL for (int m = 2; m < bands; m++) {                                              \
            const int a = m / 2, b = m - a;                                                        \
            c[m] = c[a] * c[b] - s[a] * s[b];                                                      \
            s[m] = c[a] * s[b] + s[a] * c[b];                                                      \
        }                                                                                          \
        LMPI_UNROLL for (int l = first; l < bands; l++) {                                          \
            const float *of = sh + l * (l + 1);                                                    \
            number sum = of[l] * c[l] + of[-l] * s[l];                                             \
            LMPI_UNROLL for (int m = l - 1; m >= 0; m--) {                                         \
                number ring = of[m] - (number) { 0 };                                              \
                if (m > 0)                                                                         \
                    ring = of[m] * c[m] + of[-m] * s[m];                                           \
                name##_monic(l, m, &z, &z2, &ring);                                                \
                sum += ring;                                                                       \
            }                                                                                      \
            memcpy(axes->values[l] + lane, &sum, sizeof sum);                                      \
        }                                                                                          \
    }                                                                                              \
    LMPI_INLINE void name##_coefficients(int l, int lane, const rotate_axes *axes, float *band) {  \
        number sum = { 0 };                                                                        \
        LMPI_UNROLL for (int i = 0; i <= 2 * l; i++) {                                             \
            number column;                                                                         \
            memcpy(&column, lmpi_table_rotate_inverse[l - 2][i] + lane, sizeof column);            \
            column *= axes->values[l][i];                                                          \
            sum = i == 0 ? column : sum + column;                                                  \
        }                                                                                          \
        memcpy(band + lane, &sum, sizeof sum);                                                     \
    }

ROTATE_LANES(four, vf4)
ROTATE_LANES(eight, single_eight)
ROTATE_LANES(all, vf) /* of 16 lanes */

LMPI_INLINE void rotate_values(int bands, const float r[9], const float *sh, rotate_axes *axes) {
    if (LMPI_LANES == 16 && bands > 4) {
        all_values(2, bands, 0, r, sh, axes);
        return;
    }
    if (LMPI_LANES >= 8) {
        eight_values(2, bands, 0, r, sh, axes);
    } else {
        four_values(2, bands, 0, r, sh, axes);
        four_values(2, bands, 4, r, sh, axes);
    }
    if (bands > 4)
        four_values(4, bands, 8, r, sh, axes);
}

LMPI_INLINE void rotate_band(int l, const rotate_axes *axes, float band[LMPI_TABLE_ROTATE_AXES]) {
    if (LMPI_LANES == 16 && l >= 4) {
        all_coefficients(l, 0, axes, band);
        return;
    }
    if (LMPI_LANES >= 8) {
        eight_coefficients(l, 0, axes, band);
    } else {
        four_coefficients(l, 0, axes, band);
        four_coefficients(l, 4, axes, band);
    }
    if (l >= 4)
        four_coefficients(l, 8, axes, band);
}

LMPI_INLINE void rotate_bands(int bands, const float r[9], const float *sh, float *rotated) {
    float scaled[LMPI_SINGLE_BANDS * LMPI_SINGLE_BANDS];
    rotate_axes axes;
    /* The first coefficient not of a whole register is of band 0 or 1, which needs none. */
    LMPI_UNROLL for (int i = bands * bands % 8; i < bands * bands; i += 8) {
        single_eight of, norm;
        memcpy(&of, sh + i, sizeof of);
        memcpy(&norm, lmpi_table_rotate_norms + i, sizeof norm);
        of *= norm;
        memcpy(scaled + i, &of, sizeof of);
    }
    rotate_values(bands, r, scaled, &axes);
    /* What is stored past a band belongs to the next one, which is stored afterwards. */
    LMPI_UNROLL for (int l = 2; l < bands; l++) {
        const int count = l + 1 < bands ? (2 * l + 4) / 4 * 4 : 2 * l + 1;
        float band[LMPI_TABLE_ROTATE_AXES];
        rotate_band(l, &axes, band);
        memcpy(rotated + l * l, band, (size_t)count * sizeof *band);
    }
}

LMPI_INLINE void straight_rotate(int bands, const float r[9], const float *sh, float *rotated) {
    rotated[0] = sh[0];
    if (bands > 1)
        rotate_vector(r, sh + 1, rotated + 1);
    if (bands == 3)
        rotate_symmetric(r, sh + 4, rotated + 4);
    if (bands > 3)
        rotate_bands(bands, r, sh, rotated);
}

#endif
