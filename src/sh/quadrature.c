/* SPDX-License-Identifier: MIT */
#include "src/sh/quadrature.h"

#include <math.h>

void lmpi_gauss_legendre(int count, int i, double *node, double *weight) {
    double x = -cos(3.14159265358979323846 * (i + 0.75) / (count + 0.5)), slope = 1;
    /* Newton's steps from the estimate; the third changes only the last bits. */
    for (int step = 0; step < 4; step++) {
        double before = 0, now = 1;
        for (int l = 0; l < count; l++) {
            const double next = ((2 * l + 1) * x * now - l * before) / (l + 1);
            before = now;
            now = next;
        }
        slope = count * (x * now - before) / (x * x - 1);
        x -= now / slope;
    }
    *node = x;
    *weight = 2 / ((1 - x * x) * slope * slope);
}
