/* SPDX-License-Identifier: MIT */
/* wide.h - loops for the widest vectors of the machine. A function marked TRACE_WIDE is also built
 * for each vector width of x86-64, and the version is chosen when the program starts; without fused
 * operations, the bits are the same. */
#ifndef LAMPION_SCENE_TRACE_WIDE_H
#define LAMPION_SCENE_TRACE_WIDE_H

/* Sanitizers do not support functions that are chosen at load time, before they start. */
#if defined __x86_64__ && !defined __clang__ && defined __OPTIMIZE__ &&                            \
    !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
#define TRACE_WIDE __attribute__((flatten, target_clones("avx512f", "avx2", "default")))
#else
#define TRACE_WIDE
#endif

#endif
