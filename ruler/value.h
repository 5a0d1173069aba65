/* SPDX-License-Identifier: MIT */
/* value.h - computes the radiance that a configuration reflects. */
#ifndef LAMPION_RULER_VALUE_H
#define LAMPION_RULER_VALUE_H

#include "ruler/lobe.h"

/* Returns the most that a white diffuse surface facing the light reflects: the scale of a value. */
double ruler_scale(const ruler_configuration *configuration);

/* Computes the reflected radiance with a radius of at most `relative` times it, or times a
 * millionth of the scale if that is more. */
void ruler_value(arb_t value, const ruler_configuration *configuration, double relative);

/* The bands that a zonal lobe is truncated to, each without a filter and with Hanning's. */
#define RULER_BAND_COUNTS 5
extern const int ruler_band_counts[RULER_BAND_COUNTS];

/* Computes the radiance that a zonal lobe truncated to `bands` bands reflects. */
void ruler_value_of_bands(arb_t value, const ruler_configuration *configuration, int bands,
                          bool hanning);

#endif
