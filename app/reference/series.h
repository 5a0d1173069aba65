/* SPDX-License-Identifier: MIT */
/* series.h - truncated series of Legendre polynomials around an axis, in double. */
#ifndef LAMPION_REFERENCE_SERIES_H
#define LAMPION_REFERENCE_SERIES_H

#include "app/reference/light.h"

#include <lampion/sh.h>

/* Band limit of what reflects. Zero: none. */
typedef struct reference_band_limit {
    int bands; /* 0, or 1 … LMP_BANDS_MAX */
    lmp_window window;
    double window_size; /* 0 means bands */
} reference_band_limit;

/* Σ_l series_l P_l(cosine). */
double reference_series_at(int bands, const double *series, double cosine);

/* The windowed series of a source of radiance 1 around its axis: what a material of no limit makes
 * of it is what the material in the limit makes of the source. */
void reference_series_of_source(const reference_source *source, const reference_band_limit *limit,
                                double *series);

/* The same of a single direction, around it. */
void reference_series_of_direction(const reference_band_limit *limit, double *series);

#endif
