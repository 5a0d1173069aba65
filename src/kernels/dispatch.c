/* SPDX-License-Identifier: MIT */
#include "src/kernels/dispatch.h"

#include <lampion/cpu.h>

extern const lmpi_kernels lmpi_kernels_scalar, lmpi_kernels_vector, lmpi_kernels_avx512;

/* Find whether this machine runs each of the builds for x86-64, the best first. */
#ifdef LMPI_KERNELS_X86
#include <cpuid.h>
#define X86_BUILDS { LMP_CPU_AVX512, &lmpi_kernels_avx512 }, { LMP_CPU_AVX2, &lmpi_kernels_avx2 },

/* Whether the CPU converts 16-bit floats, as every CPU with AVX2 does; clang 14 has no name for it.
 */
static int has_halves(void) {
    unsigned a, b, c, d;
    return __get_cpuid(1, &a, &b, &c, &d) && (c & bit_F16C);
}

static unsigned machine_flags(void) {
    unsigned flags = LMP_CPU_SCALAR | LMP_CPU_VECTOR;
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") && has_halves())
        flags |= LMP_CPU_AVX2;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq"))
        flags |= LMP_CPU_AVX512;
    return flags;
}
#else
#define X86_BUILDS

static unsigned machine_flags(void) {
    return LMP_CPU_ALL;
}
#endif

/* The builds of this library, the best first. */
static const struct {
    unsigned flag;
    const lmpi_kernels *kernels;
} builds[] = {
    X86_BUILDS
#ifdef LMPI_KERNELS_VECTOR
    { LMP_CPU_VECTOR, &lmpi_kernels_vector },
#endif
#ifndef LMPI_KERNELS_NO_SCALAR
    { LMP_CPU_SCALAR, &lmpi_kernels_scalar },
#endif
};
enum { BUILDS = sizeof builds / sizeof *builds };

/* The only state of the library. Every thread that finds it empty publishes the same value. */
_Atomic(const lmpi_kernels *) lmpi_kernel_table;

unsigned lmp_cpu_flags(void) {
    const unsigned machine = machine_flags();
    unsigned flags = 0;
    for (int i = 0; i < BUILDS; i++)
        flags |= builds[i].flag & machine;
    return flags;
}

static const lmpi_kernels *kernels_best(unsigned flags, unsigned *flag) {
    const unsigned there = flags & machine_flags();
    int i = 0;
    while (i < BUILDS - 1 && !(builds[i].flag & there))
        i++;
    *flag = builds[i].flag;
    return builds[i].kernels;
}

unsigned lmpi_kernels_init(lmpi_kernels *kernels, unsigned cpu_flags) {
    unsigned flag;
    *kernels = *kernels_best(cpu_flags, &flag);
    return flag;
}

unsigned lmp_cpu_limit(unsigned mask) {
    unsigned flag;
    atomic_store_explicit(&lmpi_kernel_table, kernels_best(mask, &flag), memory_order_release);
    return flag;
}

const lmpi_kernels *lmpi_kernels_find(void) {
    unsigned flag;
    const lmpi_kernels *none = NULL, *kernels = kernels_best(LMP_CPU_ALL, &flag);
    /* A mask that another thread set meanwhile is kept. */
    if (!atomic_compare_exchange_strong(&lmpi_kernel_table, &none, kernels))
        kernels = none;
    return kernels;
}

const char *lmp_cpu_name(void) {
    return lmpi_kernels_get()->name;
}
