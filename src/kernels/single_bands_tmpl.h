/* SPDX-License-Identifier: MIT */
/* single_bands_tmpl.h - rotates bands 2 and up of one vector by three angles, one number at a time;
 * single_rotate_lanes_tmpl.h does a band at once. */
#ifndef LAMPION_KERNELS_SINGLE_BANDS_TMPL_H
#define LAMPION_KERNELS_SINGLE_BANDS_TMPL_H

#include "src/base/tables.h"
#include "src/kernels/single_angles_tmpl.h"

LMPI_INLINE void single_z(int l, const single_angles *angles, int which, const float *in,
                          float *out) {
    out[0] = in[0];
    LMPI_UNROLL for (int m = 1; m <= l; m++) {
        const float c = angles->c[m][which], s = angles->s[m][which];
        const float plus = in[m], minus = in[-m];
        out[m] = c * plus - s * minus;
        out[-m] = s * plus + c * minus;
    }
}

/* Rotates by the last angle, after X^-1 = X S: the half turn S around x only changes signs, and
 * reverses the angle. */
LMPI_INLINE void single_last(int l, const single_angles *angles, const float *in, float *out) {
    out[0] = l % 2 ? -in[0] : in[0];
    LMPI_UNROLL for (int m = 1; m <= l; m++) {
        const float c = (l + m) % 2 ? -angles->c[m][2] : angles->c[m][2];
        const float s = (l + m) % 2 ? -angles->s[m][2] : angles->s[m][2];
        out[m] = c * in[m] + s * in[-m];
        out[-m] = s * in[m] - c * in[-m];
    }
}

LMPI_INLINE void single_quarter(int l, const float *table, const float *in, float *out) {
    LMPI_UNROLL for (int m = -l; m <= l; m++) {
        const int first = lmpi_table_quarter_first(l, m), count = lmpi_table_quarter_count(l, m);
        float sum = *table++ * in[first];
        LMPI_UNROLL for (int k = 1; k < count; k++) sum += *table++ * in[first + 2 * k];
        out[m] = sum;
    }
}

LMPI_INLINE void single_rotate_bands(int bands, const single_angles *angles, const float *sh,
                                     float *rotated) {
    const float *table = lmpi_table_quarter + 4; /* past bands 0 and 1 */
    LMPI_UNROLL for (int l = 2; l < bands; l++) {
        float one[2 * LMPI_SINGLE_BANDS], other[2 * LMPI_SINGLE_BANDS];
        single_z(l, angles, 0, sh + l * (l + 1), one + l);
        single_quarter(l, table, one + l, other + l);
        single_z(l, angles, 1, other + l, other + l);
        single_quarter(l, table, other + l, one + l);
        single_last(l, angles, one + l, rotated + l * (l + 1));
        table += (2 * l + 1) * (2 * l + 1) / 4 + 1;
    }
}

#endif
