/* SPDX-License-Identifier: MIT */
/* brdf_series.h - a BRDF's series in the frames of its mirror directions. */
#ifndef LAMPION_PREINTEGRATED_BRDF_SERIES_H
#define LAMPION_PREINTEGRATED_BRDF_SERIES_H

#include "src/preintegrated/brdf.h"

/* A table's coefficients at some views, each in its lobe's frame: z is the mirror direction, and x
 * lies in the plane of incidence on the side of the normal. Bands and orders are truncated where
 * the rest is negligible. */
typedef struct brdf_series {
    lmp_host host;
    int bands;                    /* the bands that matter */
    int steps;                    /* steps of the quarter circle */
    int view_count;               /* among them the table's own views, up to 512 */
    int step[BRDF_STEPS_MAX + 1]; /* per view, theta_o = step pi/2 / steps; ascending, 0 … steps */
    bool mirrored;
    float width, radius, lobe_angle;
    float reach, slope;             /* of the rows, by lmpi_preintegrated_brdf_choose_rows */
    float *coefficients;            /* [view][channel][bands²] */
    int orders[BRDF_STEPS_MAX + 1]; /* orders m < orders matter, per view; ascending */
    lmp_rgb ambient[BRDF_STEPS_MAX + 1];
} brdf_series;

/* The fraction of the work of making a preintegrated BRDF that is done after each of its stages. */
#define BRDF_TRUNCATION_DONE 0.03
#define BRDF_SERIES_DONE     0.1
#define BRDF_CAPS_DONE       0.2
#define BRDF_NODES_DONE      0.3

/* Makes the series of a table. The host must be resolved. */
lmp_result lmpi_preintegrated_brdf_series(const lmp_host *host, float error,
                                          const lmp_brdf_table *table, brdf_series *series);
void lmpi_preintegrated_brdf_series_free(brdf_series *series);

/* Returns the last of the views that is not past part / parts of the quarter circle. */
int lmpi_preintegrated_brdf_view_at(const brdf_series *series, int part, int parts);

#endif
