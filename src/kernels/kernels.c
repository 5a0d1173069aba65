/* SPDX-License-Identifier: MIT */
#include "src/kernels/kernels.h"

#include <lampion/cpu.h>

#ifdef LMP_KERNELS_X86
#include <cpuid.h>
#endif

extern const lmp_kernels lmp_kernels_scalar;
#ifdef LMP_KERNELS_VECTOR
extern const lmp_kernels lmp_kernels_vector;
#endif
#ifdef LMP_KERNELS_X86
extern const lmp_kernels lmp_kernels_avx512;
#endif

/* The only state of the library. Whoever finds it empty publishes the same value. */
_Atomic(const lmp_kernels *) lmp_kernel_table;

#ifdef LMP_KERNELS_X86
/* Conversions of 16 bits, which every CPU with AVX2 has; clang 14 has no name for them. */
static int kernels_have_halves(void) {
    unsigned a, b, c, d;
    return __get_cpuid(1, &a, &b, &c, &d) && (c & bit_F16C);
}
#endif

unsigned lmp_cpu_flags(void) {
    unsigned flags = LMP_CPU_SCALAR;
#ifdef LMP_KERNELS_VECTOR
    flags |= LMP_CPU_VECTOR;
#endif
#ifdef LMP_KERNELS_X86
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") && kernels_have_halves())
        flags |= LMP_CPU_AVX2;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq"))
        flags |= LMP_CPU_AVX512;
#endif
    return flags;
}

static const lmp_kernels *kernels_best(unsigned flags, unsigned *flag) {
    flags &= lmp_cpu_flags();
#ifdef LMP_KERNELS_X86
    if (flags & LMP_CPU_AVX512) {
        *flag = LMP_CPU_AVX512;
        return &lmp_kernels_avx512;
    }
    if (flags & LMP_CPU_AVX2) {
        *flag = LMP_CPU_AVX2;
        return &lmp_kernels_avx2;
    }
#endif
#ifdef LMP_KERNELS_VECTOR
    if (flags & LMP_CPU_VECTOR) {
        *flag = LMP_CPU_VECTOR;
        return &lmp_kernels_vector;
    }
#endif
    (void)flags; /* read by none where scalar is all there is */
    *flag = LMP_CPU_SCALAR;
    return &lmp_kernels_scalar;
}

unsigned lmp_kernels_init(lmp_kernels *kernels, unsigned cpu_flags) {
    unsigned flag;
    *kernels = *kernels_best(cpu_flags, &flag);
    return flag;
}

unsigned lmp_cpu_mask(unsigned mask) {
    unsigned flag;
    atomic_store_explicit(&lmp_kernel_table, kernels_best(mask, &flag), memory_order_release);
    return flag;
}

const lmp_kernels *lmp_kernels_find(void) {
    unsigned flag;
    const lmp_kernels *none = NULL, *kernels = kernels_best(LMP_CPU_ALL, &flag);
    /* A mask set meanwhile by another thread stands. */
    if (!atomic_compare_exchange_strong(&lmp_kernel_table, &none, kernels))
        kernels = none;
    return kernels;
}

const char *lmp_cpu_name(void) {
    return lmp_kernels_get()->name;
}
