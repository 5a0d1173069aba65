/* SPDX-License-Identifier: MIT */
#include "app/scene/trace/blend.h"

static uint32_t scramble(uint32_t h) {
    h = ((h >> ((h >> 28) + 4)) ^ h) * 277803737u;
    return h ^ h >> 22;
}

/* The side of a square of pixels with distinct first ranks, so that with 8 samples each of them
 * sees each surface somewhere in the square; shadows of other pixels are looked up there
 * (app/render/shadow/reuse.h). */
enum { SQUARE = 3 };

blend_part blend_begin(uint32_t x, uint32_t y, uint32_t sample, uint32_t samples) {
    const uint32_t first = x % SQUARE + SQUARE * (y % SQUARE);
    const uint32_t hash = scramble(scramble(x * 1664525u + y * 1013904223u) + 1);
    return (blend_part) { .rank = (sample + first) % samples,
                          .count = samples,
                          .dice = (float)(hash >> 8) / 16777216.0f,
                          .weight = 1 };
}

bool blend_sees(blend_part *s, float alpha) {
    const float count = (float)s->count;
    if (!(alpha > 0) || alpha >= 1)
        return alpha >= 1;
    s->blended = true;
    if (s->count == 1 && s->dice < alpha)
        return true;
    if (s->count == 1) {
        s->dice = (s->dice - alpha) / (1 - alpha);
        return false;
    }
    /* half of what alpha asks for, so that samples remain for deeper surfaces */
    const uint32_t wanted = (uint32_t)(0.5f * alpha * count + 0.5f);
    const uint32_t seeing = wanted < 1 ? 1 : wanted;
    if (s->rank < seeing) {
        s->weight *= alpha * count / (float)seeing;
        return true;
    }
    s->weight *= (1 - alpha) * count / (float)(s->count - seeing);
    s->rank -= seeing;
    s->count -= seeing;
    return false;
}
