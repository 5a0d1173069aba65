/* SPDX-License-Identifier: MIT */
/* single_rotate_lanes_tmpl.h - does single_bands_tmpl.h with registers of 16 lanes: a band at once,
 * with m in lane 8 + m. Sums are those of single_bands_tmpl.h term by term, and lanes without a
 * term keep their value. */
#ifndef LAMPION_KERNELS_SINGLE_ROTATE_LANES_TMPL_H
#define LAMPION_KERNELS_SINGLE_ROTATE_LANES_TMPL_H

#include "src/base/tables_few.h"
#include "src/kernels/single_angles_tmpl.h"

/* Factors for a rotation around z, of a band's lanes, and of the lanes mirrored at m = 0. */
typedef struct single_lanes {
    __m512 c, s;
} single_lanes;

/* Spreads factors to the lanes of a band: that of |m| = 0 … 4 is in lane 4 |m| + angle of `low`,
 * that of |m| = 5 in `high`. */
LMPI_INLINE __m512 single_spread(__m512 low, __m512 high, int which) {
    const __m512i of = _mm512_setr_epi32(0, 0, 0, 16, 12, 8, 4, 0, 20, 0, 4, 8, 12, 16, 0, 0);
    return _mm512_permutex2var_ps(low, _mm512_add_epi32(of, _mm512_set1_epi32(which)), high);
}

LMPI_INLINE __m512 single_signs(__m512 of, unsigned lanes) {
    const __m512i sign = _mm512_set1_epi32(INT32_MIN);
    return _mm512_castsi512_ps(_mm512_mask_xor_epi32(_mm512_castps_si512(of), (__mmask16)lanes,
                                                     _mm512_castps_si512(of), sign));
}

/* Joins the factors of m = 1 … 4 in one register, and those of 5, then `zero`, in the other. */
LMPI_INLINE void single_join(int bands, const single_three *of, float zero, __m512 *low,
                             __m512 *high) {
    *low = _mm512_zextps128_ps512((__m128)of[1]);
    *low = _mm512_insertf32x4(*low, (__m128)of[2], 1);
    *low = _mm512_insertf32x4(*low, (__m128)of[3], 2);
    if (bands > 4)
        *low = _mm512_insertf32x4(*low, (__m128)of[4], 3);
    *high = _mm512_zextps128_ps512(bands > 5 ? (__m128)of[5] : _mm_set1_ps(zero));
    *high = _mm512_insertf32x4(*high, _mm_set1_ps(zero), 1);
}

/* Rotates a band around z; m = 0 stays as it is. */
LMPI_INLINE __m512 single_z(__m512 v, const single_lanes *by) {
    const __m512i mirror = _mm512_setr_epi32(0, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1);
    return _mm512_mask_add_ps(v, 0xfeff, _mm512_mul_ps(by->c, v),
                              _mm512_mul_ps(by->s, _mm512_permutexvar_ps(mirror, v)));
}

/* Returns the lanes of a band that have at least so many terms. */
LMPI_INLINE __mmask16 single_lanes_of(int l, int terms) {
    unsigned lanes = 0;
    LMPI_UNROLL for (int m = -l; m <= l; m++) lanes |=
        lmpi_table_quarter_count(l, m) >= terms ? 1u << (8 + m) : 0;
    return (__mmask16)lanes;
}

LMPI_INLINE __m512 single_term(int l, int term, __m512 v) {
    return _mm512_mul_ps(
        _mm512_loadu_ps(lmpi_table_quarter_terms[l - 2][term]),
        _mm512_permutexvar_ps(_mm512_loadu_si512(lmpi_table_quarter_lanes[l - 2][term]), v));
}
LMPI_INLINE __m512 single_quarter(int l, __m512 v) {
    __m512 sum = single_term(l, 0, v);
    sum = _mm512_mask_add_ps(sum, single_lanes_of(l, 2), sum, single_term(l, 1, v));
    if (l >= 4)
        sum = _mm512_mask_add_ps(sum, single_lanes_of(l, 3), sum, single_term(l, 2, v));
    return sum;
}

/* Stores a band; what is stored past it belongs to the next band, which is stored afterwards. */
LMPI_INLINE void single_store(int bands, int l, __m512 v, float *rotated) {
    float *to = rotated + l * l;
    const __m512i all = _mm512_castps_si512(v);
    const __m512 from_first = _mm512_castsi512_ps(l == 2   ? _mm512_alignr_epi32(all, all, 6)
                                                  : l == 3 ? _mm512_alignr_epi32(all, all, 5)
                                                  : l == 4 ? _mm512_alignr_epi32(all, all, 4)
                                                           : _mm512_alignr_epi32(all, all, 3));
    if (l == 2)
        _mm256_storeu_ps(to, _mm512_castps512_ps256(from_first));
    else if (l + 1 < bands)
        _mm512_storeu_ps(to, from_first);
    else
        vf_store_first(to, (vf)from_first, 2 * l + 1);
}

LMPI_INLINE void single_rotate_bands(int bands, const single_angles *angles, const float *sh,
                                     float *rotated) {
    __m512 low_c, high_c, low_s, high_s;
    single_join(bands, angles->c, 1, &low_c, &high_c);
    single_join(bands, angles->s, 0, &low_s, &high_s);
    single_lanes by[3];
    LMPI_UNROLL for (int i = 0; i < 3; i++) {
        by[i].c = single_spread(low_c, high_c, i);
        by[i].s = single_spread(low_s, high_s, i);
    }
    by[0].s = single_signs(by[0].s, 0xfe00);
    by[1].s = single_signs(by[1].s, 0xfe00);
    /* X^-1 = X S: the half turn S around x only changes signs, of l + m and of m < 0, and reverses
     * the last angle. These are the signs of even l. */
    by[2].c = single_signs(single_signs(by[2].c, 0x00ff), 0xaaaa);
    by[2].s = single_signs(by[2].s, 0xaaaa);
    LMPI_UNROLL for (int l = 2; l < bands; l++) {
        const __mmask16 lanes = (__mmask16)(((1u << (2 * l + 1)) - 1) << (8 - l));
        __m512 v = _mm512_maskz_loadu_ps(lanes, sh + l * (l + 1) - 8);
        v = single_quarter(l, single_z(v, &by[0]));
        v = single_quarter(l, single_z(v, &by[1]));
        const single_lanes last = { single_signs(by[2].c, l % 2 ? 0xffff : 0),
                                    single_signs(by[2].s, l % 2 ? 0xffff : 0) };
        v = single_z(single_signs(v, l % 2 ? 0x0100 : 0), &last);
        single_store(bands, l, v, rotated);
    }
}

#endif
