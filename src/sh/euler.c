/* SPDX-License-Identifier: MIT */
#include "src/kernels/euler.h"

static void multiples(int bands, const double unit[2], lmpi_euler_angle *angle) {
    double c = 1, s = 0;
    for (int m = 0; m < bands; m++) {
        const double next = c * unit[0] - s * unit[1];
        angle->c[m] = (float)c;
        angle->s[m] = (float)s;
        s = c * unit[1] + s * unit[0];
        c = next;
    }
}

void lmpi_euler_angles_of(int bands, const lmpi_euler *euler, lmpi_euler_angles *angles) {
    multiples(bands, euler->first, &angles->first);
    multiples(bands, euler->middle, &angles->middle);
    multiples(bands, euler->last, &angles->last);
}
