/* SPDX-License-Identifier: MIT */
/* products.h - sums of products of 16-bit coefficients and 16-bit weights, by the instructions that
 * each build has for them: integers, whose sums are exact, so that every build agrees. */
#ifndef LAMPION_KERNELS_PRODUCTS_H
#define LAMPION_KERNELS_PRODUCTS_H

#include "src/kernels/layout.h"

/* Weights are 0 … SPLINE_ONE for 0 … 1. */
#define SPLINE_ONE 32767.0f

/* --- pairs of a preintegrated lobe ------------------------------------------------------------ */

/* Of elements 0, 4, …: four sums of two products each, of a row's coefficients and their weights.
 */
#if LMP_LANES > 1 && defined(__SSE2__)
LMP_INLINE __m128i pair_row(const int16_t *from) {
    return _mm_loadu_si128((const __m128i *)(const void *)from);
}
#endif
#if LMP_LANES == 4 && defined(__SSE2__)
LMP_INLINE vf pair_products(const int16_t *const *from, vf columns) {
    return (vf)_mm_madd_epi16(pair_row(from[0]), (__m128i)columns);
}
#elif LMP_LANES == 8
LMP_INLINE vf pair_products(const int16_t *const *from, vf columns) {
    return (vf)_mm256_madd_epi16(_mm256_set_m128i(pair_row(from[4]), pair_row(from[0])),
                                 (__m256i)columns);
}
#elif LMP_LANES == 16
LMP_INLINE vf pair_products(const int16_t *const *from, vf columns) {
    const __m256i low = _mm256_set_m128i(pair_row(from[4]), pair_row(from[0]));
    const __m256i high = _mm256_set_m128i(pair_row(from[12]), pair_row(from[8]));
    const __m256i first = _mm256_madd_epi16(low, _mm512_castsi512_si256((__m512i)columns));
    const __m256i second = _mm256_madd_epi16(high, _mm512_extracti64x4_epi64((__m512i)columns, 1));
    return (vf)_mm512_inserti64x4(_mm512_castsi256_si512(first), second, 1);
}
#elif LMP_LANES > 1
LMP_INLINE vf pair_products(const int16_t *const *from, vf columns) {
    int16_t weights[2 * LMP_LANES];
    int32_t sums[LMP_LANES];
    memcpy(weights, &columns, sizeof weights);
    for (int i = 0; i < LMP_LANES; i++) {
        const int16_t *row = from[i / 4 * 4] + 2 * (i % 4);
        sums[i] = row[0] * weights[2 * i] + row[1] * weights[2 * i + 1];
    }
    vf products;
    memcpy(&products, sums, sizeof sums);
    return products;
}
#endif

/* --- texels of a preintegrated BRDF ----------------------------------------------------------- */

/* Four texels: TEXEL_PARTS registers of TEXEL_LANES. TEXEL_NUMBER(i) is the number of a row that is
 * number i of them; 12 and up are the next texel's and mean nothing. */
#if LMP_LANES >= 8
#define TEXEL_PARTS     2
#define TEXEL_LANES     8
#define TEXEL_NUMBER(i) ((i) < 4 ? (i) : (i) < 8 ? (i) + 4 : (i) < 12 ? (i)-4 : (i))
typedef float texel_lanes __attribute__((vector_size(32)));
#elif LMP_LANES == 4
#define TEXEL_PARTS     3
#define TEXEL_LANES     4
#define TEXEL_NUMBER(i) (i)
typedef vf texel_lanes;
#else
#define TEXEL_PARTS     12
#define TEXEL_LANES     1
#define TEXEL_NUMBER(i) (i)
typedef float texel_lanes;
#endif
#define TEXEL_NUMBERS (TEXEL_PARTS * TEXEL_LANES)

/* Four rows' texels, weighted: integers, whose sums are exact, so that every build agrees. */
#if LMP_LANES >= 8
LMP_INLINE __m256i texel_row(const int16_t *from) {
    return _mm256_loadu_si256((const __m256i *)(const void *)from);
}
LMP_INLINE void texel_rows(const int16_t *from, size_t row, const uint32_t weights[2],
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
LMP_INLINE void texel_columns(const float *weights, texel_lanes columns[TEXEL_PARTS]) {
    const __m256 four = _mm256_broadcast_ps((const __m128 *)(const void *)weights);
    columns[0] = (texel_lanes)_mm256_permutevar_ps(four, _mm256_setr_epi32(0, 0, 0, 1, 2, 3, 3, 3));
    columns[1] = (texel_lanes)_mm256_permutevar_ps(four, _mm256_setr_epi32(1, 1, 2, 2, 0, 0, 0, 0));
}
#elif LMP_LANES == 4 && defined(__SSE2__)
LMP_INLINE void texel_pair(const int16_t *from, size_t row, uint32_t weights, __m128i sums[3]) {
    const __m128i both = _mm_set1_epi32((int)weights);
    const __m128i a = _mm_loadu_si128((const __m128i *)(const void *)from);
    const __m128i b = _mm_loadu_si128((const __m128i *)(const void *)(from + row));
    const __m128i a8 = _mm_loadl_epi64((const __m128i *)(const void *)(from + 8));
    const __m128i b8 = _mm_loadl_epi64((const __m128i *)(const void *)(from + row + 8));
    sums[0] = _mm_madd_epi16(_mm_unpacklo_epi16(a, b), both);
    sums[1] = _mm_madd_epi16(_mm_unpackhi_epi16(a, b), both);
    sums[2] = _mm_madd_epi16(_mm_unpacklo_epi16(a8, b8), both);
}
LMP_INLINE void texel_rows(const int16_t *from, size_t row, const uint32_t weights[2],
                           texel_lanes sums[TEXEL_PARTS]) {
    __m128i upper[3], lower[3];
    texel_pair(from, row, weights[0], upper);
    texel_pair(from + 2 * row, row, weights[1], lower);
    LMP_UNROLL for (int i = 0; i < 3; i++) sums[i] =
        (texel_lanes)_mm_cvtepi32_ps(_mm_add_epi32(upper[i], lower[i]));
}
#else
LMP_INLINE void texel_rows(const int16_t *from, size_t row, const uint32_t weights[2],
                           texel_lanes sums[TEXEL_PARTS]) {
    int32_t totals[TEXEL_NUMBERS] = { 0 };
    for (int k = 0; k < 4; k++, from += row) {
        const int32_t weight = (int32_t)(weights[k / 2] >> 16 * (k % 2) & 0xffff);
        for (int i = 0; i < TEXEL_NUMBERS; i++)
            totals[i] += weight * from[i];
    }
    for (int i = 0; i < TEXEL_PARTS; i++) {
        vi part;
        memcpy(&part, totals + TEXEL_LANES * i, sizeof part);
        sums[i] = vf_from(part);
    }
}
#endif
#if LMP_LANES == 4
LMP_INLINE void texel_columns(const float *weights, texel_lanes columns[TEXEL_PARTS]) {
    const vf four = vf_load(weights);
    columns[0] = LMP_SHUFFLE(four, four, 0, 0, 0, 1);
    columns[1] = LMP_SHUFFLE(four, four, 1, 1, 2, 2);
    columns[2] = LMP_SHUFFLE(four, four, 2, 3, 3, 3);
}
#elif LMP_LANES == 1
LMP_INLINE void texel_columns(const float *weights, texel_lanes columns[TEXEL_PARTS]) {
    for (int i = 0; i < 12; i++)
        columns[i] = weights[i / 3];
}
#endif

#endif
