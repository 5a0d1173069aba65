/* SPDX-License-Identifier: MIT */
#include "src/light/angle.h"

#include <math.h>

typedef lmpi_pair pair;

static const double pi = 3.14159265358979323846;

static pair pair_of(double a) {
    return (pair) { a, a };
}

static pair root(pair a) {
    return (pair) { sqrt(a[0]), sqrt(a[1]) };
}

static pair magnitude(pair a) {
    return (pair) { fabs(a[0]), fabs(a[1]) };
}

/* Computes atan y/x of an eighth of each angle, where the series converges fast: the C library's
 * functions need not give the same bits everywhere. Terms of even and of odd index are summed
 * apart, because each waits for the one before. */
pair lmpi_angles(pair y, pair x) {
    static const double series[] = { 1.,      -1. / 3,  1. / 5,  -1. / 7,  1. / 9,  -1. / 11,
                                     1. / 13, -1. / 15, 1. / 17, -1. / 19, 1. / 21, -1. / 23 };
    enum { TERMS = sizeof series / sizeof *series };
    const pair length = root(x * x + y * y);
    pair t = magnitude(y) / (length + magnitude(x)), angle;
    for (int halving = 0; halving < 2; halving++)
        t /= 1 + root(1 + t * t);
    const pair square = t * t, fourth = square * square;
    pair even = pair_of(series[TERMS - 2]), odd = pair_of(series[TERMS - 1]);
    for (int i = TERMS - 4; i >= 0; i -= 2) {
        even = series[i] + fourth * even;
        odd = series[i + 1] + fourth * odd;
    }
    const pair acute = 8 * t * (even + square * odd);
    for (int k = 0; k < 2; k++) {
        const double whole = x[k] < 0 ? pi - acute[k] : acute[k];
        angle[k] = !(length[k] > 0) ? 0 : y[k] < 0 ? -whole : whole;
    }
    return angle;
}

double lmpi_angle(double y, double x) {
    return lmpi_angles((pair) { y, 0 }, (pair) { x, 1 })[0];
}
