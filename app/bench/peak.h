/* SPDX-License-Identifier: MIT */
/* peak.h - the most that a core does in a second. */
#ifndef LAMPION_BENCH_PEAK_H
#define LAMPION_BENCH_PEAK_H

/* Nanoseconds of one operation a lane of the instruction set (LMP_CPU_…): a multiply-add, or
 * another that takes the same unit as long. */
double bench_peak(unsigned flag);

#endif
