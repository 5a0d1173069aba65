/* SPDX-License-Identifier: MIT */
/* ruler_figures.h - errors of a column of values, and their statistics. */
#ifndef LAMPION_TRUTH_RULER_FIGURES_H
#define LAMPION_TRUTH_RULER_FIGURES_H

#include "app/truth/ruler_table.h"

/* Returns (value - truth) / (truth + RULER_DARK scale), reduced by the truth's uncertainty: a
 * relative error, except where the truth is darker than a tenth of a white diffuse surface. */
#define RULER_DARK 0.1
double ruler_error(const ruler_row *row, double value);

/* Returns the error relative to the greater of value and truth, from -1, all is missing, to 1: too
 * bright by a factor is as wrong as too dark by the same factor. */
double ruler_balanced_error(const ruler_row *row, double value);

/* Statistics of a set of rows. */
typedef struct ruler_figures {
    int count;
    double rms, largest; /* of the errors */
    double balanced;     /* root mean square of the balanced errors */
    double energy;       /* sum of the values over that of the truths, both relative to the scale */
} ruler_figures;

/* Returns the statistics of the rows that `belongs` selects, or of all rows if it is NULL. */
typedef bool (*ruler_filter)(const ruler_row *row, const void *user);
ruler_figures ruler_figures_of(const ruler_table *table, const double *values, ruler_filter belongs,
                               const void *user);

/* The largest statistics that are accepted. */
typedef struct ruler_limits {
    double rms, largest;
} ruler_limits;

#endif
