/* SPDX-License-Identifier: MIT */
/* timing.h - a steady clock, and what to tell of repeated measurements. */
#ifndef LAMPION_TIMING_H
#define LAMPION_TIMING_H

#include <stddef.h>

/* The name of the CPU that is measured. */
void timing_cpu_name(char *name, size_t size);

/* Seconds of a clock that nobody sets. */
double timing_now(void);

typedef struct timing_quartiles {
    double lower, median, upper;
} timing_quartiles;

/* Of count >= 1 samples, which are sorted. */
timing_quartiles timing_of(double *samples, int count);

#endif
