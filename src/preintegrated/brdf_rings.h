/* SPDX-License-Identifier: MIT */
/* brdf_rings.h - sums of a BRDF's series on rings around its mirror directions. */
#ifndef LAMPION_PREINTEGRATED_BRDF_RINGS_H
#define LAMPION_PREINTEGRATED_BRDF_RINGS_H

#include "src/preintegrated/brdf_series.h"

/* Some of a series' views, in ascending order, interleaved. */
typedef struct brdf_views {
    const brdf_series *series;
    size_t count;
    int view[BRDF_STEPS_MAX + 1];    /* index in the series */
    int columns[BRDF_STEPS_MAX + 1]; /* azimuths of a circle, or of half with both ends */
    float *coefficients;             /* [l² + l + m][view][channel] */
} brdf_views;

/* Interleaves some views. columns 0 means as many as each view's orders need. */
lmp_result lmpi_preintegrated_brdf_views(const brdf_series *series, const int *view, size_t count,
                                         int columns, brdf_views *views);
void lmpi_preintegrated_brdf_views_free(brdf_views *views);

/* Computes the scaled mean over the cap of a half angle, at `rows` angles g from the mirror
 * direction (any number: below 0 and past pi the circle goes on): values[i] receives
 * [channel][row][column] of view i of the set. */
lmp_result lmpi_preintegrated_brdf_sum(const brdf_views *views, double angle, const double *g,
                                       size_t rows, float *const *values);

#endif
