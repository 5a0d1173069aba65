/* SPDX-License-Identifier: MIT */
/* lampion/cpu.h - which instruction set the batch functions (those whose names end in _n) use.
 *
 * Batch functions use the best set that the machine has, and every set gives the same bits, so no
 * program needs the functions below for its results. They serve to report which set is in use, and
 * to compare speeds. */
#ifndef LAMPION_CPU_H
#define LAMPION_CPU_H

#include <lampion/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Instruction sets, in order of increasing width. A build for another architecture lacks those that
 * the architecture does not have. */
typedef enum lmp_cpu_flag {
    LMP_CPU_SCALAR = 1, /* always available */
    LMP_CPU_VECTOR = 2, /* 4 lanes: SSE2 or NEON, the platform's baseline */
    LMP_CPU_AVX2 = 4,   /* 8 lanes */
    LMP_CPU_AVX512 = 8, /* 16 lanes: F, VL and DQ */
    LMP_CPU_ALL = 15
} lmp_cpu_flag;

/* Returns the lmp_cpu_flag bits of the sets that this machine has and this library was built with.
 * LMP_CPU_SCALAR is always among them. */
LMP_API unsigned lmp_cpu_flags(void);

/* Limits the batch functions of the whole process to the instruction sets in `mask`, or to scalar
 * code if the machine has none of them, and returns the flag of the set now in use. Initially the
 * best set is in use; LMP_CPU_ALL restores it. It may be called from any thread at any time: calls
 * under way finish as they began. */
LMP_API unsigned lmp_cpu_limit(unsigned mask);

/* Returns the name of the instruction set in use, for a log or a report: "scalar", "sse2", "neon",
 * "avx2" or "avx512". The name is in static storage. */
LMP_API const char *lmp_cpu_name(void);

#ifdef __cplusplus
}
#endif
#endif
