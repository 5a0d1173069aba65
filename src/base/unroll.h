/* SPDX-License-Identifier: MIT */
/* unroll.h - hints to compilers about loops and functions whose speed matters. */
#ifndef LAMPION_BASE_UNROLL_H
#define LAMPION_BASE_UNROLL_H

#define LMPI_INLINE   static inline __attribute__((always_inline))
#define LMPI_NOINLINE __attribute__((noinline))

/* Says that a variable lies in the library itself, so that reading it takes one instruction, not
 * two: -fvisibility=hidden says it of definitions only. */
#ifdef __ELF__
#define LMPI_HIDDEN __attribute__((visibility("hidden")))
#else
#define LMPI_HIDDEN
#endif

/* Unrolls a loop of constant length whole; for a constant number of bands that gives straight-line
 * code, which takes compilers minutes. Builds whose speed matters to nobody define
 * LMPI_ROLLED_LOOPS (LAMPION_UNROLL=OFF). */
#if !defined(__OPTIMIZE__) || defined(LMPI_ROLLED_LOOPS)
#define LMPI_UNROLL
#define LMPI_ROLLED
#elif defined(__clang__)
#define LMPI_UNROLL _Pragma("clang loop unroll(full)")
#define LMPI_ROLLED _Pragma("clang loop unroll(disable)")
#else
#define LMPI_UNROLL _Pragma("GCC unroll 16")
#define LMPI_ROLLED _Pragma("GCC unroll 1")
#endif

/* Keeps the compiler from vectorizing a loop over `i`, at whose end it stands. A vector's load
 * would wait until the single values stored just before reach the cache, longer than a few bands
 * take. */
#define LMPI_ONE_BY_ONE(i) __asm__ volatile("" : "+r"(i))

/* Cases of a switch over bands: LMPI_CASE of one number, LMPI_FEW_CASES of the numbers that engines
 * use for one light at a time, LMPI_SMALL_CASES of up to 10 bands. */
#define LMPI_CASE(bands, body, ...)                                                                \
    case bands:                                                                                    \
        body(bands, __VA_ARGS__);                                                                  \
        break;
#define LMPI_FEW_BANDS 6
#define LMPI_FEW_CASES(body, ...)                                                                  \
    LMPI_CASE(1, body, __VA_ARGS__)                                                                \
    LMPI_CASE(2, body, __VA_ARGS__)                                                                \
    LMPI_CASE(3, body, __VA_ARGS__)                                                                \
    LMPI_CASE(4, body, __VA_ARGS__)                                                                \
    LMPI_CASE(5, body, __VA_ARGS__)                                                                \
    LMPI_CASE(6, body, __VA_ARGS__)

#define LMPI_SMALL_CASES(body, ...)                                                                \
    LMPI_FEW_CASES(body, __VA_ARGS__)                                                              \
    LMPI_CASE(7, body, __VA_ARGS__)                                                                \
    LMPI_CASE(8, body, __VA_ARGS__)                                                                \
    LMPI_CASE(9, body, __VA_ARGS__)                                                                \
    LMPI_CASE(10, body, __VA_ARGS__)

/* Call body(bands, …) with few bands as a constant: up to 6, or up to 10 for small code. */
#define LMPI_STRAIGHT_SMALL(bands, body, ...)                                                      \
    switch (bands) {                                                                               \
        LMPI_SMALL_CASES(body, __VA_ARGS__)                                                        \
    default:                                                                                       \
        body(bands, __VA_ARGS__);                                                                  \
    }
#define LMPI_STRAIGHT(bands, body, ...)                                                            \
    switch (bands) {                                                                               \
        LMPI_FEW_CASES(body, __VA_ARGS__)                                                          \
    default:                                                                                       \
        body(bands, __VA_ARGS__);                                                                  \
    }

#endif
