/* SPDX-License-Identifier: MIT */
/* formula.h - the materials as in textbooks, by vectors, and errors that are commonly made in
 * them. Integrals are plain sums over the solid angle around the light, without the ruler's code.
 */
#ifndef LAMPION_RULER_FORMULA_H
#define LAMPION_RULER_FORMULA_H

#include "tests/ruler/rows.h"

typedef enum diagnosis {
    DIAGNOSIS_NONE,
    DIAGNOSIS_PHONG,         /* Phong's lobe of exponent 2/alpha² - 2 in place of GGX */
    DIAGNOSIS_HORIZON,       /* light from below the horizon counts */
    DIAGNOSIS_FRESNEL,       /* Fresnel's term left at f0 */
    DIAGNOSIS_NORMALIZATION, /* pi times too bright */
    DIAGNOSES
} diagnosis;

/* Returns f_r cos of the row's material, for light from `light`; z is the normal. */
double formula_at(const ruler_row *row, diagnosis kind, const double light[3]);

/* Integrates over the row's light: steps² directions of equal solid angle. */
double formula_over_light(const ruler_row *row, diagnosis kind, int steps);

#endif
