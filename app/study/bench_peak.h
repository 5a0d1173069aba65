/* SPDX-License-Identifier: MIT */
/* bench_peak.h - the peak throughput of a core. */
#ifndef LAMPION_STUDY_BENCH_PEAK_H
#define LAMPION_STUDY_BENCH_PEAK_H

#include <stddef.h>

/* Returns the nanoseconds per lane of one operation of the instruction set (LMP_CPU_…): a
 * multiply-add, or any that occupies the same unit as long. */
double bench_peak(unsigned flag);

/* Returns the nanoseconds to fill `count` floats, which are 64-byte aligned and in the cache where
 * earlier stores left them, by the instruction set's registers: a lower bound for kernels that
 * write as much. */
double bench_stores(unsigned flag, float *to, size_t count);

/* Returns the nanoseconds to fill floats past the caches, where the instruction set can. */
double bench_streams(unsigned flag, float *to, size_t count);

#endif
