/* SPDX-License-Identifier: MIT */
/* dispatch.h - chooses the build of the kernels that this machine runs. */
#ifndef LAMPION_KERNELS_DISPATCH_H
#define LAMPION_KERNELS_DISPATCH_H

#include "src/base/unroll.h"
#include "src/kernels/kernels.h"
#include "src/kernels/single.h"

#include <stdatomic.h>

/* Fills the table with the best build among `cpu_flags` (lmp_cpu_flag, cpu.h) that this library
 * and machine have; scalar when there is none. Returns the flag of the build taken. */
unsigned lmpi_kernels_init(lmpi_kernels *kernels, unsigned cpu_flags);

/* The table in use: the one that lmp_cpu_limit chose, else the best, which the first call finds.
 * Inline, because a function call would take as long as evaluating a few bands. */
extern LMPI_HIDDEN _Atomic(const lmpi_kernels *) lmpi_kernel_table;
const lmpi_kernels *lmpi_kernels_find(void);
static inline const lmpi_kernels *lmpi_kernels_get(void) {
    const lmpi_kernels *kernels = atomic_load_explicit(&lmpi_kernel_table, memory_order_acquire);
    return kernels ? kernels : lmpi_kernels_find();
}

static inline const lmpi_single *lmpi_single_get(void) {
    return lmpi_kernels_get()->single;
}

/* Returns the kernels if they have been chosen and exist for so many bands, else NULL. A caller
 * that then goes on in a function with the same arguments leaves all of them in registers: saving
 * them for the rare case takes as long as evaluating two bands. */
static inline const lmpi_kernels *lmpi_single_for(int bands) {
    const lmpi_kernels *kernels = atomic_load_explicit(&lmpi_kernel_table, memory_order_acquire);
    return bands <= LMPI_SINGLE_BANDS ? kernels : NULL;
}

#endif
