/* SPDX-License-Identifier: MIT */
/* verdict.h - how far a column of values is from the proven ones. */
#ifndef LAMPION_RULER_VERDICT_H
#define LAMPION_RULER_VERDICT_H

#include "app/ruler/figures.h"

/* Prints the figures of all rows, by material, roughness, light, size, distance and view, the worst
 * rows, and what the errors look like. Returns whether rms and largest are within the limits. */
bool ruler_verdict(const ruler_table *table, const double *values, const ruler_limits *limits);

#endif
