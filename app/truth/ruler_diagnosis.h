/* SPDX-License-Identifier: MIT */
/* ruler_diagnosis.h - diagnoses of errors that have a common cause. */
#ifndef LAMPION_TRUTH_RULER_DIAGNOSIS_H
#define LAMPION_TRUTH_RULER_DIAGNOSIS_H

#include "app/truth/ruler_figures.h"

/* Prints a line for each diagnosis that explains all errors of a kind of material. */
void ruler_diagnosis_print(const ruler_table *table, const double *values,
                           const ruler_limits *limits);

#endif
