/* SPDX-License-Identifier: MIT */
/* random.h - the program's own random numbers, the same on any machine: SplitMix64. */
#ifndef LAMPION_SCENE_RANDOM_H
#define LAMPION_SCENE_RANDOM_H

#include <stdint.h>

static inline uint64_t random_bits(uint64_t *state) {
    uint64_t x = *state += 0x9e3779b97f4a7c15u;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

/* Returns a number uniform in [0, 1): 24 bits, exact in float. */
static inline float random_unit(uint64_t *state) {
    return (float)(random_bits(state) >> 40) * 0x1p-24f;
}

static inline float random_between(uint64_t *state, float from, float to) {
    return from + (to - from) * random_unit(state);
}

#endif
