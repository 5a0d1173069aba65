/* SPDX-License-Identifier: MIT */
/* lanes_16.h - sixteen lanes: AVX-512 (lanes.h). */
#ifndef LAMPION_KERNELS_LANES_16_H
#define LAMPION_KERNELS_LANES_16_H

#include "src/kernels/lanes_avx.h"

#define LMPI_OPAQUE_LANES(v) __asm__("" : "+v"(v))
#define LMPI_STREAMS         0 /* AVX2 streams faster, because streaming waits for memory */

LMPI_INLINE vf vf_sqrt(vf a) {
    return (vf)_mm512_sqrt_ps((__m512)a);
}
LMPI_INLINE vf vf_max(vf a, vf b) {
    return (vf)_mm512_max_ps((__m512)a, (__m512)b);
}
LMPI_INLINE vf vf_min(vf a, vf b) {
    return (vf)_mm512_min_ps((__m512)a, (__m512)b);
}
LMPI_INLINE int vf_any_less(vf a, vf b) {
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ) != 0;
}
LMPI_INLINE vd vd_max(vd a, vd b) {
    return (vd)_mm512_max_pd((__m512d)a, (__m512d)b);
}
LMPI_INLINE int vd_any_less(vd a, vd b) {
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ) != 0;
}
LMPI_INLINE vh vh_per_root(vh a) {
    return (vh)_mm256_div_ps(_mm256_set1_ps(1), _mm256_sqrt_ps((__m256)a));
}
LMPI_INLINE vd vd_from(vh x) {
    return (vd)_mm512_cvtps_pd((__m256)x);
}
LMPI_INLINE vh vh_from(vd x) {
    return (vh)_mm512_cvtpd_ps((__m512d)x);
}

LMPI_INLINE vf vf_load_first(const float *from, int count) {
    return (vf)_mm512_maskz_loadu_ps((__mmask16)((1u << count) - 1), from);
}
LMPI_INLINE void vf_store_first(float *to, vf v, int count) {
    __m256 half = _mm512_castps512_ps256((__m512)v);
    if (count & 8) {
        _mm256_storeu_ps(to, half);
        half = _mm512_extractf32x8_ps((__m512)v, 1);
        to += 8;
    }
    vf_store_first_of_eight(to, half, count);
}

typedef float vf_number;
#define vf_number_of(number)    (number)
#define vf_number_lanes(number) vf_set(number)

#define LMPI_SHUFFLE(a, b, i, j, k, l)                                                             \
    __builtin_shufflevector(a, b, i, j, 16 + (k), 16 + (l), 4 + (i), 4 + (j), 20 + (k), 20 + (l),  \
                            8 + (i), 8 + (j), 24 + (k), 24 + (l), 12 + (i), 12 + (j), 28 + (k),    \
                            28 + (l))

LMPI_INLINE vf vf_join(const vf4 *quarters) {
    __m512 v = _mm512_castps128_ps512((__m128)quarters[0]);
    v = _mm512_insertf32x4(v, (__m128)quarters[1], 1);
    v = _mm512_insertf32x4(v, (__m128)quarters[2], 2);
    return (vf)_mm512_insertf32x4(v, (__m128)quarters[3], 3);
}

LMPI_INLINE void half_pack(const float *from, uint16_t *to) {
    const __m256i halves = _mm512_cvtps_ph(_mm512_loadu_ps(from), _MM_FROUND_TO_NEAREST_INT);
    memcpy(to, &halves, sizeof halves);
}
LMPI_INLINE void half_unpack(const uint16_t *from, float *to) {
    __m256i halves;
    memcpy(&halves, from, sizeof halves);
    _mm512_storeu_ps(to, _mm512_cvtph_ps(halves));
}

LMPI_INLINE vf pair_products(const int16_t *const *from, vf columns) {
    const __m256i low = _mm256_set_m128i(pair_row(from[4]), pair_row(from[0]));
    const __m256i high = _mm256_set_m128i(pair_row(from[12]), pair_row(from[8]));
    const __m256i first = _mm256_madd_epi16(low, _mm512_castsi512_si256((__m512i)columns));
    const __m256i second = _mm256_madd_epi16(high, _mm512_extracti64x4_epi64((__m512i)columns, 1));
    return (vf)_mm512_inserti64x4(_mm512_castsi256_si512(first), second, 1);
}

#endif
