/* SPDX-License-Identifier: MIT */
/* brdf_rows.h - the rows of the slices of a preintegrated BRDF. */
#ifndef LAMPION_PREINTEGRATED_BRDF_ROWS_H
#define LAMPION_PREINTEGRATED_BRDF_ROWS_H

#include "src/preintegrated/brdf_series.h"

/* Compute the row coordinate of an angle from the rim and its inverse, the angle of the rim, and
 * the half angle at a step, in double and by the formulas of readings (reading.h). */
double lmpi_preintegrated_brdf_row_of(const brdf_series *series, double x);
double lmpi_preintegrated_brdf_x_of(const brdf_series *series, double s);
double lmpi_preintegrated_brdf_rim_of(const brdf_series *series, double a);
double lmpi_preintegrated_brdf_angle_at(int step);

/* Sets reach and slope of the series to those with the fewest rows that keep the values. */
lmp_result lmpi_preintegrated_brdf_choose_rows(brdf_series *series, float error);

#endif
