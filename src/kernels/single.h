/* SPDX-License-Identifier: MIT */
/* single.h - functions of one element per call, for engines and tools that have only one:
 * straight-line code of few bands, one function per number of bands. Like the kernels they are
 * built for every instruction set, with the same bits. */
#ifndef LAMPION_KERNELS_SINGLE_H
#define LAMPION_KERNELS_SINGLE_H

#include <lampion/base.h>

#define LMPI_SINGLE_BANDS     6
#define LMPI_SINGLE_ANGLE_MAX 1e6f

/* A cap's coefficients: factors[l] Y_lm(axis). */
typedef struct lmpi_single_cap {
    lmp_vec3 axis;
    float factors[LMPI_SINGLE_BANDS];
} lmpi_single_cap;

/* Functions by the number of bands; there is none for 0. bands is also the first argument where it
 * is that of a public function, so that the public function can pass its arguments on unchanged. */
typedef struct lmpi_single {
    void (*eval[LMPI_SINGLE_BANDS + 1])(int bands, lmp_vec3 direction, float *sh);
    float (*dot[LMPI_SINGLE_BANDS + 1])(int bands, const float *a, const float *b);
    /* from 5 bands on */
    void (*combine[LMPI_SINGLE_BANDS + 1])(int bands, float s, const float *a, float t,
                                           const float *b, float *sh);
    void (*multiply[LMPI_SINGLE_BANDS + 1])(int bands, const float *a, const float *b, float *c);
    void (*rotate[LMPI_SINGLE_BANDS + 1])(int bands, const float rotation[9], const float *sh,
                                          float *rotated);
    /* |angle| is at most LMPI_SINGLE_ANGLE_MAX; rotated may be sh. */
    void (*rotate_z[LMPI_SINGLE_BANDS + 1])(int bands, float angle, const float *sh,
                                            float *rotated);
    void (*cap[LMPI_SINGLE_BANDS + 1])(const lmpi_single_cap *cap, float *sh);
    /* Computes strength times a cap, in planes of red, green and blue; `ambient` is added to
     * coefficient 0. */
    void (*colors[LMPI_SINGLE_BANDS + 1])(const lmpi_single_cap *cap, lmp_rgb strength,
                                          lmp_rgb ambient, float *const planes[3]);
    /* Computes strength times Y_lm(axis), in planes of red, green and blue. */
    void (*sun[LMPI_SINGLE_BANDS + 1])(lmp_vec3 axis, lmp_rgb strength, float *red, float *green,
                                       float *blue);
} lmpi_single;

extern const lmpi_single lmpi_single_scalar, lmpi_single_vector, lmpi_single_avx2,
    lmpi_single_avx512;

#endif
