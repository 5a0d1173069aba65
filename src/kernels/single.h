/* SPDX-License-Identifier: MIT */
/* single.h - one element a call, for engines and tools that have but one: straight-line code of few
 * bands, a function a number of them. As the kernels built for every instruction set, with the same
 * bits. */
#ifndef LAMPION_KERNELS_SINGLE_H
#define LAMPION_KERNELS_SINGLE_H

#include "src/kernels/kernels.h"

#define LMP_SINGLE_BANDS 6

/* What a cap is made of: factors[l] Y_lm(axis). */
typedef struct lmp_single_cap {
    lmp_vec3 axis;
    float factors[LMP_SINGLE_BANDS];
} lmp_single_cap;

/* By the number of bands; of 0 there is none. */
typedef struct lmp_single {
    void (*eval[LMP_SINGLE_BANDS + 1])(lmp_vec3 direction, float *sh);
    float (*dot[LMP_SINGLE_BANDS + 1])(const float *a, const float *b);
    void (*combine[LMP_SINGLE_BANDS + 1])(float s, const float *a, float t, const float *b,
                                          float *sh);
    void (*rotate[LMP_SINGLE_BANDS + 1])(const float rotation[9], const float *sh, float *rotated);
    /* strength times a cap, planes of red, green and blue; `ambient` is added to coefficient 0. */
    void (*colors[LMP_SINGLE_BANDS + 1])(const lmp_single_cap *cap, lmp_rgb strength,
                                         lmp_rgb ambient, float *const planes[3]);
} lmp_single;

extern const lmp_single lmp_single_scalar, lmp_single_vector, lmp_single_avx2, lmp_single_avx512;

static inline const lmp_single *lmp_single_get(void) {
    return lmp_kernels_get()->single;
}

#endif
