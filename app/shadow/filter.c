/* SPDX-License-Identifier: MIT */
/* filter.c - small kernels whose taps move apart from pass to pass (à trous, Dammertz 2010). */
#include "app/shadow/planes.h"
#include "app/shadow/wide.h"

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

/* Where a row's taps at an offset lie: pixels begin ≤ x < end have one. */
typedef struct span {
    size_t row, tap;
    int begin, end;
} span;

static span span_of(const shadow_planes *p, int y, int dx, int dy) {
    const size_t row = (size_t)y * (size_t)p->width;
    return (span) { row, (size_t)((ptrdiff_t)row + dy * p->width + dx), dx < 0 ? -dx : 0,
                    dx > 0 ? p->width - dx : p->width };
}

/* Without a branch, so that loops become vectors. */
static float positive(float x) {
    return 0.5f * (x + fabsf(x));
}

/* How far a row's taps at an offset count: not where the shadow may have changed much on the way,
 * by the slopes here, nor where it has. */
static void weigh(const filter_pass *pass, const span *at, float kernel, float *restrict weights) {
    const shadow_planes *p = pass->planes;
    const float *restrict px = p->position[0] + at->row, *restrict qx = p->position[0] + at->tap;
    const float *restrict py = p->position[1] + at->row, *restrict qy = p->position[1] + at->tap;
    const float *restrict pz = p->position[2] + at->row, *restrict qz = p->position[2] + at->tap;
    const float *restrict nx = p->normal[0] + at->row, *restrict mx = p->normal[0] + at->tap;
    const float *restrict ny = p->normal[1] + at->row, *restrict my = p->normal[1] + at->tap;
    const float *restrict nz = p->normal[2] + at->row, *restrict mz = p->normal[2] + at->tap;
    const float *restrict footprint = p->footprint + at->row;
    const float *restrict all = p->values[SHADOW_WEIGHT] + at->row;
    const float *restrict slope = p->values[SHADOW_SLOPE] + at->row;
    const float *restrict hidden = p->values[SHADOW_HIDDEN] + at->row;
    const float *restrict tap_all = p->values[SHADOW_WEIGHT] + at->tap;
    const float *restrict tap_hidden = p->values[SHADOW_HIDDEN] + at->tap;
    const float limit = pass->narrowing;
#pragma omp simd
    for (int x = at->begin; x < at->end; x++) {
        const float dx = qx[x] - px[x], dy = qy[x] - py[x], dz = qz[x] - pz[x];
        const float d2 = dx * dx + dy * dy + dz * dz, pixel = footprint[x] * off_pixel;
        const float off = nx[x] * dx + ny[x] * dy + nz[x] * dz;
        const float most = off_plane * off_plane * d2 + pixel * pixel;
        const float flat = positive(1 - off * off / most);
        const float facing = positive(nx[x] * mx[x] + ny[x] * my[x] + nz[x] * mz[x]);
        const float own = 1 / (all[x] + tiny), tap = 1 / (tap_all[x] + tiny);
        const float steep = slope[x] * own, apart = (hidden[x] * own - tap_hidden[x] * tap) / jump;
        const float change = limit * d2 * steep * steep;
        const float apart2 = limit * apart * apart, apart4 = apart2 * apart2;
        const float even = 1 / (1 + change * change + apart4 * apart4);
        weights[x] = kernel * facing * facing * flat * even;
    }
}

static void add_tap(const filter_pass *pass, const span *at, const float *restrict weights,
                    float *restrict total, float *const *sums) {
    for (int x = at->begin; x < at->end; x++)
        total[x] += weights[x];
    for (int k = 0; k < pass->count; k++) {
        const float *restrict from = pass->planes->values[pass->first + k] + at->tap;
        float *restrict sum = sums[k];
        for (int x = at->begin; x < at->end; x++)
            sum[x] += weights[x] * from[x];
    }
}

static SHADOW_WIDE void filter_row(const filter_pass *pass, int y, float *weights) {
    static const float kernel[2] = { 0.5f, 0.25f };
    const shadow_planes *p = pass->planes;
    const size_t width = (size_t)p->width, row = (size_t)y * width;
    float *total = weights + width, *sums[SHADOW_VALUES];
    memset(total, 0, width * sizeof *total);
    for (int k = 0; k < pass->count; k++) {
        sums[k] = pass->planes->scratch[pass->first + k] + row;
        memset(sums[k], 0, width * sizeof *sums[k]);
    }
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            const int dx = i * pass->step, dy = j * pass->step;
            if (y + dy < 0 || y + dy >= p->height || abs(dx) >= p->width)
                continue;
            const span at = span_of(p, y, dx, dy);
            weigh(pass, &at, kernel[abs(i)] * kernel[abs(j)], weights);
            add_tap(pass, &at, weights, total, sums);
        }
    for (int k = 0; k < pass->count; k++)
        for (size_t x = 0; x < width; x++)
            sums[k][x] /= total[x] > 0 ? total[x] : 1;
}

static bool run_pass(const filter_pass *pass) {
    shadow_planes *p = pass->planes;
    bool ok = true;
#pragma omp parallel reduction(&& : ok)
    {
        float *weights = malloc(2 * (size_t)p->width * sizeof *weights);
        ok = weights;
#pragma omp for schedule(dynamic, 4)
        for (int y = 0; y < p->height; y++)
            if (weights)
                filter_row(pass, y, weights);
        free(weights);
    }
    for (int k = pass->first; k < pass->first + pass->count; k++) {
        float *mixed = p->scratch[k];
        p->scratch[k] = p->values[k];
        p->values[k] = mixed;
    }
    return ok;
}

/* Slopes and edges are looked at over a few pixels: far enough to tell them from noise, near enough
 * to lie where they are. Of a mean of n, blur that falls as the fourth root falls as the root of n,
 * and so does variance.
 */
bool shadow_filter(shadow_planes *planes, int sample) {
    enum { LOOKS = 2, PASSES = 4 };
    const float narrowing = sqrtf((float)(sample + 1));
    bool ok = true;
    for (int i = 0; i < LOOKS && ok; i++)
        ok = run_pass(&(filter_pass) { planes, SHADOW_SLOPE, 3, 1, 0 });
    for (int i = 0; i < PASSES && ok; i++)
        ok = run_pass(&(filter_pass) { planes, SHADOW_UNHIDDEN, SHADOW_SLOPE, 1 << i, narrowing });
    return ok;
}
