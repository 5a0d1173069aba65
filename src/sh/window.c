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

/* Returns the mu whose weights leave the fraction `keep` of the squared Laplacian f. By Newton's
 * method for f^(-1/2), which grows with mu and is concave, as a power mean of terms linear in mu:
 * from 0 on, the steps approach the solution from below. */
static double find_mu(int bands, const double *energy, double keep) {
    double mu = 0, target = 0;
    for (int step = 0; step < 100; step++) {
        double f = 0, slope = 0; /* slope: -f'/2 */
        for (int l = 1; l < bands; l++) {
            const double weight = laplacian_weight(mu, l), square = eigenvalue(l) * eigenvalue(l);
            const double part = weight * weight * square * energy[l];
            f += part;
            slope += part * weight * square;
        }
        if (step == 0)
            target = keep * f;
        const double more = f * (sqrt(f / target) - 1) / slope;
        if (!(more > 1e-14 * mu)) /* or NaN, if f is 0 */
            break;
        mu += more;
    }
    return mu;
}

void lmp_sh_make_laplacian_window(int bands, float keep, const float *sh, float *weights) {
    assert(lmpi_is_bands(bands));
    assert(keep > 0 && keep <= 1);
    assert(lmpi_are_apart(sh, LMP_SH_COUNT(bands), weights, (size_t)bands));
    double energy[LMP_BANDS_MAX] = { 0 };
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++)
            energy[l] += (double)sh[LMP_SH_INDEX(l, m)] * (double)sh[LMP_SH_INDEX(l, m)];
    const double mu = find_mu(bands, energy, (double)keep);
    for (int l = 0; l < bands; l++)
        weights[l] = (float)laplacian_weight(mu, l);
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
