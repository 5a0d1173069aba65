/* SPDX-License-Identifier: MIT */
/* filter.c - small kernels whose taps move apart from pass to pass (à trous, Dammertz 2010). */
#include "app/render/shadow/planes.h"
#include "app/scene/trace/wide.h"

#include <math.h>
#include <stdlib.h>

/* One pass of the filter. */
typedef struct filter_pass {
    shadow_planes *planes;
    int set;          /* of values */
    int first, count; /* planes of values to filter: LOOK's, MIX's, or MIX's and SENT */
    int step;
    float narrowing; /* how strongly the slope of shadows narrows the filter; 0: not at all */
} filter_pass;

enum { LOOK = SHADOW_WEIGHT, LOOK_COUNT = 3, MIX = SHADOW_UNHIDDEN, MIX_COUNT = SHADOW_WEIGHT };

/* The weight, which looks alone need, is then 1 where a pixel has sent rays, and mixed as well. */
enum { SENT = SHADOW_WEIGHT, SENT_COUNT = MIX_COUNT + 1 };

/* Neighbors farther off a pixel's plane, relative to their distance and to a pixel's width, belong
 * to another surface. */
static const float off_plane = 0.15f, off_pixel = 1;

/* A difference of blocked fractions that means an edge, not noise. */
static const float jump = 0.25f;
static const float tiny = 1e-30f;

/* Planes are filtered in blocks of so many columns and rows, whose taps stay in a core's cache. */
enum { BLOCK = 256, BLOCK_ROWS = 64 };

/* Returns max(x, 0) without a branch, so that loops are vectorized. */
static inline float positive(float x) {
    return 0.5f * (x + fabsf(x));
}

/* The planes from which weights are computed. */
typedef struct weight_planes {
    const float *x, *y, *z, *nx, *ny, *nz, *footprint, *slope, *hidden;
    float steep, sudden;
} weight_planes;

static inline weight_planes weight_planes_of(const filter_pass *pass) {
    const shadow_planes *p = pass->planes;
    return (weight_planes) { p->position[0],
                             p->position[1],
                             p->position[2],
                             p->normal[0],
                             p->normal[1],
                             p->normal[2],
                             p->footprint,
                             p->values[pass->set][SHADOW_SLOPE],
                             p->values[pass->set][SHADOW_HIDDEN],
                             pass->narrowing,
                             sqrtf(pass->narrowing) / jump };
}

/* Returns the weight of a tap of pixel i: low if the shadow may have changed much in between, by
 * the slope at the pixel, or has changed. */
static inline float weigh(weight_planes s, size_t i, size_t tap, float kernel) {
    const float dx = s.x[tap] - s.x[i], dy = s.y[tap] - s.y[i], dz = s.z[tap] - s.z[i];
    const float d2 = dx * dx + dy * dy + dz * dz, pixel = s.footprint[i] * off_pixel;
    const float off = s.nx[i] * dx + s.ny[i] * dy + s.nz[i] * dz;
    const float most = off_plane * off_plane * d2 + pixel * pixel;
    const float facing = positive(s.nx[i] * s.nx[tap] + s.ny[i] * s.ny[tap] + s.nz[i] * s.nz[tap]);
    const float change = s.steep * d2 * s.slope[i] * s.slope[i];
    const float apart = s.sudden * (s.hidden[i] - s.hidden[tap]), apart2 = apart * apart;
    const float apart4 = apart2 * apart2, uneven = 1 + change * change + apart4 * apart4;
    return kernel * facing * facing * positive(most - off * off) / (most * uneven);
}

/* The weights of the nine taps, by rows; named, because the compiler does not vectorize loops over
 * them. */
typedef struct weights {
    float a, b, c, d, e, f, g, h, i;
} weights;

/* Sums the weights from 0 on, as for a pixel with fewer taps. */
static inline float sum_of(weights w) {
    return 0 + w.a + w.b + w.c + w.d + w.e + w.f + w.g + w.h + w.i;
}

static inline float sum_values(const float *v, size_t i, size_t across, size_t down, weights w) {
    return 0 + w.a * v[i - down - across] + w.b * v[i - down] + w.c * v[i - down + across] +
           w.d * v[i - across] + w.e * v[i] + w.f * v[i + across] + w.g * v[i + down - across] +
           w.h * v[i + down] + w.i * v[i + down + across];
}

/* Filters pixels of a row, from i on, all of whose taps are in the image. */
static inline void mix_inside(const filter_pass *pass, int first, int count, size_t i, size_t end) {
    const weight_planes s = weight_planes_of(pass);
    const size_t across = (size_t)pass->step, down = across * (size_t)pass->planes->width;
    const float *from[SENT_COUNT];
    float *to[SENT_COUNT];
    for (int k = 0; k < count; k++) {
        from[k] = pass->planes->values[pass->set][first + k];
        to[k] = pass->planes->scratch[first + k];
    }
#pragma omp simd
    for (size_t x = i; x < end; x++) {
        const weights w = { weigh(s, x, x - down - across, 0.0625f),
                            weigh(s, x, x - down, 0.125f),
                            weigh(s, x, x - down + across, 0.0625f),
                            weigh(s, x, x - across, 0.125f),
                            weigh(s, x, x, 0.25f),
                            weigh(s, x, x + across, 0.125f),
                            weigh(s, x, x + down - across, 0.0625f),
                            weigh(s, x, x + down, 0.125f),
                            weigh(s, x, x + down + across, 0.0625f) };
        const float total = sum_of(w) + tiny;
        to[0][x] = sum_values(from[0], x, across, down, w) / total;
        to[1][x] = sum_values(from[1], x, across, down, w) / total;
        to[2][x] = sum_values(from[2], x, across, down, w) / total;
        if (count > LOOK_COUNT) {
            to[3][x] = sum_values(from[3], x, across, down, w) / total;
            to[4][x] = sum_values(from[4], x, across, down, w) / total;
            to[5][x] = sum_values(from[5], x, across, down, w) / total;
        }
        if (count > MIX_COUNT)
            to[6][x] = sum_values(from[6], x, across, down, w) / total;
    }
}

static TRACE_WIDE void look_inside(const filter_pass *pass, size_t i, size_t end) {
    mix_inside(pass, LOOK, LOOK_COUNT, i, end);
}

static TRACE_WIDE void mix_values_inside(const filter_pass *pass, size_t i, size_t end) {
    mix_inside(pass, MIX, MIX_COUNT, i, end);
}

static TRACE_WIDE void mix_sent_inside(const filter_pass *pass, size_t i, size_t end) {
    mix_inside(pass, MIX, SENT_COUNT, i, end);
}

static void mix_some_inside(const filter_pass *pass, size_t i, size_t end) {
    if (pass->first == LOOK)
        look_inside(pass, i, end);
    else if (pass->count == MIX_COUNT)
        mix_values_inside(pass, i, end);
    else
        mix_sent_inside(pass, i, end);
}

/* Filters a pixel at the image's edge. */
static void mix_pixel(const filter_pass *pass, int x, int y) {
    static const float kernel[2] = { 0.5f, 0.25f };
    const shadow_planes *p = pass->planes;
    const size_t i = (size_t)y * (size_t)p->width + (size_t)x;
    float total = 0, sums[SENT_COUNT] = { 0 };
    for (int v = -1; v <= 1; v++)
        for (int u = -1; u <= 1; u++) {
            const int column = x + u * pass->step, row = y + v * pass->step;
            const size_t tap = (size_t)row * (size_t)p->width + (size_t)column;
            if (column < 0 || column >= p->width || row < 0 || row >= p->height)
                continue;
            const float weight =
                weigh(weight_planes_of(pass), i, tap, kernel[abs(v)] * kernel[abs(u)]);
            total += weight;
            for (int k = 0; k < pass->count; k++)
                sums[k] += weight * p->values[pass->set][pass->first + k][tap];
        }
    for (int k = 0; k < pass->count; k++)
        p->scratch[pass->first + k][i] = sums[k] / (total + tiny);
}

static void mix_row(const filter_pass *pass, int y, int begin, int end) {
    const int width = pass->planes->width, step = pass->step;
    const bool inside = y >= step && y + step < pass->planes->height && width > 2 * step;
    const int left = inside ? begin > step ? begin : step : end;
    const int right = end < width - step ? end : width - step;
    const size_t row = (size_t)y * (size_t)width;
    for (int x = begin; x < left && x < end; x++)
        mix_pixel(pass, x, y);
    if (left < right)
        mix_some_inside(pass, row + (size_t)left, row + (size_t)right);
    for (int x = left > right ? left : right; x < end; x++)
        mix_pixel(pass, x, y);
}

static void run_pass(const filter_pass *pass) {
    shadow_planes *p = pass->planes;
#pragma omp parallel for collapse(2) schedule(dynamic)
    for (int y = 0; y < p->height; y += BLOCK_ROWS)
        for (int x = 0; x < p->width; x += BLOCK)
            for (int row = y; row < y + BLOCK_ROWS && row < p->height; row++)
                mix_row(pass, row, x, x + BLOCK < p->width ? x + BLOCK : p->width);
    for (int k = pass->first; k < pass->first + pass->count; k++) {
        float *mixed = p->scratch[k];
        p->scratch[k] = p->values[pass->set][k];
        p->values[pass->set][k] = mixed;
    }
}

/* Divides what is blocked, and its slope, by what would arrive unblocked. */
static void divide_looks(const shadow_planes *p, int set) {
    const size_t count = (size_t)p->width * (size_t)p->height;
    const float *restrict weight = p->values[set][SHADOW_WEIGHT];
    float *restrict slope = p->values[set][SHADOW_SLOPE], *restrict hidden =
                                                              p->values[set][SHADOW_HIDDEN];
#pragma omp parallel for simd
    for (size_t i = 0; i < count; i++) {
        const float scale = 1 / (weight[i] + tiny);
        slope[i] *= scale;
        hidden[i] *= scale;
    }
}

/* Slopes and edges are estimated over a few pixels: enough to tell them from noise, few enough to
 * locate them; twice as far where some pixels have no rays, or single rays would remain as dots. */
static void look_at(shadow_planes *planes, int set, int spacing) {
    enum { LOOKS = 2 };
    for (int i = 0; i < LOOKS; i++)
        run_pass(&(filter_pass) { planes, set, LOOK, LOOK_COUNT, spacing > 1 ? 1 << i : 1, 0 });
    divide_looks(planes, set);
}

static void mix(shadow_planes *planes, int set, int count, float narrowing) {
    enum { PASSES = 4 };
    for (int i = 0; i < PASSES; i++)
        run_pass(&(filter_pass) { planes, set, MIX, count, 1 << i, narrowing });
}

/* Marks the pixels that have sent rays in all sets. */
static void mark_sent(const shadow_planes *p) {
    const size_t count = (size_t)p->width * (size_t)p->height;
#pragma omp parallel for
    for (size_t i = 0; i < count; i++) {
        float all = 0;
        for (int c = 0; c < 3; c++)
            all += shadow_planes_sum(p, SHADOW_ALL + c, i);
        for (int set = 0; set < p->sets; set++)
            p->values[set][SENT][i] = all > 0 ? 1 : 0;
    }
}

/* Divides the values of a set by the fraction of their taps that have sent rays, which differs from
 * that of the other set. */
static void divide_by_sent(const shadow_planes *p, int set) {
    const size_t count = (size_t)p->width * (size_t)p->height;
#pragma omp parallel for
    for (size_t i = 0; i < count; i++)
        for (int k = MIX; k < MIX + MIX_COUNT; k++)
            p->values[set][k][i] /= p->values[set][SENT][i] + tiny;
}

void shadow_filter(shadow_planes *planes, int spacing, float narrowing) {
    const bool some = planes->sets > 1 && spacing > 1;
    for (int set = 0; set < planes->sets; set++)
        look_at(planes, set, spacing);
    if (some)
        mark_sent(planes);
    for (int set = 0; set < planes->sets; set++)
        mix(planes, set, some ? SENT_COUNT : MIX_COUNT, narrowing);
    for (int set = 0; some && set < planes->sets; set++)
        divide_by_sent(planes, set);
}
