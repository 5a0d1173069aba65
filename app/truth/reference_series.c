/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_series.h"

double reference_series_at(int bands, const double *series, double cosine) {
    double before = 0, p = 1, sum = 0;
    for (int l = 0; l < bands; l++) {
        const double next = ((2 * l + 1) * cosine * p - l * before) / (l + 1);
        sum += series[l] * p;
        before = p;
        p = next;
    }
    return sum;
}

/* Uses the library's windowing filter, which tests/unit/window.c verifies. */
void reference_series_of_direction(const reference_band_limit *limit, double *series) {
    float weights[LMP_BANDS_MAX];
    lmp_sh_make_window(limit->bands, limit->window, (float)limit->window_size, weights);
    for (int l = 0; l < limit->bands; l++)
        series[l] = (2 * l + 1) / (4 * REFERENCE_PI) * (double)weights[l];
}

/* ∫ P_l over the cap = 2 pi (P_(l-1)(c) - P_(l+1)(c)) / (2l+1), c = cos a. The differences have a
 * recurrence of their own, because subtraction would cancel for small caps: with t = 1 - c, P_(l+1)
 * - P_l = l/(l+1) (P_l - P_(l-1)) - (2l+1)/(l+1) t P_l. */
void reference_series_of_source(const reference_source *source, const reference_band_limit *limit,
                                double *series) {
    const double t = source->one_minus_cos;
    double p = 1, before = 0; /* P_l, and P_l - P_(l-1) */
    reference_series_of_direction(limit, series);
    for (int l = 0; l < limit->bands; l++) {
        const double next = l / (l + 1.0) * before - (2 * l + 1) / (l + 1.0) * t * p;
        const double cap =
            l == 0 ? source->solid_angle : -2 * REFERENCE_PI * (before + next) / (2 * l + 1);
        series[l] *= source->solid_angle > 0 ? cap : 1;
        p += next;
        before = next;
    }
}
