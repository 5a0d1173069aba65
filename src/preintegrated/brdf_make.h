/* SPDX-License-Identifier: MIT */
/* brdf_make.h - how a BRDF is integrated beforehand: the rows of its slices (brdf_rows.c), the
 * views and half angles to hold (brdf_nodes.c), then the slices of each half angle (brdf_slices.c).
 */
#ifndef LAMPION_PREINTEGRATED_BRDF_MAKE_H
#define LAMPION_PREINTEGRATED_BRDF_MAKE_H

#include "src/preintegrated/brdf.h"
#include "src/preintegrated/brdf_series.h"

/* --- rows ------------------------------------------------------------------------------------- */

/* The row coordinate of an angle from the rim and its inverse, the angle of the rim, and the half
 * angle at a step: those of readings (lookup.h), in double. */
double lmp_preintegrated_brdf_row_of(const brdf_series *series, double x);
double lmp_preintegrated_brdf_x_of(const brdf_series *series, double s);
double lmp_preintegrated_brdf_rim_of(const brdf_series *series, double a);
double lmp_preintegrated_brdf_angle_at(int step);

/* Sets reach and slope of the series: the fewest rows that keep the values. */
lmp_result lmp_preintegrated_brdf_choose_rows(brdf_series *series, float error);

/* --- thinning --------------------------------------------------------------------------------- */

/* Measured with three materials at 10 bands (docs/preintegration.md): a row step of 0.4 errs no
 * less for a fifth more memory; half the margins change nothing. */
#define BRDF_ROW_STEP  0.6 /* of the row coordinate, on the fine grid */
#define BRDF_THINNING  8   /* the most, of rows: a power of two */
#define BRDF_MARGIN    16  /* rows past the far ends: what is unknown there fades by 0.27 each */
#define BRDF_WRAP      8   /* the same of columns: 0.27^8 = 3e-5 is a unit of 16 bits */
#define BRDF_TOLERANCE 0.5 /* of the error, of rows and of columns each; 0.8 errs by 0.38 % */

/* A slice's values on the fine grid: [channel][row][column]. */
typedef struct brdf_grid {
    float *values;
    size_t rows, columns; /* evaluated, not thinned */
    size_t row_factor, column_factor;
    bool mirrored;
    float *coefficients; /* room for them, with the columns past the ends */
    float *line;         /* room for two rows with their margins */
} brdf_grid;

/* Copies a row's columns first … first + count - 1, `step` apart: azimuths go around, or mirror. */
void lmp_preintegrated_brdf_copy_around(const brdf_grid *g, const float *row, ptrdiff_t first,
                                        size_t count, size_t step, float *to);

/* Whether splines through every factor-th row keep the values between to `limit`. */
bool lmp_preintegrated_brdf_rows_hold(const brdf_grid *g, size_t factor, float limit);

/* Sets the factors: the largest powers of two that keep the values to `limit`. */
void lmp_preintegrated_brdf_thin(brdf_grid *g, float limit);

/* The largest value but for the margins. */
float lmp_preintegrated_brdf_largest(const brdf_grid *g);

/* fmaxf is a call for the sake of NaN, and these loops are long. */
static inline float brdf_larger(float a, float b) {
    return a > b ? a : b;
}

/* --- nodes and slices ------------------------------------------------------------------------- */

/* The steps of the half angle, and of the view, to hold, and their number. */
lmp_result lmp_preintegrated_brdf_caps(const brdf_series *series, float error, int *nodes,
                                       int *count);
lmp_result lmp_preintegrated_brdf_view_nodes(const brdf_series *series, float error, int *nodes,
                                             int *count);

/* One half angle's slices, of all views: texels in its own memory. */
typedef struct brdf_column {
    lmp_preintegrated_brdf_slice *slices; /* of every view; first counts from 0 */
    int16_t *texels;
    size_t texel_count;
} brdf_column;

/* The slices of cap node `index` of `count`. */
lmp_result lmp_preintegrated_brdf_slices(const brdf_views *views, const int *caps, int count,
                                         int index, float error, brdf_column *column);
void lmp_preintegrated_brdf_column_free(const brdf_series *series, brdf_column *column);

#endif
