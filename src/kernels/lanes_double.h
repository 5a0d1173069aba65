/* SPDX-License-Identifier: MIT */
/* lanes_double.h - LMPI_DOUBLES doubles as one value, vd, of the width of a register, for what
 * float32 would round too coarsely; as many floats are a vh. With four lanes and more these are
 * half as many as the floats of a register. lanes.h has the types. */
#ifndef LAMPION_KERNELS_LANES_DOUBLE_H
#define LAMPION_KERNELS_LANES_DOUBLE_H

/* Returns s in every lane. */
LMPI_INLINE vd vd_set(double s) {
    const vd zero = { 0 };
    return s - zero;
}

/* Load floats, and store as floats. */
LMPI_INLINE vd vd_load(const float *from) {
    vh x;
    memcpy(&x, from, sizeof x);
    return vd_from(x);
}
LMPI_INLINE void vd_store(float *to, vd v) {
    const vh x = vh_from(v);
    memcpy(to, &x, sizeof x);
}

LMPI_INLINE vd vd_abs(vd a) {
    return vd_max(a, -a);
}

/* Returns 1 / sqrt(a), for a from 1e-30 to 1e38; less counts as 1e-30. A step of third order makes
 * a double of the root in float, in a third of the time of a double's root and quotient. */
LMPI_INLINE vd vd_per_root(vd a) {
    const vd held = vd_max(a, vd_set(1e-30)), y = vd_from(vh_per_root(vh_from(held)));
    const vd rest = 1.0 - held * (y * y);
    return y + (y * rest) * (0.5 + 0.375 * rest);
}

LMPI_INLINE vd vd_dot(const vd a[3], const vd b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

LMPI_INLINE void vd_cross(const vd a[3], const vd b[3], vd to[3]) {
    to[0] = a[1] * b[2] - a[2] * b[1];
    to[1] = a[2] * b[0] - a[0] * b[2];
    to[2] = a[0] * b[1] - a[1] * b[0];
}

#endif
