/* SPDX-License-Identifier: MIT */
/* mistake.h - what errors look like, where they are of one kind. */
#ifndef LAMPION_RULER_MISTAKE_H
#define LAMPION_RULER_MISTAKE_H

#include "app/ruler/figures.h"

/* Prints a line for each mistake that explains all errors of a kind of material. */
void ruler_mistake_print(const ruler_table *table, const double *values,
                         const ruler_limits *limits);

#endif
