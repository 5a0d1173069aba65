/* SPDX-License-Identifier: MIT */
/* lobe_eval.h - reading a preintegrated lobe: once a surface where its exponent lies, then once a
 * light. */
#ifndef LAMPION_PREINTEGRATED_LOBE_EVAL_H
#define LAMPION_PREINTEGRATED_LOBE_EVAL_H

#include "src/kernels/angle.h"

#include <lampion/preintegrated.h>

#include <math.h>
#include <string.h>

#define LMP_PREINTEGRATED_PI               3.14159265358979323846
#define LMP_PREINTEGRATED_LOBE_REMAP_SHIFT 19 /* of 23 bits of mantissa: 16 entries an octave */

/* Where an exponent lies. */
typedef struct lmp_preintegrated_lobe_position {
    uint32_t first, columns; /* of the cell, in pairs */
    float fraction;          /* of the second slice */
    float density;           /* 1/step */
    float lobe_angle;        /* sr */
} lmp_preintegrated_lobe_position;

void lmp_preintegrated_lobe_lookup(const lmp_preintegrated_lobe_info *info, float exponent,
                                   lmp_preintegrated_lobe_position *position);

/* lmp_preintegrated_lobe_eval at a position; cosine in -1 … 1. */
float lmp_preintegrated_lobe_at(const lmp_preintegrated_lobe_info *info,
                                const lmp_preintegrated_lobe_position *position,
                                float one_minus_cos, float cosine);

/* 1/step of a cell's grid at an exponent. */
float lmp_preintegrated_lobe_density(const lmp_preintegrated_lobe_cell *cell, float exponent);

/* The lobe's own solid angle, by which values are scaled. */
float lmp_preintegrated_lobe_solid_angle(const lmp_preintegrated_lobe_info *info, float exponent);

/* acos(1 - y), y in 0 … 1. */
static inline float lmp_preintegrated_lobe_angle(float y) {
    return sqrtf(y) * LMP_ANGLE(1 - y);
}

#endif
