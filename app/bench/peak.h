/* SPDX-License-Identifier: MIT */
/* peak.h - the most that a core does in a second. */
#ifndef LAMPION_BENCH_PEAK_H
#define LAMPION_BENCH_PEAK_H

#include <stddef.h>

/* Nanoseconds of one operation a lane of the instruction set (LMP_CPU_…): a multiply-add, or
 * another that takes the same unit as long. */
double bench_peak(unsigned flag);

/* Nanoseconds to fill `count` floats, which are 64-byte aligned and lie where stores before left
 * them, by the instruction set's registers: no kernel that writes as much takes less. */
double bench_stores(unsigned flag, float *to, size_t count);

/* The same past the caches, where the instruction set can. */
double bench_streams(unsigned flag, float *to, size_t count);

#endif
