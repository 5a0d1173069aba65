/* SPDX-License-Identifier: MIT */
/* lampion/cpu.h - which instruction set the batch functions (those that end in _n) use.
 *
 * They take the best that the machine has, and every one gives the same bits: nothing here need be
 * called. It is there to say what is in use, and to compare speeds. */
#ifndef LAMPION_CPU_H
#define LAMPION_CPU_H

#include <lampion/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Instruction sets, of rising width; a build for another machine lacks those it cannot have. */
typedef enum lmp_cpu_flag {
    LMP_CPU_SCALAR = 1, /* always there */
    LMP_CPU_VECTOR = 2, /* 4 lanes: SSE2 or NEON, the base of the platform */
    LMP_CPU_AVX2 = 4,   /* 8 lanes */
    LMP_CPU_AVX512 = 8, /* 16 lanes: F, VL and DQ */
    LMP_CPU_ALL = 15
} lmp_cpu_flag;

/* The lmp_cpu_flag bits that this machine has and this library was built with; LMP_CPU_SCALAR is
 * among them. */
LMP_API unsigned lmp_cpu_flags(void);

/* Limits the batch functions to the instruction sets in `mask` (scalar if none of them is here) and
 * returns the flag of the one now in use. Before the first call the best is in use: LMP_CPU_ALL
 * brings it back. It counts for the whole process. Safe from any thread at any time: calls under
 * way finish as they began. */
LMP_API unsigned lmp_cpu_mask(unsigned mask);

/* The instruction set in use, for a log or a report: "scalar", "sse2", "neon", "avx2" or "avx512".
 * Static storage. */
LMP_API const char *lmp_cpu_name(void);

#ifdef __cplusplus
}
#endif
#endif
