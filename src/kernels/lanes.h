/* SPDX-License-Identifier: MIT */
/* lanes.h - LMPI_LANES floats as one value, vf, and integers, vi, of exactly the width of the
 * instruction set: a wider type than the registers is several times slower under gcc.
 *
 * lanes_1.h, lanes_4.h, lanes_8.h and lanes_16.h hold whatever an instruction set does in its own
 * way, each all of these:
 *
 *   LMPI_OPAQUE_LANES  LMPI_OPAQUE for a register. From equal lanes gcc would multiply the number
 *                      they came from and broadcast the product, two operations for one; it would
 *                      put off a long sum's terms to its end and spill
 *   vf_sqrt, vf_max, vf_min, vf_any_less
 *   vd_max, vd_any_less, vh_per_root, vd_from, vh_from
 *                      for the doubles and as many floats of lanes_double.h: vh_per_root is
 *                      1 / sqrt, and the last two convert
 *   vf_load_first      the first `count` lanes, 1 … LMPI_LANES - 1; the others are 0 and not read
 *   vf_store_first     the first `count` lanes; nothing past them is written
 *   vf_join            a register of its quarters, by insertions: put together in memory, it would
 *                      wait for its stores
 *   vf_number          a number that is the same in every lane, as an operand in memory that costs
 *                      no instruction: AVX-512 broadcasts it as it is read, the others read it
 *                      broadcast
 *   half_pack, half_unpack
 *                      LMPI_LANES floats as 16 bits, and back
 *   texel_rows, texel_columns, TEXEL_NUMBER
 *                      described in products_tmpl.h
 *
 * and those with four lanes and more
 *
 *   LMPI_SHUFFLE       in each quarter lanes i and j of a, then k and l of b
 *   pair_products      described in products_tmpl.h
 *
 * vf_select_less is a < b ? yes : no. vi_from rounds toward 0 a number that must fit. vf_load_twice
 * loads half as many floats, twice, into four or eight lanes. Where LMPI_STREAMS is 1, vf_stream
 * stores past the caches, to an aligned address: other threads see it after a fence. */
#ifndef LAMPION_KERNELS_LANES_H
#define LAMPION_KERNELS_LANES_H

#include "src/base/half.h"
#include "src/base/unroll.h"

#include <stdint.h>
#include <string.h>

/* Hides where a pointer comes from. Constants read through it stay broadcasting memory operands;
 * otherwise the compilers hoist every one of them from the loop, and spill it as a whole vector. */
#define LMPI_OPAQUE(pointer) __asm__ volatile("" : "+r"(pointer))

#define LMPI_ALIGNED __attribute__((aligned(64)))

typedef float vf4 __attribute__((vector_size(16)));

#if LMPI_LANES == 1

typedef float vf;
typedef int32_t vi;

#define LMPI_DOUBLES 1
typedef double vd;
typedef float vh;

LMPI_INLINE vf vf_select_less(vf a, vf b, vf yes, vf no) {
    return a < b ? yes : no;
}
LMPI_INLINE vd vd_select_less(vd a, vd b, vd yes, vd no) {
    return a < b ? yes : no;
}
LMPI_INLINE vi vi_from(vf x) {
    return (vi)x;
}
LMPI_INLINE vf vf_from(vi x) {
    return (vf)x;
}

#else

typedef float vf __attribute__((vector_size(4 * LMPI_LANES)));
typedef int32_t vi __attribute__((vector_size(4 * LMPI_LANES)));

#define LMPI_DOUBLES (LMPI_LANES / 2)
typedef double vd __attribute__((vector_size(8 * LMPI_DOUBLES)));
typedef int64_t vd_mask __attribute__((vector_size(8 * LMPI_DOUBLES)));
typedef float vh __attribute__((vector_size(4 * LMPI_DOUBLES)));

LMPI_INLINE vf vf_select_less(vf a, vf b, vf yes, vf no) {
    const vi mask = (vi)(a < b);
    return (vf)((mask & (vi)yes) | (~mask & (vi)no));
}
LMPI_INLINE vd vd_select_less(vd a, vd b, vd yes, vd no) {
    const vd_mask mask = (vd_mask)(a < b);
    return (vd)((mask & (vd_mask)yes) | (~mask & (vd_mask)no));
}
LMPI_INLINE vi vi_from(vf x) {
    return __builtin_convertvector(x, vi);
}
LMPI_INLINE vf vf_from(vi x) {
    return __builtin_convertvector(x, vf);
}

#endif

/* Returns s in every lane: s - 0 is s for every s, -0 too. */
LMPI_INLINE vf vf_set(float s) {
    const vf zero = { 0 };
    return s - zero;
}
LMPI_INLINE vf vf_load(const float *from) {
    vf v;
    memcpy(&v, from, sizeof v);
    return v;
}
LMPI_INLINE void vf_store(float *to, vf v) {
    memcpy(to, &v, sizeof v);
}
/* Returns the bits of floats as integers. */
LMPI_INLINE vi vi_bits(vf v) {
    vi bits;
    memcpy(&bits, &v, sizeof bits);
    return bits;
}

#if LMPI_LANES == 1
#include "src/kernels/lanes_1.h"
#elif LMPI_LANES == 4
#include "src/kernels/lanes_4.h"
#elif LMPI_LANES == 8
#include "src/kernels/lanes_8.h"
#elif LMPI_LANES == 16
#include "src/kernels/lanes_16.h"
#endif

#include "src/kernels/lanes_double.h"

#endif
