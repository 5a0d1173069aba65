/* SPDX-License-Identifier: MIT */
/* sheen.h - fibers over a surface, exactly: KHR_materials_sheen (Conty Estevez and Kulla, 2017),
 * divided by the larger of the gains toward light and view, so that nothing reflects more than
 * arrives. What lies under them has 1 - max(color) E of its light, E their albedo for the view,
 * from a table of this file's own. */
#ifndef LAMPION_REFERENCE_SHEEN_H
#define LAMPION_REFERENCE_SHEEN_H

#include "app/reference/vector.h"

#define REFERENCE_SHEEN_ROUGHNESSES 32
#define REFERENCE_SHEEN_COSINES     128

/* By the logarithm of the roughness, REFERENCE_SHEEN_ROUGHNESS_MIN … 1, and by the root of the
 * view's cosine. */
#define REFERENCE_SHEEN_ROUGHNESS_MIN 0.07
typedef struct reference_sheen_albedos {
    double at[REFERENCE_SHEEN_ROUGHNESSES][REFERENCE_SHEEN_COSINES]; /* E */
    double gain[REFERENCE_SHEEN_ROUGHNESSES]
               [REFERENCE_SHEEN_COSINES]; /* below 1 it does not count */
} reference_sheen_albedos;

/* The formulas' albedo between two cosines of the table is larger than it has by less. */
#define REFERENCE_SHEEN_MARGIN 1.003

/* Takes a second. */
void reference_sheen_albedos_fill(reference_sheen_albedos *albedos);

/* `albedos` is borrowed. */
typedef struct reference_sheen {
    const reference_sheen_albedos *albedos;
    double color[3], roughness, gain; /* toward the view */
    double under;                     /* the part of the light that they leave */
    reference_vec normal, view;
} reference_sheen;

/* normal and view must be unit; roughness is held to its range. */
void reference_sheen_set(reference_sheen *sheen, const reference_sheen_albedos *albedos,
                         const double color[3], double roughness, reference_vec normal,
                         reference_vec view);

/* f_r cos(theta) of light from w. */
void reference_sheen_at(const reference_sheen *sheen, reference_vec w, double rgb[3]);

#endif
