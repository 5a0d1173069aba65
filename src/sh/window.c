/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"
#include "src/base/unroll.h"

#include <lampion/sh.h>

#include <math.h>
#include <stdbool.h>

static const double pi = 3.14159265358979323846;

/* Weights by a band's position l / size in 0 … 1. */
static double none(double position) {
    (void)position;
    return 1;
}

static double hanning(double position) {
    return (1 + cos(pi * position)) / 2;
}

static double lanczos(double position) {
    return sin(pi * position) / (pi * position);
}

static const struct {
    const char *name;
    double (*weight)(double position);
    bool ends; /* past `size` the weights are 0 */
} windows[LMP_WINDOW_COUNT] = {
    [LMP_WINDOW_NONE] = { "none", none, false },
    [LMP_WINDOW_HANNING] = { "hanning", hanning, true },
    [LMP_WINDOW_LANCZOS] = { "lanczos", lanczos, true },
};

const char *lmp_sh_window_name(lmp_window window) {
    return (unsigned)window < LMP_WINDOW_COUNT ? windows[window].name : NULL;
}

void lmp_sh_make_window(int bands, lmp_window window, float size, float *weights) {
    assert(lmpi_is_bands(bands) && (unsigned)window < LMP_WINDOW_COUNT);
    assert(size >= 0 && isfinite(size));
    const double last = size > 0 ? (double)size : bands;
    weights[0] = 1;
    if (window == LMP_WINDOW_NONE) {
        for (int l = 1; l < bands; l++)
            weights[l] = 1;
        return;
    }
    for (int l = 1; l < bands; l++)
        weights[l] =
            windows[window].ends && l >= last ? 0 : (float)windows[window].weight(l / last);
}

/* --- minimum squared Laplacian ---------------------------------------------------------------- */

/* Returns l(l+1), minus the eigenvalue of the Laplacian. */
static double eigenvalue(int l) {
    return (double)l * (l + 1);
}

static double laplacian_weight(double mu, int l) {
    return 1 / (1 + mu * eigenvalue(l) * eigenvalue(l));
}

/* Returns the squared Laplacian that remains under the weights of mu. */
static double squared_laplacian(int bands, const double *energy, double mu) {
    double sum = 0;
    for (int l = 0; l < bands; l++) {
        const double part = laplacian_weight(mu, l) * eigenvalue(l);
        sum += part * part * energy[l];
    }
    return sum;
}

void lmp_sh_make_laplacian_window(int bands, float keep, const float *sh, float *weights) {
    assert(lmpi_is_bands(bands));
    assert(keep > 0 && keep <= 1);
    assert(lmpi_are_apart(sh, LMP_SH_COUNT(bands), weights, (size_t)bands));
    double energy[LMP_BANDS_MAX] = { 0 };
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++)
            energy[l] += (double)sh[LMP_SH_INDEX(l, m)] * (double)sh[LMP_SH_INDEX(l, m)];
    const double target = (double)keep * squared_laplacian(bands, energy, 0);
    /* The squared Laplacian falls as mu grows: bracket, then bisect in steps of equal ratio. */
    double low = 0, high = 0;
    if (keep < 1 && target > 0) {
        low = 1e-12, high = 1e-12;
        while (squared_laplacian(bands, energy, high) > target)
            high *= 16;
        for (int step = 0; step < 80; step++) {
            const double middle = sqrt(low * high);
            if (squared_laplacian(bands, energy, middle) > target)
                low = middle;
            else
                high = middle;
        }
    }
    for (int l = 0; l < bands; l++)
        weights[l] = (float)laplacian_weight(high, l);
}

LMPI_INLINE void apply(int bands, const float *weights, const float *sh, float *windowed) {
    LMPI_UNROLL for (int l = 0; l < bands; l++)
        LMPI_UNROLL for (int k = l * l; k < (l + 1) * (l + 1); k++) windowed[k] =
            sh[k] * weights[l];
}

void lmp_sh_apply_window(int bands, const float *weights, const float *sh, float *windowed) {
    assert(lmpi_is_bands(bands));
    assert(lmpi_are_same_or_apart(sh, windowed, LMP_SH_COUNT(bands)));
    LMPI_STRAIGHT_SMALL(bands, apply, weights, sh, windowed)
}
