/* SPDX-License-Identifier: MIT */
/* figures.h - errors of a column of values, and what sums them up. */
#ifndef LAMPION_RULER_FIGURES_H
#define LAMPION_RULER_FIGURES_H

#include "app/ruler/table.h"

/* An error is (value - truth) / (truth + RULER_DARK scale), less what the truth is uncertain by:
 * relative, but where it is darker than a tenth of what white diffuse would be. */
#define RULER_DARK 0.1
double ruler_error(const ruler_row *row, double value);

/* The same in parts of the greater of value and truth: from -1, all is missing, to 1. What is too
 * bright by a factor is as wrong as what is too dark by it. */
double ruler_balanced_error(const ruler_row *row, double value);

/* Of some of the rows. */
typedef struct ruler_figures {
    int count;
    double rms, largest; /* of the errors */
    double balanced;     /* root mean square of the balanced errors */
    double energy;       /* sum of the values over that of the truths, both in parts of the scale */
} ruler_figures;

/* Of the rows that `belongs` picks; NULL: of all. */
typedef bool (*ruler_filter)(const ruler_row *row, const void *user);
ruler_figures ruler_figures_of(const ruler_table *table, const double *values, ruler_filter belongs,
                               const void *user);

/* What is allowed of them. */
typedef struct ruler_limits {
    double rms, largest;
} ruler_limits;

#endif
