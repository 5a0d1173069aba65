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

static quadratic quadratic_of(int bands, const float *sh) {
    double f[9] = { 0 };
    for (size_t i = 0; i < LMP_SH_COUNT(bands); i++)
        f[i] = (double)sh[i];
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
    if (f->a[p][q] == 0)
        return;
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

/* Returns |n| - 1 of the stationary point n = -linear/2 / (A - lambda), with lambda below all
 * eigenvalues. */
static double excess(const quadratic *f, double lambda) {
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        const double n = f->linear[k] / (2 * (f->a[k][k] - lambda));
        sum += n * n;
    }
    return sqrt(sum) - 1;
}

/* Returns the least value on the sphere. By Lagrange, (A - lambda) n = -linear/2 with |n| = 1; of
 * all such points the least has lambda at or below the least eigenvalue, and there the value is
 * constant + linear·n/2 + lambda. */
static double quadratic_minimum(quadratic f) {
    for (int sweep = 0; sweep < 12; sweep++)
        for (int p = 0; p < 2; p++)
            for (int q = p + 1; q < 3; q++)
                annihilate(&f, p, q);
    const double least = fmin(fmin(f.a[0][0], f.a[1][1]), f.a[2][2]);
    const double length =
        sqrt(f.linear[0] * f.linear[0] + f.linear[1] * f.linear[1] + f.linear[2] * f.linear[2]);
    double low = least - length / 2, high = least; /* |n| <= 1 at low; it grows with lambda */
    for (int step = 0; step < 200 && low < high; step++) {
        const double middle = (low + high) / 2;
        if (middle <= low || middle >= high)
            break;
        if (excess(&f, middle) < 0)
            low = middle;
        else
            high = middle;
    }
    double value = f.constant + low;
    for (int k = 0; k < 3; k++)
        if (f.linear[k] != 0 && f.a[k][k] > low)
            value -= f.linear[k] * f.linear[k] / (4 * (f.a[k][k] - low));
    return value;
}

float lmp_probe_minimum(int bands, const float *sh) {
    assert(bands >= 1 && bands <= 3);
    return (float)quadratic_minimum(quadratic_of(bands, sh));
}

/* --- the window ------------------------------------------------------------------------------- */

static void set_weights(int bands, double mu, float *weights) {
    for (int l = 0; l < bands; l++) {
        const double eigenvalue = (double)l * (l + 1);
        weights[l] = (float)(1 / (1 + mu * eigenvalue * eigenvalue));
    }
}

/* Whether the windowed series is positive at 2n rings of 4n directions. */
static bool positive_on_grid(int bands, const float *windowed) {
    for (int i = 0; i < 2 * bands; i++) {
        const double z = cos(pi * (i + 0.5) / (2 * bands)), radius = sqrt((1 - z) * (1 + z));
        for (int j = 0; j < 4 * bands; j++) {
            const double phi = 2 * pi * (j + 0.5) / (4 * bands);
            const lmp_vec3 w = { (float)(radius * cos(phi)), (float)(radius * sin(phi)), (float)z };
            if (!(lmp_sh_reconstruct(bands, windowed, w) >= 0))
                return false;
        }
    }
    return true;
}

/* Whether all functions whose mean is positive stay positive under the window. */
static bool all_positive(int bands, const float *sh, size_t planes, const float *weights) {
    for (size_t plane = 0; plane < planes; plane++) {
        const float *f = sh + plane * LMP_SH_COUNT(bands);
        float windowed[LMP_SH_COUNT(LMP_PROBE_POSITIVE_BANDS_MAX)];
        if (!(f[0] > 0))
            continue;
        lmp_sh_apply_window(bands, weights, f, windowed);
        if (bands <= 3 ? lmp_probe_minimum(bands, windowed) < 0
                       : !positive_on_grid(bands, windowed))
            return false;
    }
    return true;
}

void lmp_probe_make_positive_window(int bands, const float *sh, size_t planes, float *weights) {
    assert(bands >= 1 && bands <= LMP_PROBE_POSITIVE_BANDS_MAX);
    assert(planes >= 1);
    assert(lmpi_are_apart(sh, planes * LMP_SH_COUNT(bands), weights, (size_t)bands));
    set_weights(bands, 0, weights);
    if (all_positive(bands, sh, planes, weights))
        return;
    double low = 1e-9, high = 1e-9; /* bracket, then bisect in equal ratios */
    do {
        high *= 16;
        set_weights(bands, high, weights);
    } while (high < 1e12 && !all_positive(bands, sh, planes, weights));
    for (int step = 0; step < 40; step++) {
        const double middle = sqrt(low * high);
        set_weights(bands, middle, weights);
        if (all_positive(bands, sh, planes, weights))
            high = middle;
        else
            low = middle;
    }
    set_weights(bands, high, weights);
}
