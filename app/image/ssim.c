/* SPDX-License-Identifier: MIT */
#include "app/image/ssim.h"

#include "app/image/srgb.h"

#include <math.h>
#include <stdlib.h>

enum { REACH = 5, WINDOW = 2 * REACH + 1, STRIP = 64 /* rows that a thread takes at once */ };
#define SIGMA 1.5

/* The windowed means from which SSIM is computed. */
enum { X, Y, XX, YY, XY, MEANS };

/* Values of each kind for several rows, one row after the other: the products of one row, then the
 * Gaussian means along the last WINDOW rows; those of row y are at 1 + y % WINDOW. */
typedef struct rows {
    const image *candidate, *reference;
    double weights[REACH + 1];
    double *values;
} rows;

static double *row_of(const rows *r, int number, int kind) {
    return r->values + ((size_t)number * MEANS + (size_t)kind) * (size_t)r->candidate->width;
}

static void multiply_row(const rows *r, int y) {
    const int width = r->candidate->width;
    const size_t first = 3 * (size_t)y * (size_t)width;
    for (int i = 0; i < width; i++) {
        const double a = image_luminance(r->candidate->rgb + first + 3 * i);
        const double b = image_luminance(r->reference->rgb + first + 3 * i);
        row_of(r, 0, X)[i] = a;
        row_of(r, 0, Y)[i] = b;
        row_of(r, 0, XX)[i] = a * a;
        row_of(r, 0, YY)[i] = b * b;
        row_of(r, 0, XY)[i] = a * b;
    }
}

/* Blurs a row with weights that add up to 1 at the ends as well. */
static void blur_row(const rows *r, const double *in, double *out) {
    const int count = r->candidate->width;
    for (int i = 0; i < count; i++) {
        double sum = 0, all = 0;
        for (int j = i < REACH ? -i : -REACH; j <= REACH && i + j < count; j++) {
            sum += r->weights[abs(j)] * in[i + j];
            all += r->weights[abs(j)];
        }
        out[i] = sum / all;
    }
}

static void add_row(const rows *r, int y) {
    multiply_row(r, y);
    for (int kind = 0; kind < MEANS; kind++)
        blur_row(r, row_of(r, 0, kind), row_of(r, 1 + y % WINDOW, kind));
}

/* Returns the mean of a kind at a pixel; the rows of its window must be there. */
static double mean_at(const rows *r, int kind, int x, int y) {
    double sum = 0, all = 0;
    for (int j = y < REACH ? -y : -REACH; j <= REACH && y + j < r->candidate->height; j++) {
        sum += r->weights[abs(j)] * row_of(r, 1 + (y + j) % WINDOW, kind)[x];
        all += r->weights[abs(j)];
    }
    return sum / all;
}

/* Returns a factor of SSIM, 1 if both terms are 0: a black image has no peak. */
static double ratio(double over, double under) {
    return under > 0 ? over / under : 1;
}

static double similarity(const rows *r, int x, int y, double c1, double c2) {
    const double a = mean_at(r, X, x, y), b = mean_at(r, Y, x, y);
    const double aa = mean_at(r, XX, x, y) - a * a, bb = mean_at(r, YY, x, y) - b * b;
    const double ab = mean_at(r, XY, x, y) - a * b;
    return ratio(2 * a * b + c1, a * a + b * b + c1) * ratio(2 * ab + c2, aa + bb + c2);
}

/* Sums at most STRIP rows from `first` on; returns NaN if memory ran out. */
static double sum_strip(const image *candidate, const image *reference, double peak, int first) {
    const double c1 = (0.01 * peak) * (0.01 * peak), c2 = (0.03 * peak) * (0.03 * peak);
    const int height = candidate->height, end = first + STRIP < height ? first + STRIP : height;
    rows r = { .candidate = candidate, .reference = reference };
    r.values = malloc((size_t)(1 + WINDOW) * MEANS * (size_t)candidate->width * sizeof *r.values);
    if (!r.values)
        return (double)NAN;
    for (int i = 0; i <= REACH; i++)
        r.weights[i] = exp(-i * i / (2 * SIGMA * SIGMA));
    double sum = 0;
    int next = first > REACH ? first - REACH : 0;
    for (int y = first; y < end; y++) {
        for (; next <= y + REACH && next < height; next++)
            add_row(&r, next);
        for (int x = 0; x < candidate->width; x++)
            sum += similarity(&r, x, y, c1, c2);
    }
    free(r.values);
    return sum;
}

bool compare_ssim(const image *candidate, const image *reference, double peak, double *ssim) {
    const int strips = (candidate->height + STRIP - 1) / STRIP;
    double *const sums = malloc((size_t)strips * sizeof *sums), sum = 0;
    if (!sums)
        return false;
#pragma omp parallel for schedule(dynamic)
    for (int i = 0; i < strips; i++)
        sums[i] = sum_strip(candidate, reference, peak, i * STRIP);
    /* in a fixed order whatever the number of threads, so that the digits are always the same */
    for (int i = 0; i < strips; i++)
        sum += sums[i];
    free(sums);
    *ssim = sum / ((double)candidate->width * (double)candidate->height);
    return !isnan(sum);
}
