/* SPDX-License-Identifier: MIT */
/* lanes_4.h - four lanes: SSE2, NEON or WebAssembly (lanes.h). */
#ifndef LAMPION_KERNELS_LANES_4_H
#define LAMPION_KERNELS_LANES_4_H

#if defined(__SSE2__)
#include "src/kernels/lanes_4_sse2.h"
#elif defined(__wasm_simd128__)
#include "src/kernels/lanes_4_wasm.h"
#else
#include "src/kernels/lanes_4_neon.h"
#endif

LMPI_INLINE vf vf_load_twice(const float *from) {
    return (vf) { from[0], from[1], from[0], from[1] };
}
LMPI_INLINE vf vf_load_first(const float *from, int count) {
    return (vf) { from[0], count > 1 ? from[1] : 0, count > 2 ? from[2] : 0, 0 };
}
LMPI_INLINE void vf_store_first(float *to, vf v, int count) {
    to[0] = v[0];
    if (count > 1)
        to[1] = v[1];
    if (count > 2)
        to[2] = v[2];
}

typedef vf vf_number;
#define vf_number_of(number)    vf_set(number)
#define vf_number_lanes(number) (number)

LMPI_INLINE vh vh_per_root(vh a) {
    const vf4 of = { a[0], a[1], 1, 1 };
    vf4 per;
    vf4_per_root(&of, &per);
    return (vh) { per[0], per[1] };
}
LMPI_INLINE vd vd_from(vh x) {
    return __builtin_convertvector(x, vd);
}
LMPI_INLINE vh vh_from(vd x) {
    return __builtin_convertvector(x, vh);
}

#define LMPI_SHUFFLE(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, 4 + (k), 4 + (l))

LMPI_INLINE vf vf_join(const vf4 *quarters) {
    return quarters[0];
}

typedef int16_t half_lanes __attribute__((vector_size(8)));

LMPI_INLINE vi half_select(vi mask, vi yes, vi no) {
    return (mask & yes) | (~mask & no);
}
LMPI_INLINE void half_pack(const float *from, uint16_t *to) {
    const vi bits = (vi)vf_load(from), size = bits & 0x7fffffff, sign = (bits >> 16) & 0x8000;
    const vi normal = (size - 0x38000000 + 0xfff + ((size >> 13) & 1)) >> 13;
    const vi subnormal = (vi)((vf)size + 0.5f) - 0x3f000000;
    const vi infinite = (vi) { 0 } + (int)LMPI_HALF_INFINITE;
    const vi nan = infinite | (int)LMPI_HALF_QUIET | ((size >> 13) & 0x3ff);
    vi half = half_select(size < (int)LMPI_HALF_FLOAT_NORMAL, subnormal, normal);
    half = half_select(size < (int)LMPI_HALF_FLOAT_ABOVE, half, infinite);
    half = half_select(size > (int)LMPI_HALF_FLOAT_INFINITE, nan, half);
    const half_lanes halves = __builtin_convertvector(sign | half, half_lanes);
    memcpy(to, &halves, sizeof halves);
}
LMPI_INLINE void half_unpack(const uint16_t *from, float *to) {
    half_lanes halves;
    memcpy(&halves, from, sizeof halves);
    const vi half = __builtin_convertvector(halves, vi), size = half & 0x7fff;
    vi bits = (vi)((vf)(size << 13) * 0x1p112f);
    bits |= (size >= (int)LMPI_HALF_INFINITE) & (int)LMPI_HALF_FLOAT_INFINITE;
    bits |= (size > (int)LMPI_HALF_INFINITE) & (int)(LMPI_HALF_QUIET << 13);
    bits |= half & (int)0x80000000u;
    vf_store(to, (vf)bits);
}

LMPI_INLINE void texel_columns(const float *weights, texel_lanes columns[TEXEL_PARTS]) {
    const vf four = vf_load(weights);
    columns[0] = LMPI_SHUFFLE(four, four, 0, 0, 0, 1);
    columns[1] = LMPI_SHUFFLE(four, four, 1, 1, 2, 2);
    columns[2] = LMPI_SHUFFLE(four, four, 2, 3, 3, 3);
}

#endif
