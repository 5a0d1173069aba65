/* SPDX-License-Identifier: MIT */
/* half.h - floats as 16 bits and back, by the CPU's own conversions where there are: the bits of
 * src/base/half.h. */
#ifndef LAMPION_KERNELS_HALF_H
#define LAMPION_KERNELS_HALF_H

#include "src/base/half.h"
#include "src/kernels/lanes.h"

#if LMP_LANES == 16
LMP_INLINE void half_pack(const float *from, uint16_t *to) {
    const __m256i halves = _mm512_cvtps_ph(_mm512_loadu_ps(from), _MM_FROUND_TO_NEAREST_INT);
    memcpy(to, &halves, sizeof halves);
}
LMP_INLINE void half_unpack(const uint16_t *from, float *to) {
    __m256i halves;
    memcpy(&halves, from, sizeof halves);
    _mm512_storeu_ps(to, _mm512_cvtph_ps(halves));
}
#elif LMP_LANES == 8
LMP_INLINE void half_pack(const float *from, uint16_t *to) {
    const __m128i halves = _mm256_cvtps_ph(_mm256_loadu_ps(from), _MM_FROUND_TO_NEAREST_INT);
    memcpy(to, &halves, sizeof halves);
}
LMP_INLINE void half_unpack(const uint16_t *from, float *to) {
    __m128i halves;
    memcpy(&halves, from, sizeof halves);
    _mm256_storeu_ps(to, _mm256_cvtph_ps(halves));
}
#elif LMP_LANES == 4
typedef int16_t half_lanes __attribute__((vector_size(8)));

LMP_INLINE vi half_select(vi mask, vi yes, vi no) {
    return (mask & yes) | (~mask & no);
}
LMP_INLINE void half_pack(const float *from, uint16_t *to) {
    const vi bits = (vi)vf_load(from), size = bits & 0x7fffffff, sign = (bits >> 16) & 0x8000;
    const vi normal = (size - 0x38000000 + 0xfff + ((size >> 13) & 1)) >> 13;
    const vi subnormal = (vi)((vf)size + 0.5f) - 0x3f000000;
    const vi infinite = (vi) { 0 } + (int)LMP_HALF_INFINITE;
    const vi nan = infinite | (int)LMP_HALF_QUIET | ((size >> 13) & 0x3ff);
    vi half = half_select(size < (int)LMP_HALF_FLOAT_NORMAL, subnormal, normal);
    half = half_select(size < (int)LMP_HALF_FLOAT_ABOVE, half, infinite);
    half = half_select(size > (int)LMP_HALF_FLOAT_INFINITE, nan, half);
    const half_lanes halves = __builtin_convertvector(sign | half, half_lanes);
    memcpy(to, &halves, sizeof halves);
}
LMP_INLINE void half_unpack(const uint16_t *from, float *to) {
    half_lanes halves;
    memcpy(&halves, from, sizeof halves);
    const vi half = __builtin_convertvector(halves, vi), size = half & 0x7fff;
    vi bits = (vi)((vf)(size << 13) * 0x1p112f);
    bits |= (size >= (int)LMP_HALF_INFINITE) & (int)LMP_HALF_FLOAT_INFINITE;
    bits |= (size > (int)LMP_HALF_INFINITE) & (int)(LMP_HALF_QUIET << 13);
    bits |= half & (int)0x80000000u;
    vf_store(to, (vf)bits);
}
#else
LMP_INLINE void half_pack(const float *from, uint16_t *to) {
    *to = lmp_half_of_float(*from);
}
LMP_INLINE void half_unpack(const uint16_t *from, float *to) {
    *to = lmp_float_of_half(*from);
}
#endif

static void kernel_pack_half(const float *values, size_t count, uint16_t *halves) {
    size_t i = 0;
    for (; i + LMP_LANES <= count; i += LMP_LANES)
        half_pack(values + i, halves + i);
    for (; i < count; i++)
        halves[i] = lmp_half_of_float(values[i]);
}

static void kernel_unpack_half(const uint16_t *halves, size_t count, float *values) {
    size_t i = 0;
    for (; i + LMP_LANES <= count; i += LMP_LANES)
        half_unpack(halves + i, values + i);
    for (; i < count; i++)
        values[i] = lmp_float_of_half(halves[i]);
}

#endif
