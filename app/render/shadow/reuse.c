/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/reuse.h"

#include <math.h>

/* Sums of arriving light and of unblocked light. */
typedef struct shadow_sum {
    float unhidden[3], all[3];
} shadow_sum;

/* Whether a pixel of the planes lies on the same surface as one of the tile. */
static bool is_alike(const shadow_planes *p, size_t pixel, const render_tile *tile, size_t at) {
    float off = 0, facing = 0;
    for (int c = 0; c < 3; c++) {
        off += tile->normal[c][at] * (p->position[c][pixel] - tile->position[c][at]);
        facing += tile->normal[c][at] * p->normal[c][pixel];
    }
    return facing > 0.8f && fabsf(off) < p->footprint[pixel];
}

static void add(const shadow_planes *p, size_t pixel, shadow_sum *sum) {
    for (int c = 0; c < 3; c++) {
        sum->unhidden[c] += shadow_planes_sum(p, SHADOW_UNHIDDEN + c, pixel);
        sum->all[c] += shadow_planes_sum(p, SHADOW_ALL + c, pixel);
    }
}

/* Adds the pixels around one: those on its surface, or all. */
static void add_around(const shadow_planes *p, const render_tile *tile, size_t at, int x, int y,
                       bool alike, shadow_sum *sum) {
    for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < p->height; j++)
        for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < p->width; i++) {
            const size_t pixel = (size_t)j * (size_t)p->width + (size_t)i;
            if (!alike || is_alike(p, pixel, tile, at))
                add(p, pixel, sum);
        }
}

void shadow_reuse_row(const shadow_planes *p, const render_tile *tile, size_t at, int x, int y,
                      int count, float *rgba) {
    const size_t first = (size_t)y * (size_t)p->width + (size_t)x;
    for (int i = 0; i < count; i++) {
        const size_t pixel = first + (size_t)i, own = at + (size_t)i;
        shadow_sum sum = { { 0 }, { 0 } };
        if (tile->kind[own] != RENDER_SURFACE)
            continue;
        if (is_alike(p, pixel, tile, own))
            add(p, pixel, &sum);
        else
            add_around(p, tile, own, x + i, y, true, &sum);
        if (!(sum.all[0] + sum.all[1] + sum.all[2] > 0))
            add_around(p, tile, own, x + i, y, false, &sum);
        for (int c = 0; c < 3; c++) {
            float *radiance = &rgba[4 * i + c];
            const float emission = tile->emission[c][own];
            if (sum.unhidden[c] < sum.all[c])
                *radiance = emission + (*radiance - emission) * sum.unhidden[c] / sum.all[c];
        }
    }
}
