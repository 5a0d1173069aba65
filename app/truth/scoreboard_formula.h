/* SPDX-License-Identifier: MIT */
/* scoreboard_formula.h - formulas for shading by a spherical light, each short, implemented from
 * its paper alone, in a file of its own. A new one is a function here and a row of
 * formula_table. */
#ifndef LAMPION_TRUTH_SCOREBOARD_FORMULA_H
#define LAMPION_TRUTH_SCOREBOARD_FORMULA_H

#include "app/truth/ruler_table.h"
#include "app/truth/scoreboard_cosines_table.h"

#include <lampion/shade.h>

/* A disk of directions with radiance 1, as a sphere or a sun gives, and one material. Each formula
 * derives what it needs, and its time includes that. */
typedef struct formula_query {
    lmp_vec3 normal, view, light; /* unit */
    float sine;                   /* of the light's half angle, radius over distance: 0 … 1 */
    ruler_material material;
    float color, roughness, exponent; /* as in the row */
} formula_query;

/* What some formulas also read: settings and lobes of this library, a table of cosines. */
typedef struct formula_reads {
    lmp_shade_settings settings;
    lmp_preintegrated_lobe *lobe;
    const cosines_table *cosines;
} formula_reads;

/* Returns the reflected radiance. */
typedef float formula_radiance(const formula_query *query, const formula_reads *reads);

formula_radiance formula_black, formula_point, formula_representative, formula_halved,
    formula_widened, formula_bevy, formula_filament, formula_godot, formula_sphere,
    formula_gaussian, formula_anisotropic, formula_cosines, formula_irradiance, formula_lampion;

typedef struct formula {
    const char *name, *source;
    formula_radiance *radiance;
    bool applies[RULER_MATERIALS];
    lmp_shade_method method; /* of the library's own, their bands, and whether they read a lobe */
    int bands;
    bool reads_lobe;
    bool published; /* whether it reads a published table instead of our own */
} formula;

extern const formula formula_table[];
extern const int formula_count;
#define FORMULAS_MAX 20

/* Prepares what a formula reads, until formula_close. `published` was read from a file, or is NULL:
 * formulas that read it then fail. */
bool formula_open(const formula *from, const cosines_table *published, formula_reads *reads,
                  base_error *error);
void formula_close(formula_reads *reads);

/* Whether a row is a disk of less than a hemisphere on a material that the formula supports; and
 * the query of that row. */
bool formula_applies(const formula *by, const ruler_row *row);
formula_query formula_query_of(const ruler_row *row);

#endif
