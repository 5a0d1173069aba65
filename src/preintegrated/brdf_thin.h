/* SPDX-License-Identifier: MIT */
/* brdf_thin.h - leaves out the rows and columns of a slice that splines reproduce. */
#ifndef LAMPION_PREINTEGRATED_BRDF_THIN_H
#define LAMPION_PREINTEGRATED_BRDF_THIN_H

#include <stdbool.h>
#include <stddef.h>

/* Constants measured with three materials at 10 bands (docs/preintegration.md): a row step of 0.4
 * errs no less for a fifth more memory; half the margins change nothing. */
#define BRDF_ROW_STEP  0.6 /* of the row coordinate, on the fine grid */
#define BRDF_THINNING  8   /* the largest factor for rows, a power of two */
#define BRDF_MARGIN    16  /* rows past the far ends; the unknown there fades by 0.27 per row */
#define BRDF_WRAP      8   /* columns past the ends; 0.27^8 = 3e-5 is a unit of 16 bits */
#define BRDF_TOLERANCE 0.5 /* of the error, for rows and columns each; 0.8 errs by 0.38 % */

/* A slice's values on the fine grid: [channel][row][column]. */
typedef struct brdf_grid {
    float *values;
    size_t rows, columns; /* evaluated, before thinning */
    size_t row_factor, column_factor;
    bool mirrored;
    float *coefficients; /* memory for the coefficients, with the columns past the ends */
    float *line;         /* memory for two rows with their margins */
} brdf_grid;

/* Copies columns first … first + count - 1 of a row, `step` apart; azimuths wrap around, or mirror.
 */
void lmpi_preintegrated_brdf_copy_around(const brdf_grid *g, const float *row, ptrdiff_t first,
                                         size_t count, size_t step, float *to);

/* Whether splines through every factor-th row keep the values between them to `limit`. */
bool lmpi_preintegrated_brdf_rows_hold(const brdf_grid *g, size_t factor, float limit);

/* Sets the factors to the largest powers of two that keep the values to `limit`. */
void lmpi_preintegrated_brdf_thin(brdf_grid *g, float limit);

/* Returns the largest value outside the margins. */
float lmpi_preintegrated_brdf_largest(const brdf_grid *g);

/* Returns the larger of two numbers, unlike fmaxf without a call for the sake of NaN: loops are
 * long. */
static inline float brdf_larger(float a, float b) {
    return a > b ? a : b;
}

#endif
