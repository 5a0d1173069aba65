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

/* At the end of a loop over `i`: no vectors are made of it. A vector's load would wait for the
 * stores of single values just before to reach the cache, longer than a few bands take. */
#define LMP_ONE_BY_ONE(i) __asm__ volatile("" : "+r"(i))

/* Cases of a switch over bands: of one number, and of those that engines ask for one light at a
 * time. */
#define LMP_CASE(bands, body, ...)                                                                 \
    case bands:                                                                                    \
        body(bands, __VA_ARGS__);                                                                  \
        break;
#define LMP_FEW_BANDS 6
#define LMP_FEW_CASES(body, ...)                                                                   \
    LMP_CASE(1, body, __VA_ARGS__)                                                                 \
    LMP_CASE(2, body, __VA_ARGS__)                                                                 \
    LMP_CASE(3, body, __VA_ARGS__)                                                                 \
    LMP_CASE(4, body, __VA_ARGS__)                                                                 \
    LMP_CASE(5, body, __VA_ARGS__)                                                                 \
    LMP_CASE(6, body, __VA_ARGS__)

#define LMP_SMALL_CASES(body, ...)                                                                 \
    LMP_FEW_CASES(body, __VA_ARGS__)                                                               \
    LMP_CASE(7, body, __VA_ARGS__)                                                                 \
    LMP_CASE(8, body, __VA_ARGS__)                                                                 \
    LMP_CASE(9, body, __VA_ARGS__)                                                                 \
    LMP_CASE(10, body, __VA_ARGS__)

/* Calls body(bands, …); few bands as a constant, or up to 10 of what is small. */
#define LMP_STRAIGHT_SMALL(bands, body, ...)                                                       \
    switch (bands) {                                                                               \
        LMP_SMALL_CASES(body, __VA_ARGS__)                                                         \
    default:                                                                                       \
        body(bands, __VA_ARGS__);                                                                  \
    }
#define LMP_STRAIGHT(bands, body, ...)                                                             \
    switch (bands) {                                                                               \
        LMP_FEW_CASES(body, __VA_ARGS__)                                                           \
    default:                                                                                       \
        body(bands, __VA_ARGS__);                                                                  \
    }

#endif
