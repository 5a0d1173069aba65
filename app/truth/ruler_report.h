/* SPDX-License-Identifier: MIT */
/* ruler_report.h - a report of how far a column of values is from the proven ones. */
#ifndef LAMPION_TRUTH_RULER_REPORT_H
#define LAMPION_TRUTH_RULER_REPORT_H

#include "app/truth/ruler_figures.h"

/* Prints the statistics of all rows, then by material, roughness, light, size, distance and view,
 * the rows with the largest errors, and diagnoses. Returns whether rms and largest are within the
 * limits. */
bool ruler_report(const ruler_table *table, const double *values, const ruler_limits *limits);

#endif
