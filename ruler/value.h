/* SPDX-License-Identifier: MIT */
/* value.h - the radiance that a configuration reflects. */
#ifndef LAMPION_RULER_VALUE_H
#define LAMPION_RULER_VALUE_H

#include "ruler/lobe.h"

/* What a white diffuse surface that faces the light reflects, at most: the scale of a value. */
double ruler_scale(const ruler_configuration *configuration);

/* Its radius at most `relative` of it, or of a millionth of the scale if it is less than that. */
void ruler_value(arb_t value, const ruler_configuration *configuration, double relative);

/* The bands that a zonal lobe is truncated to, each without a filter and with Hanning's. */
#define RULER_BAND_COUNTS 5
extern const int ruler_band_counts[RULER_BAND_COUNTS];

/* The same of a zonal lobe truncated to so many bands. */
void ruler_value_of_bands(arb_t value, const ruler_configuration *configuration, int bands,
                          bool hanning);

#endif
