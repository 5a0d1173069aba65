/* SPDX-License-Identifier: MIT */
/* single_rotate_z_tmpl.h - rotates one vector of few bands around z. */
#ifndef LAMPION_KERNELS_SINGLE_ROTATE_Z_TMPL_H
#define LAMPION_KERNELS_SINGLE_ROTATE_Z_TMPL_H

#include "src/base/unroll.h"
#include "src/kernels/single.h"

#include <string.h>

/* Computes cosine and sine within 1e-9 up to LMPI_SINGLE_ANGLE_MAX, without branches: the angle
 * less whole quarter turns goes into their series. */
LMPI_INLINE void single_cosine_sine(double angle, double *cosine, double *sine) {
    static const double signs[5] = { 1, 1, -1, -1, 1 };
    const double round = 0x1.8p52; /* adding it leaves an integer in the lowest bits */
    const double shifted = angle * 0.63661977236758134 + round;
    const double x = angle - (shifted - round) * 1.57079632679489662, z = x * x;
    uint64_t quarter;
    memcpy(&quarter, &shifted, sizeof quarter);
    quarter &= 3;
    const double s =
        x +
        x * z * (-1. / 6 + z * (1. / 120 + z * (-1. / 5040 + z * (1. / 362880 - z / 39916800))));
    const double c =
        1 + z * (-1. / 2 + z * (1. / 24 + z * (-1. / 720 + z * (1. / 40320 - z * (1. / 3628800)))));
    const double both[2] = { c, s };
    *cosine = signs[quarter + 1] * both[quarter & 1];
    *sine = signs[quarter] * both[~quarter & 1];
}

LMPI_INLINE void straight_rotate_z(int bands, float angle, const float *sh, float *rotated) {
    double step_c, step_s;
    single_cosine_sine((double)angle, &step_c, &step_s);
    double wide_c = step_c, wide_s = step_s; /* of m times the angle */
    rotated[0] = sh[0];
    LMPI_UNROLL for (int l = 1; l < bands; l++) rotated[l * l + l] = sh[l * l + l];
    LMPI_UNROLL for (int m = 1; m < bands; m++) {
        const float c = (float)wide_c, s = (float)wide_s;
        LMPI_UNROLL for (int l = m; l < bands; l++) {
            const float plus = sh[l * l + l + m], minus = sh[l * l + l - m];
            rotated[l * l + l - m] = s * plus + c * minus;
            rotated[l * l + l + m] = c * plus - s * minus;
        }
        const double next_c = wide_c * step_c - wide_s * step_s;
        wide_s = wide_c * step_s + wide_s * step_c;
        wide_c = next_c;
    }
}

#endif
