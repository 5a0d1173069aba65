/* SPDX-License-Identifier: MIT */
/* lampion/cpu.h - which instruction set the batch functions use. */
#ifndef LAMPION_CPU_H
#define LAMPION_CPU_H

#include <lampion/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Instruction sets the batch functions (those that end in _n) are built for. Every build gives the
 * same bits; the mask exists to compare their speed. */
typedef enum lmp_cpu_flag {
    LMP_CPU_SCALAR = 1, /* always there */
    LMP_CPU_VECTOR = 2, /* 4 lanes: SSE2 or NEON, the base of the platform */
    LMP_CPU_AVX2 = 4,   /* 8 lanes */
    LMP_CPU_AVX512 = 8, /* 16 lanes: F, VL and DQ */
    LMP_CPU_ALL = 15
} lmp_cpu_flag;

/* The lmp_cpu_flag bits that this machine has and this library was built with. */
LMP_API unsigned lmp_cpu_flags(void);

/* Limits the batch functions to the instruction sets in `mask` (scalar if none of them is here) and
 * returns the flag of the one now in use. Before the first call the best is in use. Safe to call
 * from any thread at any time: calls under way finish as they began. */
LMP_API unsigned lmp_cpu_mask(unsigned mask);

/* "scalar", "sse2", "neon", "avx2" or "avx512": the instruction set in use. Static storage. */
LMP_API const char *lmp_cpu_name(void);

#ifdef __cplusplus
}
#endif
#endif
