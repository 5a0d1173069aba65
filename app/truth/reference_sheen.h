/* SPDX-License-Identifier: MIT */
/* reference_sheen.h - a sheen over a surface, exactly: KHR_materials_sheen (Conty Estevez and
 * Kulla, 2017), divided by the larger of the gains toward light and view, so that it reflects no
 * more than arrives. The layers below it get the fraction 1 - max(color) E of the light, where E is
 * the sheen's albedo for the view, from a table that is computed here. */
#ifndef LAMPION_TRUTH_REFERENCE_SHEEN_H
#define LAMPION_TRUTH_REFERENCE_SHEEN_H

#include "app/truth/reference_vector.h"

#define REFERENCE_SHEEN_ROUGHNESSES 32
#define REFERENCE_SHEEN_COSINES     128

/* The table's range of roughness, REFERENCE_SHEEN_ROUGHNESS_MIN … 1, in logarithmic steps; columns
 * are linear in the root of the view's cosine. */
#define REFERENCE_SHEEN_ROUGHNESS_MIN 0.07
typedef struct reference_sheen_albedos {
    double at[REFERENCE_SHEEN_ROUGHNESSES][REFERENCE_SHEEN_COSINES];   /* E */
    double gain[REFERENCE_SHEEN_ROUGHNESSES][REFERENCE_SHEEN_COSINES]; /* no effect below 1 */
} reference_sheen_albedos;

/* A margin on the gain: between two cosines of the table, the formulas' albedo exceeds the
 * interpolated one by less. */
#define REFERENCE_SHEEN_MARGIN 1.003

/* Fills the tables, which takes a second. */
void reference_sheen_albedos_fill(reference_sheen_albedos *albedos);

/* A sheen at a surface point; `albedos` is not owned. */
typedef struct reference_sheen {
    const reference_sheen_albedos *albedos;
    double color[3], roughness, gain; /* gain: toward the view */
    double under;                     /* fraction of the light that the sheen transmits */
    reference_vec normal, view;
} reference_sheen;

/* Prepares a sheen; normal and view must be unit, roughness is clamped to its range. */
void reference_sheen_set(reference_sheen *sheen, const reference_sheen_albedos *albedos,
                         const double color[3], double roughness, reference_vec normal,
                         reference_vec view);

/* Evaluates f_r cos(theta) for light from w. */
void reference_sheen_at(const reference_sheen *sheen, reference_vec w, double rgb[3]);

#endif
