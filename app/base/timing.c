/* SPDX-License-Identifier: MIT */
#include "app/base/timing.h"

#include <stdlib.h>
#include <time.h>

double timing_now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

timing_quartiles timing_of(double *samples, int count) {
    qsort(samples, (size_t)count, sizeof *samples, by_value);
    return (timing_quartiles) { samples[count / 4],
                                0.5 * (samples[(count - 1) / 2] + samples[count / 2]),
                                samples[3 * count / 4] };
}
