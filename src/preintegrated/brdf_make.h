/* SPDX-License-Identifier: MIT */
/* measured_make.h - the making of a measured material's response: its nodes, then its slices. */
#ifndef LAMPION_PREINTEGRATED_BRDF_MAKE_H
#define LAMPION_PREINTEGRATED_BRDF_MAKE_H

#include "src/preintegrated/brdf.h"

/* lmp_preintegrated_brdf_row in double, its inverse, lmp_preintegrated_brdf_rim, and the half angle
 * at a step. */
double lmp_preintegrated_brdf_row_of(const brdf_series *series, double x);
double lmp_preintegrated_brdf_x_of(const brdf_series *series, double s);
double lmp_preintegrated_brdf_rim_of(const brdf_series *series, double a);
double lmp_preintegrated_brdf_angle_at(int step);

/* The steps of the half angle, and of the view, to hold; their number, or 0: no memory. */
int lmp_preintegrated_brdf_caps(const brdf_series *series, const lmp_preintegrated_brdf_desc *desc,
                                int *nodes);
int lmp_preintegrated_brdf_view_nodes(const brdf_series *series,
                                      const lmp_preintegrated_brdf_desc *desc, int *nodes);

/* Sets reach and slope of the series: the fewest rows that keep the values. False: no memory. */
bool lmp_preintegrated_brdf_rows(brdf_series *series, float error);

/* One half angle's slices, of all views: texels in its own memory. */
typedef struct brdf_column {
    lmp_preintegrated_brdf_slice *slices; /* of every view; first counts from 0 */
    int16_t *texels;
    size_t texel_count;
} brdf_column;

/* The slices of cap node `index` of `count`; false: no memory. */
bool lmp_preintegrated_brdf_slices(const brdf_views *views, const int *caps, int count, int index,
                                   float error, brdf_column *column);
void lmp_preintegrated_brdf_column_free(const brdf_series *series, brdf_column *column);

#endif
