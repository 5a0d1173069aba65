/* SPDX-License-Identifier: MIT */
/* positive.c - the least value of a series, and the weakest window that keeps it positive. */
#include "src/base/precondition.h"

#include <lampion/probe.h>

#include <math.h>

static const double pi = 3.14159265358979323846;

/* --- three bands: a quadratic polynomial on the sphere ---------------------------------------- */

/* f(n) = constant + linear·n + n·A n, where A has no trace. */
typedef struct quadratic {
    double constant, linear[3], a[3][3];
} quadratic;

/* Returns the quadratic of up to three bands, each times its weight. */
static quadratic quadratic_of(int bands, const float *sh, const double weights[3]) {
    double f[9] = { 0 };
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++)
            f[LMP_SH_INDEX(l, m)] = weights[l] * (double)sh[LMP_SH_INDEX(l, m)];
    const double y1 = sqrt(3 / (4 * pi)), y2 = sqrt(15 / (4 * pi));
    const double y20 = sqrt(5 / (16 * pi)), y22 = sqrt(15 / (16 * pi));
    const double xy = y2 * f[4] / 2, yz = -y2 * f[5] / 2, zx = -y2 * f[7] / 2;
    return (quadratic) {
        .constant = f[0] / sqrt(4 * pi),
        .linear = { -y1 * f[3], -y1 * f[1], y1 * f[2] },
        .a = { { y22 * f[8] - y20 * f[6], xy, zx },
               { xy, -y22 * f[8] - y20 * f[6], yz },
               { zx, yz, 2 * y20 * f[6] } },
    };
}

/* Rotates the axes p and q so that a[p][q] = 0 (Jacobi), and linear with them. */
static void annihilate(quadratic *f, int p, int q) {
    if (fabs(f->a[p][q]) <= 1e-18 * (fabs(f->a[p][p]) + fabs(f->a[q][q])))
        return; /* it is lost beside them */
    const double tau = (f->a[q][q] - f->a[p][p]) / (2 * f->a[p][q]);
    const double t = (tau < 0 ? -1 : 1) / (fabs(tau) + sqrt(1 + tau * tau));
    const double c = 1 / sqrt(1 + t * t), s = t * c;
    for (int k = 0; k < 3; k++) {
        const double kp = f->a[k][p], kq = f->a[k][q];
        f->a[k][p] = c * kp - s * kq;
        f->a[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < 3; k++) {
        const double pk = f->a[p][k], qk = f->a[q][k];
        f->a[p][k] = c * pk - s * qk;
        f->a[q][k] = s * pk + c * qk;
    }
    const double lp = f->linear[p], lq = f->linear[q];
    f->linear[p] = c * lp - s * lq;
    f->linear[q] = s * lp + c * lq;
}

/* Returns the lambda at which the stationary point n = -linear/2 / (A - lambda) is unit, or the
 * least eigenvalue if n is shorter there. Where each axis alone would make n as long as 1, n is at
 * least as long as 1; from there, Newton's method for 1 / |n|, which is concave, descends to it. */
static double find_lambda(const quadratic *f) {
    double lambda = (double)INFINITY;
    for (int k = 0; k < 3; k++)
        lambda = fmin(lambda, f->a[k][k] - fabs(f->linear[k]) / 2);
    for (int step = 0; step < 60; step++) {
        double square = 0, slope = 0; /* |n|² and half its derivative */
        for (int k = 0; k < 3; k++) {
            const double above = f->a[k][k] - lambda;
            const double n = above > 0 ? f->linear[k] / (2 * above) : 0;
            square += n * n;
            slope += n == 0 ? 0 : n * n / above;
        }
        const double next = lambda - square * (sqrt(square) - 1) / slope;
        if (!(next < lambda)) /* or NaN, if n is 0 */
            break;
        lambda = next;
    }
    return lambda;
}

/* Returns the least value on the sphere. By Lagrange, (A - lambda) n = -linear/2 with |n| = 1; of
 * all such points the least has lambda at or below the least eigenvalue, and there the value is
 * constant + linear·n/2 + lambda. */
static double quadratic_minimum(quadratic f) {
    for (int sweep = 0; sweep < 12; sweep++)
        for (int p = 0; p < 2; p++)
            for (int q = p + 1; q < 3; q++)
                annihilate(&f, p, q);
    const double lambda = find_lambda(&f);
    double value = f.constant + lambda;
    for (int k = 0; k < 3; k++)
        if (f.a[k][k] > lambda)
            value -= f.linear[k] * f.linear[k] / (4 * (f.a[k][k] - lambda));
    return value;
}

float lmp_probe_minimum(int bands, const float *sh) {
    static const double ones[3] = { 1, 1, 1 };
    assert(bands >= 1 && bands <= 3);
    return (float)quadratic_minimum(quadratic_of(bands, sh, ones));
}

/* --- the window ------------------------------------------------------------------------------- */

/* Returns 1 / (1 + mu l² (l+1)²), where mu is given by its value for l = 1, `first`: 1 is no
 * window, and 0 leaves the mean alone. */
static double weight_of(int l, double first) {
    const double ratio = (double)l * (l + 1) / 2;
    return l == 0 ? 1 : first / (first + ratio * ratio * (1 - first));
}

/* A function under a window: its least value, or its value in one direction. */
typedef struct windowed {
    int bands;
    const float *sh;     /* of up to three bands, or NULL */
    const double *parts; /* the bands' values in one direction */
} windowed;

static double value_of(const windowed *f, double first) {
    double weights[3], sum = 0;
    if (!f->sh) {
        for (int l = 0; l < f->bands; l++)
            sum += weight_of(l, first) * f->parts[l];
        return sum;
    }
    for (int l = 0; l < f->bands; l++)
        weights[l] = weight_of(l, first);
    return quadratic_minimum(quadratic_of(f->bands, f->sh, weights));
}

/* Returns the weakest window from `first` on under which a function whose mean is positive is not
 * negative, by the Illinois method: of a false position whose side stays, half the value counts. */
static double strengthen(const windowed *f, double first) {
    double good = 0, bad = first, bad_value = value_of(f, first);
    if (bad_value >= 0)
        return first;
    double good_value = value_of(f, 0);
    int side = 0;
    for (int step = 0; step < 60 && good_value > 0 && bad - good > 1e-10; step++) {
        const double at = (bad * good_value - good * bad_value) / (good_value - bad_value);
        const double value = value_of(f, at);
        if (value >= 0) {
            good = at;
            good_value = value;
            bad_value *= side > 0 ? 0.5 : 1;
        } else {
            bad = at;
            bad_value = value;
            good_value *= side < 0 ? 0.5 : 1;
        }
        side = value >= 0 ? 1 : -1;
    }
    return good;
}

/* Strengthens a window until no function of up to three bands is negative anywhere. */
static double strengthen_whole(int bands, const float *sh, size_t planes, double first) {
    for (size_t plane = 0; plane < planes; plane++) {
        const float *f = sh + plane * LMP_SH_COUNT(bands);
        if (f[0] > 0)
            first = strengthen(&(windowed) { .bands = bands, .sh = f }, first);
    }
    return first;
}

/* Strengthens a window until no function is negative in a direction of the given basis. */
static double strengthen_toward(int bands, const float *sh, size_t planes, const float *basis,
                                double first) {
    for (size_t plane = 0; plane < planes; plane++) {
        const float *f = sh + plane * LMP_SH_COUNT(bands);
        double parts[LMP_PROBE_POSITIVE_BANDS_MAX] = { 0 };
        if (!(f[0] > 0))
            continue;
        for (int l = 0; l < bands; l++)
            for (int i = l * l; i < (l + 1) * (l + 1); i++)
                parts[l] += (double)(f[i] * basis[i]);
        first = strengthen(&(windowed) { .bands = bands, .parts = parts }, first);
    }
    return first;
}

/* Strengthens a window until no function is negative at 2n rings of 4n directions. */
static double strengthen_on_grid(int bands, const float *sh, size_t planes, double first) {
    float basis[LMP_SH_COUNT(LMP_PROBE_POSITIVE_BANDS_MAX)];
    for (int i = 0; i < 2 * bands; i++) {
        const double z = cos(pi * (i + 0.5) / (2 * bands)), radius = sqrt((1 - z) * (1 + z));
        for (int j = 0; j < 4 * bands; j++) {
            const double phi = 2 * pi * (j + 0.5) / (4 * bands);
            const lmp_vec3 w = { (float)(radius * cos(phi)), (float)(radius * sin(phi)), (float)z };
            lmp_sh_eval(bands, w, basis);
            first = strengthen_toward(bands, sh, planes, basis, first);
        }
    }
    return first;
}

void lmp_probe_make_positive_window(int bands, const float *sh, size_t planes, float *weights) {
    assert(bands >= 1 && bands <= LMP_PROBE_POSITIVE_BANDS_MAX);
    assert(planes >= 1);
    assert(lmpi_are_apart(sh, planes * LMP_SH_COUNT(bands), weights, (size_t)bands));
    double first = 1, before;
    /* A stronger window may make another direction negative, where bands cancelled each other. */
    do {
        before = first;
        first = bands <= 3 ? strengthen_whole(bands, sh, planes, first)
                           : strengthen_on_grid(bands, sh, planes, first);
    } while (first < before);
    for (int l = 0; l < bands; l++)
        weights[l] = (float)weight_of(l, first);
}
