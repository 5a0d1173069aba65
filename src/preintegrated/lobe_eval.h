/* SPDX-License-Identifier: MIT */
/* lobe_eval.h - reading a preintegrated lobe: once a surface where its exponent lies, then once a
 * light. */
#ifndef LAMPION_PREINTEGRATED_LOBE_EVAL_H
#define LAMPION_PREINTEGRATED_LOBE_EVAL_H

#include "shaders/preintegrated_lookup.h"

#include <assert.h>
#include <lampion/preintegrated.h>

#define LMP_PREINTEGRATED_PI 3.14159265358979323846

static_assert(LMP_LOOKUP_REMAP_COUNT == LMP_PREINTEGRATED_LOBE_REMAP_COUNT &&
                  (int)LMP_LOOKUP_EXPONENT_MAX == (int)LMP_PREINTEGRATED_LOBE_EXPONENT_MAX,
              "the remap is what the API says");

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

#endif
