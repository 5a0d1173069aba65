/* SPDX-License-Identifier: MIT */
/* lanes.h - LMP_LANES floats as one value, of exactly the width of the instruction set: a wider
 * type than the registers is several times slower under gcc. */
#ifndef LAMPION_KERNELS_LANES_H
#define LAMPION_KERNELS_LANES_H

#include "src/base/unroll.h"

#include <stdint.h>
#include <string.h>

#if LMP_LANES > 1 && (defined(__SSE2__) || defined(__AVX__))
#include <immintrin.h>
#elif LMP_LANES > 1 && defined(__ARM_NEON)
#include <arm_neon.h>
#elif LMP_LANES > 1 && defined(__wasm_simd128__)
#include <wasm_simd128.h>
#elif LMP_LANES == 1
#include <math.h>
#endif

/* Hides where a pointer comes from. Constants read through it stay broadcasting memory operands;
 * otherwise the compilers hoist every one of them from the loop, and spill it as a whole vector. */
#define LMP_OPAQUE(pointer) __asm__ volatile("" : "+r"(pointer))

/* The same for a register. Of equal lanes gcc would multiply the number they came from and
 * broadcast the product, two operations for one; a long sum's terms it would put off to its end and
 * spill. */
#if LMP_LANES == 1 || defined(__wasm__)
#define LMP_OPAQUE_LANES(v)
#elif defined(__AVX512F__)
#define LMP_OPAQUE_LANES(v) __asm__("" : "+v"(v))
#elif defined(__ARM_NEON)
#define LMP_OPAQUE_LANES(v) __asm__("" : "+w"(v))
#else
#define LMP_OPAQUE_LANES(v) __asm__("" : "+x"(v))
#endif

#define LMP_ALIGNED __attribute__((aligned(64)))

#if LMP_LANES == 1

typedef float vf;
typedef int32_t vi;

LMP_INLINE vf vf_sqrt(vf a) {
    return sqrtf(a);
}
LMP_INLINE vf vf_max(vf a, vf b) {
    return a > b ? a : b;
}
LMP_INLINE vf vf_min(vf a, vf b) {
    return a < b ? a : b;
}
/* a < b ? yes : no */
LMP_INLINE vf vf_select_less(vf a, vf b, vf yes, vf no) {
    return a < b ? yes : no;
}
LMP_INLINE int vf_any_less(vf a, vf b) {
    return a < b;
}

#else

typedef float vf __attribute__((vector_size(4 * LMP_LANES)));
typedef int32_t vi __attribute__((vector_size(4 * LMP_LANES)));

LMP_INLINE vf vf_select_less(vf a, vf b, vf yes, vf no) {
    const vi mask = (vi)(a < b);
    return (vf)((mask & (vi)yes) | (~mask & (vi)no));
}

#if defined(__AVX512F__)
LMP_INLINE vf vf_sqrt(vf a) {
    return (vf)_mm512_sqrt_ps((__m512)a);
}
LMP_INLINE vf vf_max(vf a, vf b) {
    return (vf)_mm512_max_ps((__m512)a, (__m512)b);
}
LMP_INLINE vf vf_min(vf a, vf b) {
    return (vf)_mm512_min_ps((__m512)a, (__m512)b);
}
LMP_INLINE int vf_any_less(vf a, vf b) {
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ) != 0;
}
#elif defined(__AVX2__)
LMP_INLINE vf vf_sqrt(vf a) {
    return (vf)_mm256_sqrt_ps((__m256)a);
}
LMP_INLINE vf vf_max(vf a, vf b) {
    return (vf)_mm256_max_ps((__m256)a, (__m256)b);
}
LMP_INLINE vf vf_min(vf a, vf b) {
    return (vf)_mm256_min_ps((__m256)a, (__m256)b);
}
LMP_INLINE int vf_any_less(vf a, vf b) {
    return _mm256_movemask_ps(_mm256_cmp_ps((__m256)a, (__m256)b, _CMP_LT_OQ)) != 0;
}
#elif defined(__SSE2__)
LMP_INLINE vf vf_sqrt(vf a) {
    return (vf)_mm_sqrt_ps((__m128)a);
}
LMP_INLINE vf vf_max(vf a, vf b) {
    return (vf)_mm_max_ps((__m128)a, (__m128)b);
}
LMP_INLINE vf vf_min(vf a, vf b) {
    return (vf)_mm_min_ps((__m128)a, (__m128)b);
}
LMP_INLINE int vf_any_less(vf a, vf b) {
    return _mm_movemask_ps(_mm_cmplt_ps((__m128)a, (__m128)b)) != 0;
}
#elif defined(__wasm_simd128__)
/* pmax(b, a) is b < a ? a : b, and pmin likewise: b where they are equal or not numbers. */
LMP_INLINE vf vf_sqrt(vf a) {
    return (vf)wasm_f32x4_sqrt((v128_t)a);
}
LMP_INLINE vf vf_max(vf a, vf b) {
    return (vf)wasm_f32x4_pmax((v128_t)b, (v128_t)a);
}
LMP_INLINE vf vf_min(vf a, vf b) {
    return (vf)wasm_f32x4_pmin((v128_t)b, (v128_t)a);
}
LMP_INLINE int vf_any_less(vf a, vf b) {
    return wasm_v128_any_true(wasm_f32x4_lt((v128_t)a, (v128_t)b));
}
#else
LMP_INLINE vf vf_sqrt(vf a) {
    return (vf)vsqrtq_f32((float32x4_t)a);
}
LMP_INLINE vf vf_max(vf a, vf b) {
    return vf_select_less(b, a, a, b);
}
LMP_INLINE vf vf_min(vf a, vf b) {
    return vf_select_less(a, b, a, b);
}
LMP_INLINE int vf_any_less(vf a, vf b) {
    return vmaxvq_u32(vcltq_f32((float32x4_t)a, (float32x4_t)b)) != 0;
}
#endif

#endif

/* s - 0 is s for every s, -0 too. */
LMP_INLINE vf vf_set(float s) {
    const vf zero = { 0 };
    return s - zero;
}
/* Towards 0; the number fits. */
LMP_INLINE vi vi_from(vf x) {
#if LMP_LANES == 1
    return (vi)x;
#else
    return __builtin_convertvector(x, vi);
#endif
}
LMP_INLINE vf vf_from(vi x) {
#if LMP_LANES == 1
    return (vf)x;
#else
    return __builtin_convertvector(x, vf);
#endif
}
LMP_INLINE vf vf_load(const float *from) {
    vf v;
    memcpy(&v, from, sizeof v);
    return v;
}
#if LMP_LANES == 4 || LMP_LANES == 8
/* Half as many, twice. */
LMP_INLINE vf vf_load_twice(const float *from) {
#if LMP_LANES == 8
    return (vf)_mm256_broadcast_ps((const __m128 *)(const void *)from);
#else
    return (vf) { from[0], from[1], from[0], from[1] };
#endif
}
#endif
/* The first `count` of them, 1 … LMP_LANES - 1; the others are 0 and not read. */
LMP_INLINE vf vf_load_first(const float *from, int count) {
#if LMP_LANES == 16
    return (vf)_mm512_maskz_loadu_ps((__mmask16)((1u << count) - 1), from);
#elif LMP_LANES == 8
    const vi lane = { 0, 1, 2, 3, 4, 5, 6, 7 };
    return (vf)_mm256_maskload_ps(from, (__m256i)(lane < count));
#elif LMP_LANES == 4
    return (vf) { from[0], count > 1 ? from[1] : 0, count > 2 ? from[2] : 0, 0 };
#else
    (void)count; /* there is no such count */
    return *from;
#endif
}
LMP_INLINE void vf_store(float *to, vf v) {
    memcpy(to, &v, sizeof v);
}
#if (LMP_LANES == 4 || LMP_LANES == 8) && defined(__SSE2__)
/* Past the caches, to an aligned address; seen by other threads after a fence. */
LMP_INLINE void vf_stream(float *to, vf v) {
#if LMP_LANES == 8
    _mm256_stream_ps(to, (__m256)v);
#else
    _mm_stream_ps(to, (__m128)v);
#endif
}
#endif
/* The first `count` of them, 1 … LMP_LANES - 1; nothing past them is written. */
LMP_INLINE void vf_store_first(float *to, vf v, int count) {
#if LMP_LANES >= 8
    /* By halves: AMD's cores take a masked store apart into dozens of operations. */
#if LMP_LANES == 16
    __m256 half = _mm512_castps512_ps256((__m512)v);
    if (count & 8) {
        _mm256_storeu_ps(to, half);
        half = _mm512_extractf32x8_ps((__m512)v, 1);
        to += 8;
    }
#else
    const __m256 half = (__m256)v;
#endif
    __m128 left = _mm256_castps256_ps128(half);
    if (count & 4) {
        _mm_storeu_ps(to, left);
        left = _mm256_extractf128_ps(half, 1);
        to += 4;
    }
    if (count & 2) {
        _mm_storel_pi((__m64 *)(void *)to, left);
        left = _mm_movehl_ps(left, left);
        to += 2;
    }
    if (count & 1)
        _mm_store_ss(to, left);
#elif LMP_LANES == 4
    to[0] = v[0];
    if (count > 1)
        to[1] = v[1];
    if (count > 2)
        to[2] = v[2];
#else
    (void)count; /* there is no such count */
    *to = v;
#endif
}

#endif
