/* SPDX-License-Identifier: MIT */
/* eval.h - reading a response: once a surface where its exponent lies, then once a light. */
#ifndef LAMPION_RESPONSE_EVAL_H
#define LAMPION_RESPONSE_EVAL_H

#include "src/kernels/angle.h"

#include <lampion/response.h>

#include <math.h>
#include <string.h>

#define LMP_RESPONSE_PI         3.14159265358979323846
#define LMP_RESPONSE_WARP_SHIFT 19 /* of 23 bits of mantissa: 16 entries an octave */

/* Where an exponent lies. */
typedef struct lmp_response_place {
    uint32_t first, columns; /* of the cell, in pairs */
    float share;             /* of the second slice */
    float density;           /* 1/step */
    float lobe_angle;        /* sr */
} lmp_response_place;

void lmp_response_seek(const lmp_response_info *info, float exponent, lmp_response_place *place);

/* lmp_response_eval at a place; cosine in -1 … 1. */
float lmp_response_at(const lmp_response_info *info, const lmp_response_place *place,
                      float one_minus, float cosine);

/* 1/step of a cell's grid at an exponent. */
float lmp_response_density(const lmp_response_cell *cell, float exponent);

/* The lobe's own solid angle, by which values are scaled. */
float lmp_response_lobe_angle(const lmp_response_info *info, float exponent);

/* acos(1 - y), y in 0 … 1. */
static inline float lmp_response_angle(float y) {
    return sqrtf(y) * LMP_ANGLE(1 - y);
}

#endif
