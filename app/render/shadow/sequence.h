/* SPDX-License-Identifier: MIT */
/* sequence.h - the random numbers of a pixel's rays. Pixels are numbered along a Morton curve and
 * share one low-discrepancy sequence, in which the rays of each pixel follow those of the pixel
 * before: so the rays of every square of pixels, which a filter combines, are as evenly distributed
 * as those of one pixel. At each of its forks the curve takes one side first at random, because
 * numbers that come back at regular distances would show (Ahmed and Wonka 2020). Owen scrambling by
 * Laine and Karras's hash (Burley 2020). */
#ifndef LAMPION_RENDER_SHADOW_SEQUENCE_H
#define LAMPION_RENDER_SHADOW_SEQUENCE_H

#include <stdint.h>

static inline uint32_t shadow_hash(uint32_t a, uint32_t b) {
    uint32_t x = a * 0x9e3779b9u ^ b;
    x = (x ^ x >> 16) * 0x21f0aaadu;
    x = (x ^ x >> 15) * 0x735a2d97u;
    return x ^ x >> 15;
}

/* Halves are swapped last, apart from bytes: both at once would be an instruction that vectors do
 * not always have, and keep loops from being vectorized. */
static inline uint32_t shadow_reverse(uint32_t x) {
    x = (x & 0xff00ff00u) >> 8 | (x & 0x00ff00ffu) << 8;
    x = (x & 0xf0f0f0f0u) >> 4 | (x & 0x0f0f0f0fu) << 4;
    x = (x & 0xccccccccu) >> 2 | (x & 0x33333333u) << 2;
    x = (x & 0xaaaaaaaau) >> 1 | (x & 0x55555555u) << 1;
    return x >> 16 | x << 16;
}

/* Flips every bit or not by a hash of the bits above it. */
static inline uint32_t shadow_scramble(uint32_t x, uint32_t seed) {
    x = shadow_reverse(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= seed >> 16 | 1;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return shadow_reverse(x);
}

static inline float shadow_unit(uint32_t x) {
    return (float)(int32_t)(x >> 8) * 0x1p-24f;
}

/* Returns the second dimension of Sobol's sequence: Pascal's triangle modulo 2, a product of sparse
 * matrices, times the first dimension, which is the reversed index. */
static inline uint32_t shadow_sobol(uint32_t index) {
    uint32_t x = shadow_reverse(index);
    x ^= (x & 0x55555555u) << 1;
    x ^= (x & 0x33333333u) << 2;
    x ^= (x & 0x0f0f0f0fu) << 4;
    x ^= (x & 0x00ff00ffu) << 8;
    return x ^ x << 16;
}

static inline uint32_t shadow_spread(uint32_t x) {
    x = (x | x << 8) & 0x00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0fu;
    x = (x | x << 2) & 0x33333333u;
    return (x | x << 1) & 0x55555555u;
}

/* Gathers the even bits of a number below 1024: its x coordinate on the Morton curve. */
static inline uint32_t shadow_column(uint32_t n) {
    uint32_t x = n & 0x155;
    x = (x | x >> 1) & 0x133;
    x = (x | x >> 2) & 0x10f;
    return (x | x >> 4) & 0x1f;
}

/* A pixel's first index in the sequence, and its scrambling, one for each square of SHADOW_TILE
 * pixels. */
enum { SHADOW_TILE = 1024 };
typedef struct shadow_sequence {
    uint32_t first, seed;
} shadow_sequence;

static inline shadow_sequence shadow_sequence_of(uint32_t x, uint32_t y, uint32_t rays,
                                                 uint32_t seed) {
    const uint32_t morton = shadow_spread(x % SHADOW_TILE) | shadow_spread(y % SHADOW_TILE) << 1;
    const uint32_t tile = shadow_hash(seed, shadow_hash(x / SHADOW_TILE, y / SHADOW_TILE));
    /* 20 bits, of which each is flipped or not by those above it */
    const uint32_t number = shadow_scramble(morton << 12, shadow_hash(tile, 4)) >> 12;
    return (shadow_sequence) { number * rays, tile };
}

/* Draws three numbers in 0 … 1 for ray number `ray`: one to choose the light, two for the position
 * on it. */
static inline void shadow_draw(const shadow_sequence *s, uint32_t ray, float u[3]) {
    const uint32_t index = s->first + ray, seed = s->seed;
    const uint32_t shuffled = shadow_scramble(index, shadow_hash(seed, 3));
    u[0] = shadow_unit(shadow_scramble(shadow_reverse(shuffled), shadow_hash(seed, 0)));
    u[1] = shadow_unit(shadow_scramble(shadow_reverse(index), shadow_hash(seed, 1)));
    u[2] = shadow_unit(shadow_scramble(shadow_sobol(index), shadow_hash(seed, 2)));
}

#endif
