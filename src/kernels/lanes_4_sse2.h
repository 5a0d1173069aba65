/* SPDX-License-Identifier: MIT */
/* lanes_4_sse2.h - what SSE2 does in its own way (lanes_4.h). */
#ifndef LAMPION_KERNELS_LANES_4_SSE2_H
#define LAMPION_KERNELS_LANES_4_SSE2_H

#include <immintrin.h>

#define LMPI_OPAQUE_LANES(v) __asm__("" : "+x"(v))
#define LMPI_STREAMS         1

LMPI_INLINE vf vf_sqrt(vf a) {
    return (vf)_mm_sqrt_ps((__m128)a);
}
LMPI_INLINE vf vf_max(vf a, vf b) {
    return (vf)_mm_max_ps((__m128)a, (__m128)b);
}
LMPI_INLINE vf vf_min(vf a, vf b) {
    return (vf)_mm_min_ps((__m128)a, (__m128)b);
}
LMPI_INLINE int vf_any_less(vf a, vf b) {
    return _mm_movemask_ps(_mm_cmplt_ps((__m128)a, (__m128)b)) != 0;
}
LMPI_INLINE vd vd_max(vd a, vd b) {
    return (vd)_mm_max_pd((__m128d)a, (__m128d)b);
}
LMPI_INLINE int vd_any_less(vd a, vd b) {
    return _mm_movemask_pd(_mm_cmplt_pd((__m128d)a, (__m128d)b)) != 0;
}

LMPI_INLINE void vf_stream(float *to, vf v) {
    _mm_stream_ps(to, (__m128)v);
}

LMPI_INLINE void vf4_per_root(const vf4 *of, vf4 *per) {
    *per = (vf4)_mm_div_ps(_mm_set1_ps(1), _mm_sqrt_ps((__m128)*of));
}

LMPI_INLINE __m128i pair_row(const int16_t *from) {
    return _mm_loadu_si128((const __m128i *)(const void *)from);
}
LMPI_INLINE vf pair_products(const int16_t *const *from, vf columns) {
    return (vf)_mm_madd_epi16(pair_row(from[0]), (__m128i)columns);
}

#define TEXEL_PARTS     3
#define TEXEL_LANES     4
#define TEXEL_NUMBER(i) (i)
typedef vf texel_lanes;
#define TEXEL_NUMBERS (TEXEL_PARTS * TEXEL_LANES)

LMPI_INLINE void texel_pair(const int16_t *from, size_t row, uint32_t weights, __m128i sums[3]) {
    const __m128i both = _mm_set1_epi32((int)weights);
    const __m128i a = _mm_loadu_si128((const __m128i *)(const void *)from);
    const __m128i b = _mm_loadu_si128((const __m128i *)(const void *)(from + row));
    const __m128i a8 = _mm_loadl_epi64((const __m128i *)(const void *)(from + 8));
    const __m128i b8 = _mm_loadl_epi64((const __m128i *)(const void *)(from + row + 8));
    sums[0] = _mm_madd_epi16(_mm_unpacklo_epi16(a, b), both);
    sums[1] = _mm_madd_epi16(_mm_unpackhi_epi16(a, b), both);
    sums[2] = _mm_madd_epi16(_mm_unpacklo_epi16(a8, b8), both);
}
LMPI_INLINE void texel_rows(const int16_t *from, size_t row, const uint32_t weights[2],
                            texel_lanes sums[TEXEL_PARTS]) {
    __m128i upper[3], lower[3];
    texel_pair(from, row, weights[0], upper);
    texel_pair(from + 2 * row, row, weights[1], lower);
    LMPI_UNROLL for (int i = 0; i < 3; i++) sums[i] =
        (texel_lanes)_mm_cvtepi32_ps(_mm_add_epi32(upper[i], lower[i]));
}

#endif
