/* SPDX-License-Identifier: MIT */
/* lobe_eval.h - reads a preintegrated lobe: finds once per surface where its exponent lies, then
 * reads once per light. */
#ifndef LAMPION_PREINTEGRATED_LOBE_EVAL_H
#define LAMPION_PREINTEGRATED_LOBE_EVAL_H

#include <lampion/preintegrated.h>

/* Where an exponent lies in a preintegrated lobe. */
typedef struct lmpi_preintegrated_lobe_position {
    uint32_t first, columns; /* of the cell; first counts pairs */
    float fraction;          /* weight of the second slice */
    float density;           /* 1/step */
    float lobe_angle;        /* sr */
} lmpi_preintegrated_lobe_position;

void lmpi_preintegrated_lobe_lookup(const lmp_preintegrated_lobe_info *info, float exponent,
                                    lmpi_preintegrated_lobe_position *position);

/* Does lmp_preintegrated_lobe_eval at a position; cosine is in -1 … 1. */
float lmpi_preintegrated_lobe_at(const lmp_preintegrated_lobe_info *info,
                                 const lmpi_preintegrated_lobe_position *position,
                                 float one_minus_cos, float cosine);

#endif
