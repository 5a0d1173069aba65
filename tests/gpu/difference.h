/* SPDX-License-Identifier: MIT */
/* difference.h - how far two images are apart, relative to what is bright nearby. */
#ifndef LAMPION_TESTS_GPU_DIFFERENCE_H
#define LAMPION_TESTS_GPU_DIFFERENCE_H

#include "tests/gpu/device.h"

#include <math.h>

enum { NEIGHBORS = 8 };

/* Returns the brightest value around a pixel. */
static inline float local_peak(const image *pixels, int x, int y) {
    float peak = 0;
    for (int j = y - NEIGHBORS; j <= y + NEIGHBORS; j++)
        for (int i = x - NEIGHBORS; i <= x + NEIGHBORS; i++)
            if (i >= 0 && j >= 0 && i < pixels->width && j < pixels->height)
                for (int c = 0; c < 3; c++)
                    peak = fmaxf(peak, pixels->rgb[3 * (pixels->width * j + i) + c]);
    return peak;
}

typedef struct difference {
    double worst, rms; /* relative to the local peak */
} difference;

static inline difference differ(const image *a, const image *b) {
    difference d = { 0, 0 };
    for (int y = 0; y < b->height; y++)
        for (int x = 0; x < b->width; x++) {
            const float peak = local_peak(b, x, y);
            for (int c = 0; c < 3; c++) {
                const int i = 3 * (b->width * y + x) + c;
                const double off =
                    fabs((double)a->rgb[i] - (double)b->rgb[i]) / ((double)peak + 1e-9);
                d.worst = off > d.worst ? off : d.worst;
                d.rms += off * off;
            }
        }
    d.rms = sqrt(d.rms / (3.0 * b->width * b->height));
    return d;
}

/* Expects a difference no larger than the rounding of sums of coefficients, which cancel. */
static inline void expect_same(const char *what, difference d) {
    print_message("%s: at most %.1e of the local peak, %.1e in root mean square\n", what, d.worst,
                  d.rms);
    assert_true(!(d.worst > 5e-5) && !(d.rms > 1e-6));
}

#endif
