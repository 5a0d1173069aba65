/* SPDX-License-Identifier: MIT */
/* formula.h - the materials as textbooks have them, by vectors, and mistakes that are made in them.
 * Integrals are plain sums over the solid angle around the light: nothing here is the ruler's. */
#ifndef LAMPION_RULER_FORMULA_H
#define LAMPION_RULER_FORMULA_H

#include "tests/ruler/rows.h"

typedef enum mistake {
    MISTAKE_NONE,
    MISTAKE_PHONG,         /* Phong's lobe of exponent 2/alpha² - 2 in the place of GGX */
    MISTAKE_HORIZON,       /* light from below the horizon counts */
    MISTAKE_FRESNEL,       /* Fresnel's term left at f0 */
    MISTAKE_NORMALIZATION, /* pi times too bright */
    MISTAKES
} mistake;

/* f_r cos of the row's material, for light from `light`; z is the normal. */
double formula_at(const ruler_row *row, mistake kind, const double light[3]);

/* Of the row's light: steps² directions of equal solid angle. */
double formula_over_light(const ruler_row *row, mistake kind, int steps);

#endif
