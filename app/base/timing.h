/* SPDX-License-Identifier: MIT */
/* timing.h - a steady clock, and quartiles of repeated measurements. */
#ifndef LAMPION_BASE_TIMING_H
#define LAMPION_BASE_TIMING_H

#include <stddef.h>

/* Writes the name of the CPU that is measured. */
void timing_cpu_name(char *name, size_t size);

/* Returns the seconds of a monotonic clock. */
double timing_now(void);

typedef struct timing_quartiles {
    double lower, median, upper;
} timing_quartiles;

/* Returns the quartiles of count >= 1 samples, which it sorts. */
timing_quartiles timing_of(double *samples, int count);

#endif
