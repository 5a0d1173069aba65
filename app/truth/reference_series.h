/* SPDX-License-Identifier: MIT */
/* reference_series.h - truncated series of Legendre polynomials around an axis, in double. */
#ifndef LAMPION_TRUTH_REFERENCE_SERIES_H
#define LAMPION_TRUTH_REFERENCE_SERIES_H

#include "app/truth/reference_light.h"

#include <lampion/sh.h>

/* A band limit of reflection; zero: none. */
typedef struct reference_band_limit {
    int bands; /* 0, or 1 … LMP_BANDS_MAX */
    lmp_window window;
    double window_size; /* 0 means bands */
} reference_band_limit;

/* Evaluates Σ_l series_l P_l(cosine). */
double reference_series_at(int bands, const double *series, double cosine);

/* Computes the windowed series, around its axis, of a source with radiance 1: a material without a
 * limit reflects this series as a material with the limit reflects the source. */
void reference_series_of_source(const reference_source *source, const reference_band_limit *limit,
                                double *series);

/* Computes the windowed series of a single direction, around itself. */
void reference_series_of_direction(const reference_band_limit *limit, double *series);

#endif
