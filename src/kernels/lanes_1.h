/* SPDX-License-Identifier: MIT */
/* lanes_1.h - one lane: plain C, which the other builds are compared with (lanes.h). */
#ifndef LAMPION_KERNELS_LANES_1_H
#define LAMPION_KERNELS_LANES_1_H

#include <math.h>

#define LMPI_OPAQUE_LANES(v)
#define LMPI_STREAMS 0

LMPI_INLINE vf vf_sqrt(vf a) {
    return sqrtf(a);
}
LMPI_INLINE vf vf_max(vf a, vf b) {
    return a > b ? a : b;
}
LMPI_INLINE vf vf_min(vf a, vf b) {
    return a < b ? a : b;
}
LMPI_INLINE int vf_any_less(vf a, vf b) {
    return a < b;
}
LMPI_INLINE vd vd_max(vd a, vd b) {
    return a > b ? a : b;
}
LMPI_INLINE int vd_any_less(vd a, vd b) {
    return a < b;
}
LMPI_INLINE vf vf_join(const vf4 *quarters) {
    return quarters[0][0];
}
LMPI_INLINE vh vh_per_root(vh a) {
    return 1 / sqrtf(a);
}
LMPI_INLINE vd vd_from(vh x) {
    return (double)x;
}
LMPI_INLINE vh vh_from(vd x) {
    return (float)x;
}

LMPI_INLINE vf vf_load_first(const float *from, int count) {
    (void)count; /* there is no such count */
    return *from;
}
LMPI_INLINE void vf_store_first(float *to, vf v, int count) {
    (void)count; /* there is no such count */
    *to = v;
}

typedef vf vf_number;
#define vf_number_of(number)    vf_set(number)
#define vf_number_lanes(number) (number)

LMPI_INLINE void half_pack(const float *from, uint16_t *to) {
    *to = lmpi_half_of_float(*from);
}
LMPI_INLINE void half_unpack(const uint16_t *from, float *to) {
    *to = lmpi_float_of_half(*from);
}

#define TEXEL_PARTS     12
#define TEXEL_LANES     1
#define TEXEL_NUMBER(i) (i)
typedef float texel_lanes;
#define TEXEL_NUMBERS (TEXEL_PARTS * TEXEL_LANES)

#include "src/kernels/lanes_any.h"

LMPI_INLINE void texel_columns(const float *weights, texel_lanes columns[TEXEL_PARTS]) {
    for (int i = 0; i < 12; i++)
        columns[i] = weights[i / 3];
}

#endif
