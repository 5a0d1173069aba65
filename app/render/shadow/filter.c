/* SPDX-License-Identifier: MIT */
/* filter.c - small kernels whose taps move apart from pass to pass (à trous, Dammertz 2010). */
#include "app/render/shadow/planes.h"
#include "app/trace/wide.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What one pass mixes: values of `count` planes from `first` on. */
typedef struct filter_pass {
    shadow_planes *planes;
    int first, count, step;
    float narrowing; /* how much less far than shadows are even; 0: however far */
} filter_pass;

/* Neighbors this far off the plane of a pixel, in distances to it and in pixels' widths, are of
 * another surface. */
static const float off_plane = 0.15f, off_pixel = 1;

/* What is hidden differs by so much on the two sides of an edge, not by noise. */
static const float jump = 0.25f;
static const float tiny = 1e-30f;

/* Planes are mixed in blocks of so many pixels a row and so many rows, whose taps stay in a core's
 * cache. */
enum { BLOCK = 256, BLOCK_ROWS = 64 };

/* A row of a block, and its values as they are summed. */
typedef struct block {
    size_t row; /* its row's first pixel */
    int begin, end;
    float weights[BLOCK], total[BLOCK], sums[SHADOW_VALUES][BLOCK];
} block;

/* Where the taps at an offset of the block's pixels begin ≤ x < end lie. */
typedef struct span {
    size_t pixel, tap; /* of the first */
    int skipped, count;
} span;

static span span_of(const shadow_planes *p, const block *b, int dx, int dy) {
    const int begin = b->begin + dx < 0 ? -dx : b->begin;
    const int end = b->end + dx > p->width ? p->width - dx : b->end;
    const size_t pixel = b->row + (size_t)begin;
    return (span) { pixel, (size_t)((ptrdiff_t)pixel + dy * p->width + dx), begin - b->begin,
                    end - begin };
}

/* Without a branch, so that loops become vectors. */
static float positive(float x) {
    return 0.5f * (x + fabsf(x));
}

/* How far taps at an offset count: not where the shadow may have changed much on the way, by the
 * slopes here, nor where it has. */
static void weigh(const filter_pass *pass, const span *at, float kernel, float *restrict weights) {
    const shadow_planes *p = pass->planes;
    const float *restrict px = p->position[0] + at->pixel, *restrict qx = p->position[0] + at->tap;
    const float *restrict py = p->position[1] + at->pixel, *restrict qy = p->position[1] + at->tap;
    const float *restrict pz = p->position[2] + at->pixel, *restrict qz = p->position[2] + at->tap;
    const float *restrict nx = p->normal[0] + at->pixel, *restrict mx = p->normal[0] + at->tap;
    const float *restrict ny = p->normal[1] + at->pixel, *restrict my = p->normal[1] + at->tap;
    const float *restrict nz = p->normal[2] + at->pixel, *restrict mz = p->normal[2] + at->tap;
    const float *restrict footprint = p->footprint + at->pixel;
    const float *restrict slope = p->values[SHADOW_SLOPE] + at->pixel;
    const float *restrict hidden = p->values[SHADOW_HIDDEN] + at->pixel;
    const float *restrict tap_hidden = p->values[SHADOW_HIDDEN] + at->tap;
    const float steep = pass->narrowing, sudden = sqrtf(pass->narrowing) / jump;
    for (int x = 0; x < at->count; x++) {
        const float dx = qx[x] - px[x], dy = qy[x] - py[x], dz = qz[x] - pz[x];
        const float d2 = dx * dx + dy * dy + dz * dz, pixel = footprint[x] * off_pixel;
        const float off = nx[x] * dx + ny[x] * dy + nz[x] * dz;
        const float most = off_plane * off_plane * d2 + pixel * pixel;
        const float facing = positive(nx[x] * mx[x] + ny[x] * my[x] + nz[x] * mz[x]);
        const float change = steep * d2 * slope[x] * slope[x];
        const float apart = sudden * (hidden[x] - tap_hidden[x]), apart2 = apart * apart;
        const float apart4 = apart2 * apart2, uneven = 1 + change * change + apart4 * apart4;
        weights[x] = kernel * facing * facing * positive(most - off * off) / (most * uneven);
    }
}

static void add_tap(const filter_pass *pass, const span *at, block *b) {
    float *restrict total = b->total + at->skipped;
    const float *restrict weights = b->weights;
    for (int x = 0; x < at->count; x++)
        total[x] += weights[x];
    for (int k = 0; k < pass->count; k++) {
        const float *restrict from = pass->planes->values[pass->first + k] + at->tap;
        float *restrict sum = b->sums[k] + at->skipped;
        for (int x = 0; x < at->count; x++)
            sum[x] += weights[x] * from[x];
    }
}

static TRACE_WIDE void filter_block(const filter_pass *pass, int y, block *b) {
    static const float kernel[2] = { 0.5f, 0.25f };
    const shadow_planes *p = pass->planes;
    memset(b->total, 0, sizeof b->total);
    memset(b->sums, 0, sizeof *b->sums * (size_t)pass->count);
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            const int dx = i * pass->step, dy = j * pass->step;
            if (y + dy < 0 || y + dy >= p->height)
                continue;
            const span at = span_of(p, b, dx, dy);
            weigh(pass, &at, kernel[abs(i)] * kernel[abs(j)], b->weights);
            add_tap(pass, &at, b);
        }
    for (int k = 0; k < pass->count; k++) {
        float *mixed = p->scratch[pass->first + k] + b->row + b->begin;
        for (int x = 0; x < b->end - b->begin; x++)
            mixed[x] = b->sums[k][x] / (b->total[x] > 0 ? b->total[x] : 1);
    }
}

static void filter_rows(const filter_pass *pass, int first_row, int first) {
    const int width = pass->planes->width, height = pass->planes->height;
    const int end = first_row + BLOCK_ROWS < height ? first_row + BLOCK_ROWS : height;
    block b = { .begin = first, .end = first + BLOCK < width ? first + BLOCK : width };
    for (int y = first_row; y < end; y++) {
        b.row = (size_t)y * (size_t)width;
        filter_block(pass, y, &b);
    }
}

static void run_pass(const filter_pass *pass) {
    shadow_planes *p = pass->planes;
#pragma omp parallel for collapse(2) schedule(dynamic)
    for (int y = 0; y < p->height; y += BLOCK_ROWS)
        for (int x = 0; x < p->width; x += BLOCK)
            filter_rows(pass, y, x);
    for (int k = pass->first; k < pass->first + pass->count; k++) {
        float *mixed = p->scratch[k];
        p->scratch[k] = p->values[k];
        p->values[k] = mixed;
    }
}

/* What is hidden, and how steeply, in parts of what would be there. */
static void divide_looks(shadow_planes *p) {
    const size_t count = (size_t)p->width * (size_t)p->height;
    const float *restrict weight = p->values[SHADOW_WEIGHT];
    float *restrict slope = p->values[SHADOW_SLOPE], *restrict hidden = p->values[SHADOW_HIDDEN];
#pragma omp parallel for simd
    for (size_t i = 0; i < count; i++) {
        const float scale = 1 / (weight[i] + tiny);
        slope[i] *= scale;
        hidden[i] *= scale;
    }
}

/* Slopes and edges are looked at over a few pixels: far enough to tell them from noise, near enough
 * to lie where they are; twice as far where some have no rays, or single rays stay as dots. */
void shadow_filter(shadow_planes *planes, int spacing, float narrowing) {
    enum { LOOKS = 2, PASSES = 4 };
    for (int i = 0; i < LOOKS; i++)
        run_pass(&(filter_pass) { planes, SHADOW_SLOPE, 3, spacing > 1 ? 1 << i : 1, 0 });
    divide_looks(planes);
    for (int i = 0; i < PASSES; i++)
        run_pass(&(filter_pass) { planes, SHADOW_UNHIDDEN, SHADOW_SLOPE, 1 << i, narrowing });
}
