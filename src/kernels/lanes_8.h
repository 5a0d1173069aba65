/* SPDX-License-Identifier: MIT */
/* lanes_8.h - eight lanes: AVX2 (lanes.h). */
#ifndef LAMPION_KERNELS_LANES_8_H
#define LAMPION_KERNELS_LANES_8_H

#include "src/kernels/lanes_avx.h"

#define LMPI_OPAQUE_LANES(v) __asm__("" : "+x"(v))
#define LMPI_STREAMS         1

LMPI_INLINE vf vf_sqrt(vf a) {
    return (vf)_mm256_sqrt_ps((__m256)a);
}
LMPI_INLINE vf vf_max(vf a, vf b) {
    return (vf)_mm256_max_ps((__m256)a, (__m256)b);
}
LMPI_INLINE vf vf_min(vf a, vf b) {
    return (vf)_mm256_min_ps((__m256)a, (__m256)b);
}
LMPI_INLINE int vf_any_less(vf a, vf b) {
    return _mm256_movemask_ps(_mm256_cmp_ps((__m256)a, (__m256)b, _CMP_LT_OQ)) != 0;
}
LMPI_INLINE vd vd_max(vd a, vd b) {
    return (vd)_mm256_max_pd((__m256d)a, (__m256d)b);
}
LMPI_INLINE int vd_any_less(vd a, vd b) {
    return _mm256_movemask_pd(_mm256_cmp_pd((__m256d)a, (__m256d)b, _CMP_LT_OQ)) != 0;
}
LMPI_INLINE vh vh_per_root(vh a) {
    return (vh)_mm_div_ps(_mm_set1_ps(1), _mm_sqrt_ps((__m128)a));
}
LMPI_INLINE vd vd_from(vh x) {
    return (vd)_mm256_cvtps_pd((__m128)x);
}
LMPI_INLINE vh vh_from(vd x) {
    return (vh)_mm256_cvtpd_ps((__m256d)x);
}

LMPI_INLINE vf vf_load_twice(const float *from) {
    return (vf)_mm256_broadcast_ps((const __m128 *)(const void *)from);
}
LMPI_INLINE vf vf_load_first(const float *from, int count) {
    const vi lane = { 0, 1, 2, 3, 4, 5, 6, 7 };
    return (vf)_mm256_maskload_ps(from, (__m256i)(lane < count));
}
LMPI_INLINE void vf_store_first(float *to, vf v, int count) {
    vf_store_first_of_eight(to, (__m256)v, count);
}
LMPI_INLINE void vf_stream(float *to, vf v) {
    _mm256_stream_ps(to, (__m256)v);
}

typedef vf vf_number;
#define vf_number_of(number)    vf_set(number)
#define vf_number_lanes(number) (number)

#define LMPI_SHUFFLE(a, b, i, j, k, l)                                                             \
    __builtin_shufflevector(a, b, i, j, 8 + (k), 8 + (l), 4 + (i), 4 + (j), 12 + (k), 12 + (l))

LMPI_INLINE vf vf_join(const vf4 *quarters) {
    return (vf)_mm256_insertf128_ps(_mm256_castps128_ps256((__m128)quarters[0]),
                                    (__m128)quarters[1], 1);
}

LMPI_INLINE void half_pack(const float *from, uint16_t *to) {
    const __m128i halves = _mm256_cvtps_ph(_mm256_loadu_ps(from), _MM_FROUND_TO_NEAREST_INT);
    memcpy(to, &halves, sizeof halves);
}
LMPI_INLINE void half_unpack(const uint16_t *from, float *to) {
    __m128i halves;
    memcpy(&halves, from, sizeof halves);
    _mm256_storeu_ps(to, _mm256_cvtph_ps(halves));
}

LMPI_INLINE vf pair_products(const int16_t *const *from, vf columns) {
    return (vf)_mm256_madd_epi16(_mm256_set_m128i(pair_row(from[4]), pair_row(from[0])),
                                 (__m256i)columns);
}

#endif
