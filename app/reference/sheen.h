/* SPDX-License-Identifier: MIT */
/* sheen.h - fibers over a surface, exactly: KHR_materials_sheen (Conty Estevez and Kulla, 2017).
 * What lies under them has 1 - max(color) E of its light, E their albedo for the view, from a table
 * of this file's own. */
#ifndef LAMPION_REFERENCE_SHEEN_H
#define LAMPION_REFERENCE_SHEEN_H

#include "app/reference/vector.h"

#define REFERENCE_SHEEN_NODES 32

/* E by roughness, REFERENCE_SHEEN_ROUGHNESS_MIN … 1, and by the root of the view's cosine. */
#define REFERENCE_SHEEN_ROUGHNESS_MIN 0.07
typedef struct reference_sheen_albedos {
    double at[REFERENCE_SHEEN_NODES][REFERENCE_SHEEN_NODES];
} reference_sheen_albedos;

/* Takes a second. */
void reference_sheen_albedos_fill(reference_sheen_albedos *albedos);

typedef struct reference_sheen {
    double color[3], alpha;
    double under; /* the part of the light that they leave */
    reference_vec normal, view;
} reference_sheen;

/* normal and view must be unit; roughness is held to its range. */
void reference_sheen_set(reference_sheen *sheen, const reference_sheen_albedos *albedos,
                         const double color[3], double roughness, reference_vec normal,
                         reference_vec view);

/* f_r cos(theta) of light from w. */
void reference_sheen_at(const reference_sheen *sheen, reference_vec w, double rgb[3]);

#endif
