/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/reuse.h"

#include <math.h>

/* Of what arrives, and of all. */
typedef struct shadow_sum {
    float unhidden[3], all[3];
} shadow_sum;

/* Whether a pixel of the planes lies on the surface of one of the row. */
static bool is_alike(const shadow_planes *p, size_t pixel, const render_tile *row, int x) {
    float off = 0, facing = 0;
    for (int c = 0; c < 3; c++) {
        off += row->normal[c][x] * (p->position[c][pixel] - row->position[c][x]);
        facing += row->normal[c][x] * p->normal[c][pixel];
    }
    return facing > 0.8f && fabsf(off) < p->footprint[pixel];
}

static void add(const shadow_planes *p, size_t pixel, shadow_sum *sum) {
    for (int c = 0; c < 3; c++) {
        sum->unhidden[c] += p->values[SHADOW_UNHIDDEN + c][pixel];
        sum->all[c] += p->values[SHADOW_ALL + c][pixel];
    }
}

/* Of the pixels around it, those on its surface, or all. */
static void add_around(const shadow_planes *p, const render_tile *row, int x, int y, bool alike,
                       shadow_sum *sum) {
    for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < p->height; j++)
        for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < p->width; i++) {
            const size_t pixel = (size_t)j * (size_t)p->width + (size_t)i;
            if (!alike || is_alike(p, pixel, row, x))
                add(p, pixel, sum);
        }
}

void shadow_reuse_row(const shadow_planes *p, const render_tile *row, int y, float *rgba) {
    for (int x = 0; x < p->width; x++) {
        const size_t pixel = (size_t)y * (size_t)p->width + (size_t)x;
        shadow_sum sum = { { 0 }, { 0 } };
        if (row->kind[x] != RENDER_SURFACE)
            continue;
        if (is_alike(p, pixel, row, x))
            add(p, pixel, &sum);
        else
            add_around(p, row, x, y, true, &sum);
        if (!(sum.all[0] + sum.all[1] + sum.all[2] > 0))
            add_around(p, row, x, y, false, &sum);
        for (int c = 0; c < 3; c++) {
            float *radiance = &rgba[4 * pixel + (size_t)c];
            const float emission = row->emission[c][x];
            if (sum.unhidden[c] < sum.all[c])
                *radiance = emission + (*radiance - emission) * sum.unhidden[c] / sum.all[c];
        }
    }
}
