/* SPDX-License-Identifier: MIT */
#include "app/study/paper_legendre.h"

#include "app/truth/reference_quadrature.h"

#include <math.h>

double paper_legendre(int l, double x) {
    double before = 0, p = 1;
    for (int k = 0; k < l; k++) {
        const double next = ((2 * k + 1) * x * p - k * before) / (k + 1);
        before = p;
        p = next;
    }
    return p;
}

static double at_angle(double angle, void *user) {
    return paper_legendre(*(int *)user, cos(angle)) * sin(angle);
}

static double delta_within(int l, double a) {
    const int parts = 1 + (int)(l * a / 8); /* each covers a few oscillations */
    double sum = 0;
    for (int i = 0; i < parts; i++)
        sum += reference_integrate(at_angle, &l, a * i / parts, a * (i + 1) / parts);
    return sum;
}

double paper_delta(int l, double cos_a) {
    return delta_within(l, acos(cos_a));
}

double paper_zonal(int l, double a) {
    return sqrt(REFERENCE_PI * (2 * l + 1)) * delta_within(l, a);
}
