/* SPDX-License-Identifier: MIT */
/* wide.h - loops for the widest vectors of the machine. A function marked TRACE_WIDE is built once
 * more for each width of x86-64 and chosen when the program starts; as nothing is fused, the bits
 * are the same. */
#ifndef LAMPION_TRACE_WIDE_H
#define LAMPION_TRACE_WIDE_H

/* Sanitizers do not bear what is chosen before they start. */
#if defined __x86_64__ && !defined __clang__ && defined __OPTIMIZE__ &&                            \
    !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
#define TRACE_WIDE __attribute__((flatten, target_clones("avx512f", "avx2", "default")))
#else
#define TRACE_WIDE
#endif

#endif
