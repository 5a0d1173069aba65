/* SPDX-License-Identifier: MIT */
/* lanes_avx.h - what AVX2 and AVX-512 share (lanes_8.h, lanes_16.h). */
#ifndef LAMPION_KERNELS_LANES_AVX_H
#define LAMPION_KERNELS_LANES_AVX_H

#include <immintrin.h>

/* The first `count` of eight lanes, 0 … 7, by halves: AMD's cores take a masked store apart into
 * dozens of operations. */
LMPI_INLINE void vf_store_first_of_eight(float *to, __m256 half, int count) {
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
}

LMPI_INLINE __m128i pair_row(const int16_t *from) {
    return _mm_loadu_si128((const __m128i *)(const void *)from);
}

#define TEXEL_PARTS     2
#define TEXEL_LANES     8
#define TEXEL_NUMBER(i) ((i) < 4 ? (i) : (i) < 8 ? (i) + 4 : (i) < 12 ? (i)-4 : (i))
typedef float texel_lanes __attribute__((vector_size(32)));
#define TEXEL_NUMBERS (TEXEL_PARTS * TEXEL_LANES)

LMPI_INLINE __m256i texel_row(const int16_t *from) {
    return _mm256_loadu_si256((const __m256i *)(const void *)from);
}
LMPI_INLINE void texel_rows(const int16_t *from, size_t row, const uint32_t weights[2],
                            texel_lanes sums[TEXEL_PARTS]) {
    const __m256i a = texel_row(from), b = texel_row(from + row);
    const __m256i c = texel_row(from + 2 * row), d = texel_row(from + 3 * row);
    const __m256i ab = _mm256_set1_epi32((int)weights[0]), cd = _mm256_set1_epi32((int)weights[1]);
    const __m256i low = _mm256_add_epi32(_mm256_madd_epi16(_mm256_unpacklo_epi16(a, b), ab),
                                         _mm256_madd_epi16(_mm256_unpacklo_epi16(c, d), cd));
    const __m256i high = _mm256_add_epi32(_mm256_madd_epi16(_mm256_unpackhi_epi16(a, b), ab),
                                          _mm256_madd_epi16(_mm256_unpackhi_epi16(c, d), cd));
    sums[0] = (texel_lanes)_mm256_cvtepi32_ps(low);
    sums[1] = (texel_lanes)_mm256_cvtepi32_ps(high);
}
LMPI_INLINE void texel_columns(const float *weights, texel_lanes columns[TEXEL_PARTS]) {
    const __m256 four = _mm256_broadcast_ps((const __m128 *)(const void *)weights);
    columns[0] = (texel_lanes)_mm256_permutevar_ps(four, _mm256_setr_epi32(0, 0, 0, 1, 2, 3, 3, 3));
    columns[1] = (texel_lanes)_mm256_permutevar_ps(four, _mm256_setr_epi32(1, 1, 2, 2, 0, 0, 0, 0));
}

#endif
