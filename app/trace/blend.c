/* SPDX-License-Identifier: MIT */
#include "app/trace/blend.h"

static uint32_t scramble(uint32_t h) {
    h = ((h >> ((h >> 28) + 4)) ^ h) * 277803737u;
    return h ^ h >> 22;
}

/* Of all numbers below `count` a different one for each i, by a permutation that p chooses (Kensler
 * 2013). */
static uint32_t permute(uint32_t i, uint32_t count, uint32_t p) {
    uint32_t mask = count - 1;
    for (uint32_t shift = 1; shift < 32; shift *= 2)
        mask |= mask >> shift;
    do {
        i = (i ^ p) * 0xe170893du;
        i = (i ^ p >> 16 ^ (i & mask) >> 4 ^ p >> 8) * 0x0929eb3fu;
        i = (i ^ p >> 23 ^ (i & mask) >> 1) * (1 | p >> 27) * 0x6935fa69u;
        i = (i ^ (i & mask) >> 11) * 0x74dcb303u;
        i = (i ^ (i & mask) >> 2) * 0x9e501cc3u;
        i = (i ^ (i & mask) >> 2) * 0xc860a3dfu;
        i &= mask;
        i ^= i >> 5;
    } while (i >= count);
    return (i + p) % count;
}

float blend_threshold(uint32_t key, uint32_t sample, uint32_t samples) {
    const uint32_t p = scramble(key);
    const float within = (float)(scramble(p + 1) >> 8) / 16777216.0f;
    return ((float)permute(sample, samples, p) + within) / (float)samples;
}
