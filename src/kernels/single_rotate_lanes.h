/* SPDX-License-Identifier: MIT */
/* single_rotate_lanes.h - the same for registers of 16 lanes: a band at once, m in lane 8 + m. Sums
 * are those of single_rotate.h term by term, and lanes without a term keep what they have. */
#ifndef LAMPION_KERNELS_SINGLE_ROTATE_LANES_H
#define LAMPION_KERNELS_SINGLE_ROTATE_LANES_H

/* Factors of a band's lanes, and of those mirrored at m = 0, for a rotation around z. */
typedef struct single_lanes {
    __m512 c, s;
} single_lanes;

/* |m| of each lane's factor lies in the lane 4 |m| + angle of 0 … 4 at `low`, of 5 at `high`. */
LMP_INLINE __m512 single_spread(__m512 low, __m512 high, int which) {
    const __m512i of = _mm512_setr_epi32(0, 0, 0, 16, 12, 8, 4, 0, 20, 0, 4, 8, 12, 16, 0, 0);
    return _mm512_permutex2var_ps(low, _mm512_add_epi32(of, _mm512_set1_epi32(which)), high);
}

LMP_INLINE __m512 single_signs(__m512 of, unsigned lanes) {
    const __m512i sign = _mm512_set1_epi32(INT32_MIN);
    return _mm512_castsi512_ps(_mm512_mask_xor_epi32(_mm512_castps_si512(of), (__mmask16)lanes,
                                                     _mm512_castps_si512(of), sign));
}

/* Four of 1 … 4, and in the other register 5, then `zero`. */
LMP_INLINE void single_join(int bands, const single_three *of, float zero, __m512 *low,
                            __m512 *high) {
    *low = _mm512_zextps128_ps512((__m128)of[1]);
    *low = _mm512_insertf32x4(*low, (__m128)of[2], 1);
    *low = _mm512_insertf32x4(*low, (__m128)of[3], 2);
    if (bands > 4)
        *low = _mm512_insertf32x4(*low, (__m128)of[4], 3);
    *high = _mm512_zextps128_ps512(bands > 5 ? (__m128)of[5] : _mm_set1_ps(zero));
    *high = _mm512_insertf32x4(*high, _mm_set1_ps(zero), 1);
}

/* m = 0 stays as it is. */
LMP_INLINE __m512 single_z(__m512 v, const single_lanes *by) {
    const __m512i mirror = _mm512_setr_epi32(0, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1);
    return _mm512_mask_add_ps(v, 0xfeff, _mm512_mul_ps(by->c, v),
                              _mm512_mul_ps(by->s, _mm512_permutexvar_ps(mirror, v)));
}

/* The lanes of a band that have so many terms. */
LMP_INLINE __mmask16 single_lanes_of(int l, int terms) {
    unsigned lanes = 0;
    LMP_UNROLL for (int m = -l; m <= l; m++) lanes |=
        lmp_table_quarter_count(l, m) >= terms ? 1u << (8 + m) : 0;
    return (__mmask16)lanes;
}

LMP_INLINE __m512 single_term(int l, int term, __m512 v) {
    return _mm512_mul_ps(
        _mm512_loadu_ps(lmp_table_quarter_terms[l - 2][term]),
        _mm512_permutexvar_ps(_mm512_loadu_si512(lmp_table_quarter_lanes[l - 2][term]), v));
}
LMP_INLINE __m512 single_quarter(int l, __m512 v) {
    __m512 sum = single_term(l, 0, v);
    sum = _mm512_mask_add_ps(sum, single_lanes_of(l, 2), sum, single_term(l, 1, v));
    if (l >= 4)
        sum = _mm512_mask_add_ps(sum, single_lanes_of(l, 3), sum, single_term(l, 2, v));
    return sum;
}

/* What lies past a band is of the next one, which is stored after it. */
LMP_INLINE void single_store(int bands, int l, __m512 v, float *rotated) {
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

LMP_INLINE void single_rotate_bands(int bands, const single_angles *angles, const float *sh,
                                    float *rotated) {
    __m512 low_c, high_c, low_s, high_s;
    single_join(bands, angles->c, 1, &low_c, &high_c);
    single_join(bands, angles->s, 0, &low_s, &high_s);
    single_lanes by[3];
    LMP_UNROLL for (int i = 0; i < 3; i++) {
        by[i].c = single_spread(low_c, high_c, i);
        by[i].s = single_spread(low_s, high_s, i);
    }
    by[0].s = single_signs(by[0].s, 0xfe00);
    by[1].s = single_signs(by[1].s, 0xfe00);
    /* X^-1 = X S: S, a half turn around x, is but signs, of l + m and of m < 0, and takes the last
     * angle to its opposite. Here those of even l. */
    by[2].c = single_signs(single_signs(by[2].c, 0x00ff), 0xaaaa);
    by[2].s = single_signs(by[2].s, 0xaaaa);
    LMP_UNROLL for (int l = 2; l < bands; l++) {
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
