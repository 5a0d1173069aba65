/* SPDX-License-Identifier: MIT */
/* formula.h - ways to shade by a spherical light, each short and written from its paper alone, in a
 * file of its own. A new one is a function here and a row of formula_table. */
#ifndef LAMPION_SCOREBOARD_FORMULA_H
#define LAMPION_SCOREBOARD_FORMULA_H

#include "app/ruler/table.h"

#include <lampion/shade.h>

/* A disk of directions of radiance 1, as a sphere or a sun gives, on one material. Each formula
 * derives what it needs: its time counts that. */
typedef struct formula_query {
    lmp_vec3 normal, view, light; /* unit */
    float sine;                   /* of the light's half angle, radius over distance: 0 … 1 */
    ruler_material material;
    float color, roughness, exponent; /* as the row has them */
} formula_query;

/* The radiance that is reflected. */
typedef float formula_radiance(const formula_query *query, const lmp_shade_settings *settings);

formula_radiance formula_black, formula_point, formula_representative, formula_halved,
    formula_widened, formula_bevy, formula_filament, formula_godot, formula_sphere,
    formula_gaussian, formula_anisotropic, formula_cosines, formula_irradiance, formula_lampion;

typedef struct formula {
    const char *name, *source;
    formula_radiance *radiance;
    bool applies[RULER_MATERIALS];
    lmp_shade_method method; /* of this library's own, their bands, and whether they read a table */
    int bands;
    bool reads_lobe;
} formula;

extern const formula formula_table[];
extern const int formula_count;
#define FORMULAS_MAX 20

/* What radiance receives: settings of a formula, and the table that they read, to be destroyed. */
bool formula_open(const formula *from, lmp_shade_settings *settings, lmp_preintegrated_lobe **lobe,
                  cli_error *error);

/* Whether a row is a disk of less than a hemisphere on a material that the formula knows; and the
 * query that the row is. */
bool formula_applies(const formula *by, const ruler_row *row);
formula_query formula_query_of(const ruler_row *row);

#endif
