/* SPDX-License-Identifier: MIT */
/* unroll.h - what the compilers are told of loops and functions whose speed matters. */
#ifndef LAMPION_BASE_UNROLL_H
#define LAMPION_BASE_UNROLL_H

#define LMP_INLINE   static inline __attribute__((always_inline))
#define LMP_NOINLINE __attribute__((noinline))

/* Unrolls a loop of constant length whole; of a constant number of bands that is straight-line
 * code. */
#if !defined(__OPTIMIZE__)
#define LMP_UNROLL
#define LMP_ROLLED
#elif defined(__clang__)
#define LMP_UNROLL _Pragma("clang loop unroll(full)")
#define LMP_ROLLED _Pragma("clang loop unroll(disable)")
#else
#define LMP_UNROLL _Pragma("GCC unroll 16")
#define LMP_ROLLED _Pragma("GCC unroll 1")
#endif

/* Calls body(bands, …); few bands, which engines ask for one light at a time, as a constant. */
#define LMP_FEW_BANDS 6
#define LMP_STRAIGHT(bands, body, ...)                                                             \
    switch (bands) {                                                                               \
    case 1:                                                                                        \
        body(1, __VA_ARGS__);                                                                      \
        break;                                                                                     \
    case 2:                                                                                        \
        body(2, __VA_ARGS__);                                                                      \
        break;                                                                                     \
    case 3:                                                                                        \
        body(3, __VA_ARGS__);                                                                      \
        break;                                                                                     \
    case 4:                                                                                        \
        body(4, __VA_ARGS__);                                                                      \
        break;                                                                                     \
    case 5:                                                                                        \
        body(5, __VA_ARGS__);                                                                      \
        break;                                                                                     \
    case 6:                                                                                        \
        body(6, __VA_ARGS__);                                                                      \
        break;                                                                                     \
    default:                                                                                       \
        body(bands, __VA_ARGS__);                                                                  \
    }

#endif
