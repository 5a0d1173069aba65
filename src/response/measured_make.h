/* SPDX-License-Identifier: MIT */
/* measured_make.h - the making of a measured material's response: its nodes, then its slices. */
#ifndef LAMPION_RESPONSE_MEASURED_MAKE_H
#define LAMPION_RESPONSE_MEASURED_MAKE_H

#include "src/response/measured.h"

/* lmp_measured_row in double, its inverse, lmp_measured_rim, and the half angle at a step. */
double lmp_measured_row_of(const measured_series *series, double x);
double lmp_measured_x_of(const measured_series *series, double s);
double lmp_measured_rim_of(const measured_series *series, double a);
double lmp_measured_angle_at(int step);

/* The steps of the half angle, and of the view, to hold; their number, or 0: no memory. */
int lmp_measured_caps(const measured_series *series, const lmp_brdf_response_desc *desc,
                      int *nodes);
int lmp_measured_view_nodes(const measured_series *series, const lmp_brdf_response_desc *desc,
                            int *nodes);

/* Sets reach and slope of the series: the fewest rows that keep the values. False: no memory. */
bool lmp_measured_rows(measured_series *series, float error);

/* One half angle's slices, of all views: texels in its own memory. */
typedef struct measured_column {
    lmp_brdf_response_slice *slices; /* of every view; first counts from 0 */
    int16_t *texels;
    size_t texel_count;
} measured_column;

/* The slices of cap node `index` of `count`; false: no memory. */
bool lmp_measured_slices(const measured_views *views, const int *caps, int count, int index,
                         float error, measured_column *column);
void lmp_measured_column_free(const measured_series *series, measured_column *column);

#endif
