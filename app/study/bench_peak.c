/* SPDX-License-Identifier: MIT */
#include "app/study/bench_peak.h"
#include "app/base/timing.h"

#include <lampion/lampion.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

/* Chains and rounds for nanoseconds per operation: independent multiply-adds on the units that also
 * multiply, add, divide and take roots (multiplications where the instruction set has no FMA).
 * There are enough chains for two units of 5 cycles, and enough rounds to make the clock's own 30
 * ns negligible. */
enum { PEAK_CHAINS = 12, PEAK_ROUNDS = 3400 };
/* Floats that the passes of bench_stores write in all: about 20 µs in the first cache. */
enum { STORE_FLOATS = 400000 };
#if defined(__x86_64__)
#define PEAK_STEP(a, step)                                                                         \
    (a) = step(a, one, one);                                                                       \
    __asm__ volatile("" : "+x"(a));
#define PEAK_LOOP(type, step)                                                                      \
    type a = one, b = one, c = one, d = one, e = one, f = one;                                     \
    type g = one, h = one, i = one, j = one, k = one, l = one;                                     \
    const double from = 1e9 * timing_now();                                                        \
    for (int r = 0; r < PEAK_ROUNDS; r++) {                                                        \
        PEAK_STEP(a, step)                                                                         \
        PEAK_STEP(b, step)                                                                         \
        PEAK_STEP(c, step)                                                                         \
        PEAK_STEP(d, step)                                                                         \
        PEAK_STEP(e, step)                                                                         \
        PEAK_STEP(f, step)                                                                         \
        PEAK_STEP(g, step)                                                                         \
        PEAK_STEP(h, step)                                                                         \
        PEAK_STEP(i, step)                                                                         \
        PEAK_STEP(j, step)                                                                         \
        PEAK_STEP(k, step)                                                                         \
        PEAK_STEP(l, step)                                                                         \
    }                                                                                              \
    return (1e9 * timing_now() - from) / ((double)PEAK_CHAINS * PEAK_ROUNDS);
#define STORE_LOOP(type, one, store)                                                               \
    const size_t width = sizeof(type) / sizeof *to, passes = STORE_FLOATS / count + 1;             \
    const type value = one;                                                                        \
    const double from = 1e9 * timing_now();                                                        \
    for (size_t pass = 0; pass < passes; pass++) {                                                 \
        size_t i = 0;                                                                              \
        for (; i + 4 * width <= count; i += 4 * width) {                                           \
            store(to + i, value);                                                                  \
            store(to + i + width, value);                                                          \
            store(to + i + 2 * width, value);                                                      \
            store(to + i + 3 * width, value);                                                      \
        }                                                                                          \
        for (; i + width <= count; i += width)                                                     \
            store(to + i, value);                                                                  \
        __asm__ volatile("" ::: "memory");                                                         \
    }                                                                                              \
    return (1e9 * timing_now() - from) / (double)passes;
#define PEAK_MULTIPLY(a, b, c) _mm_mul_ps(a, b)
__attribute__((target("avx512f"))) static double peak_avx512(void) {
    const __m512 one = _mm512_set1_ps(1);
    PEAK_LOOP(__m512, _mm512_fmadd_ps)
}
__attribute__((target("avx2,fma"))) static double peak_avx2(void) {
    const __m256 one = _mm256_set1_ps(1);
    PEAK_LOOP(__m256, _mm256_fmadd_ps)
}
static double peak_sse2(void) {
    const __m128 one = _mm_set1_ps(1);
    PEAK_LOOP(__m128, PEAK_MULTIPLY)
}
__attribute__((target("avx512f"))) static double stores_avx512(float *to, size_t count) {
    STORE_LOOP(__m512, _mm512_set1_ps(1), _mm512_store_ps)
}
__attribute__((target("avx2"))) static double stores_avx2(float *to, size_t count) {
    STORE_LOOP(__m256, _mm256_set1_ps(1), _mm256_store_ps)
}
static double stores_sse2(float *to, size_t count) {
    STORE_LOOP(__m128, _mm_set1_ps(1), _mm_store_ps)
}
__attribute__((target("avx512f"))) static double streams_avx512(float *to, size_t count) {
    STORE_LOOP(__m512, _mm512_set1_ps(1), _mm512_stream_ps)
}
__attribute__((target("avx2"))) static double streams_avx2(float *to, size_t count) {
    STORE_LOOP(__m256, _mm256_set1_ps(1), _mm256_stream_ps)
}
static double streams_sse2(float *to, size_t count) {
    STORE_LOOP(__m128, _mm_set1_ps(1), _mm_stream_ps)
}
double bench_stores(unsigned flag, float *to, size_t count) {
    return flag == LMP_CPU_AVX512 ? stores_avx512(to, count)
           : flag == LMP_CPU_AVX2 ? stores_avx2(to, count)
                                  : stores_sse2(to, count);
}
double bench_streams(unsigned flag, float *to, size_t count) {
    return flag == LMP_CPU_AVX512 ? streams_avx512(to, count)
           : flag == LMP_CPU_AVX2 ? streams_avx2(to, count)
                                  : streams_sse2(to, count);
}
double bench_peak(unsigned flag) {
    return flag == LMP_CPU_AVX512 ? peak_avx512()
           : flag == LMP_CPU_AVX2 ? peak_avx2()
                                  : peak_sse2();
}
#else
typedef float peak_lanes __attribute__((vector_size(16)));
double bench_peak(unsigned flag) {
    (void)flag;
    peak_lanes a[PEAK_CHAINS];
    const double from = 1e9 * timing_now();
    for (int i = 0; i < PEAK_CHAINS; i++)
        a[i] = (peak_lanes) { 1, 1, 1, 1 };
    for (int r = 0; r < PEAK_ROUNDS; r++)
        for (int i = 0; i < PEAK_CHAINS; i++) {
            a[i] = a[i] * 0.5f;
            __asm__ volatile("" : "+w"(a[i]));
        }
    return (1e9 * timing_now() - from) / ((double)PEAK_CHAINS * PEAK_ROUNDS);
}
double bench_stores(unsigned flag, float *to, size_t count) {
    (void)flag;
    const peak_lanes value = { 1, 1, 1, 1 };
    const size_t passes = STORE_FLOATS / count + 1;
    const double from = 1e9 * timing_now();
    for (size_t pass = 0; pass < passes; pass++) {
        for (size_t i = 0; i + 4 <= count; i += 4)
            *(peak_lanes *)(void *)(to + i) = value;
        __asm__ volatile("" ::: "memory");
    }
    return (1e9 * timing_now() - from) / (double)passes;
}
double bench_streams(unsigned flag, float *to, size_t count) {
    return bench_stores(flag, to, count);
}
#endif
