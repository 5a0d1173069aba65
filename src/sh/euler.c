/* SPDX-License-Identifier: MIT */
#include "src/sh/euler.h"

#include <math.h>

/* Makes x + iy a unit, 1 where it is 0; returns its length. */
static double unit_of(double x, double y, double unit[2]) {
    const double length = sqrt(x * x + y * y);
    unit[0] = length > 0 ? x / length : 1;
    unit[1] = length > 0 ? y / length : 0;
    return length;
}

/* Where the middle angle is small, what the matrix says of the two others is noise, but not what it
 * says of their sum; where it is near a half turn, of their difference. One of them is taken from
 * the matrix, the other from there. */
lmp_euler lmp_euler_of(const double r[9]) {
    const bool up = r[8] >= 0;
    lmp_euler euler;
    double both[2];
    unit_of(up ? r[0] + r[4] : r[4] - r[0], up ? r[3] - r[1] : -(r[3] + r[1]), both);
    const double across = unit_of(r[2], r[5], euler.last);
    unit_of(r[8], across, euler.middle);
    const double *a = euler.last;
    euler.first[0] = both[0] * a[0] + both[1] * a[1];
    euler.first[1] = up ? both[1] * a[0] - both[0] * a[1] : both[0] * a[1] - both[1] * a[0];
    return euler;
}

static void multiples(int bands, const double unit[2], lmp_euler_angle *angle) {
    double c = 1, s = 0;
    for (int m = 0; m < bands; m++) {
        const double next = c * unit[0] - s * unit[1];
        angle->c[m] = (float)c;
        angle->s[m] = (float)s;
        s = c * unit[1] + s * unit[0];
        c = next;
    }
}

void lmp_euler_angles_of(int bands, const lmp_euler *euler, lmp_euler_angles *angles) {
    multiples(bands, euler->first, &angles->first);
    multiples(bands, euler->middle, &angles->middle);
    multiples(bands, euler->last, &angles->last);
}
