/* SPDX-License-Identifier: MIT */
/* single_angles_tmpl.h - the three angles of a matrix, R = Rz(last) X^-1 Rz(middle) X Rz(first),
 * side by side, for rotations of few bands (euler.h). */
#ifndef LAMPION_KERNELS_SINGLE_ANGLES_TMPL_H
#define LAMPION_KERNELS_SINGLE_ANGLES_TMPL_H

#include "src/kernels/lanes.h"
#include "src/kernels/single.h"

typedef vf4 single_three; /* first, middle, last, nothing */

/* Cosines and sines of m times the angles. */
typedef struct single_angles {
    single_three c[LMPI_SINGLE_BANDS], s[LMPI_SINGLE_BANDS];
} single_angles;

/* Does lmpi_euler_of in float and without branches. An angle so small that its square would lose
 * digits counts as 0. */
LMPI_INLINE void single_euler(const float r[9], single_angles *angles) {
    const float sign = r[8] < 0 ? -1.f : 1.f;
    const float both_c = r[4] + sign * r[0], both_s = r[3] - sign * r[1];
    const float across2 = r[2] * r[2] + r[5] * r[5];
    const float x = across2 < 1e-30f ? 1 : r[2], y = across2 < 1e-30f ? 0 : r[5];
    const float a2 = across2 < 1e-30f ? 0 : across2, h2 = across2 < 1e-30f ? 1 : across2;
    const single_three of = { both_c * both_c + both_s * both_s, h2, a2 + r[8] * r[8], 1 };
    single_three per;
    vf4_per_root(&of, &per);
    const float c = x * per[1], s = y * per[1], sum_c = both_c * per[0], sum_s = both_s * per[0];
    angles->c[1] = (single_three) { sum_c * c + sign * (sum_s * s), r[8] * per[2], c, 1 };
    angles->s[1] = (single_three) { sum_s * c - sign * (sum_c * s), a2 * per[1] * per[2], s, 0 };
}

/* Computes i + k times the angles from i and from k times the angles. */
LMPI_INLINE void single_add_angles(single_angles *angles, int i, int k) {
    const single_three ci = angles->c[i], si = angles->s[i], ck = angles->c[k], sk = angles->s[k];
    angles->c[i + k] = ci * ck - si * sk;
    angles->s[i + k] = ci * sk + si * ck;
}
LMPI_INLINE void single_multiples(int bands, single_angles *angles) {
    single_add_angles(angles, 1, 1);
    single_add_angles(angles, 1, 2);
    if (bands > 4)
        single_add_angles(angles, 2, 2);
    if (bands > 5)
        single_add_angles(angles, 1, 4);
}

#endif
