/* SPDX-License-Identifier: MIT */
#include <lampion/sh.h>

#include <assert.h>
#include <math.h>

static const double pi = 3.14159265358979323846;

static double window_weight(lmp_window window, double place) {
    if (window == LMP_WINDOW_NONE || place == 0)
        return 1;
    if (place >= 1)
        return 0;
    return window == LMP_WINDOW_HANNING ? (1 + cos(pi * place)) / 2
                                        : sin(pi * place) / (pi * place);
}

void lmp_sh_window(int bands, lmp_window window, float size, float *weights) {
    assert(bands >= 1 && bands <= LMP_BANDS_MAX);
    assert(size >= 0);
    const double last = size > 0 ? (double)size : bands;
    for (int l = 0; l < bands; l++)
        weights[l] = (float)window_weight(window, l / last);
}

/* --- minimum squared Laplacian ---------------------------------------------------------------- */

/* l(l+1), minus the eigenvalue of the Laplacian. */
static double eigenvalue(int l) {
    return (double)l * (l + 1);
}

static double laplacian_weight(double mu, int l) {
    return 1 / (1 + mu * eigenvalue(l) * eigenvalue(l));
}

/* What is left of the squared Laplacian under the weights of mu. */
static double squared_laplacian(int bands, const double *energy, double mu) {
    double sum = 0;
    for (int l = 0; l < bands; l++) {
        const double part = laplacian_weight(mu, l) * eigenvalue(l);
        sum += part * part * energy[l];
    }
    return sum;
}

void lmp_sh_window_laplacian(int bands, float keep, const float *sh, float *weights) {
    assert(bands >= 1 && bands <= LMP_BANDS_MAX);
    assert(keep > 0 && keep <= 1);
    double energy[LMP_BANDS_MAX] = { 0 };
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++)
            energy[l] += (double)sh[LMP_SH_INDEX(l, m)] * (double)sh[LMP_SH_INDEX(l, m)];
    const double target = (double)keep * squared_laplacian(bands, energy, 0);
    /* It falls as mu grows: bracket, then bisect in steps of equal ratio. */
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

void lmp_sh_window_apply(int bands, const float *weights, const float *sh, float *windowed) {
    assert(bands >= 1 && bands <= LMP_BANDS_MAX);
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++)
            windowed[LMP_SH_INDEX(l, m)] = sh[LMP_SH_INDEX(l, m)] * weights[l];
}
