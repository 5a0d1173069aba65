/* SPDX-License-Identifier: MIT */
/* brdf_series.h - a BRDF's series in the frames of its mirror directions, and their sums on rings
 * around them (brdf_rings.c). */
#ifndef LAMPION_PREINTEGRATED_BRDF_SERIES_H
#define LAMPION_PREINTEGRATED_BRDF_SERIES_H

#include "src/preintegrated/brdf.h"

/* A table's coefficients at some views, each in its lobe's frame: z the mirror direction, x in the
 * plane of incidence on the side of the normal. Truncated where the rest is negligible. */
typedef struct brdf_series {
    lmp_host host;
    int bands;                    /* that matter */
    int steps;                    /* of the quarter circle */
    int view_count;               /* the table's own among them, up to 512 */
    int step[BRDF_STEPS_MAX + 1]; /* of a view, theta_o = step pi/2 / steps; rising, 0 … steps */
    bool mirrored;
    float width, radius, lobe_angle;
    float reach, slope;             /* of the rows, by lmp_preintegrated_brdf_choose_rows */
    float *coefficients;            /* [view][channel][bands²] */
    int orders[BRDF_STEPS_MAX + 1]; /* m < orders matter; rising */
    lmp_rgb ambient[BRDF_STEPS_MAX + 1];
} brdf_series;

/* What part of the work of making a preintegrated BRDF is done after each of its steps. */
#define BRDF_TRUNCATION_DONE 0.03
#define BRDF_SERIES_DONE     0.1
#define BRDF_CAPS_DONE       0.2
#define BRDF_NODES_DONE      0.3

/* host must be resolved. */
lmp_result lmp_preintegrated_brdf_series(const lmp_host *host, float error,
                                         const lmp_brdf_table *table, brdf_series *series);
void lmp_preintegrated_brdf_series_free(brdf_series *series);

/* The last of the views that is not past part / parts of the quarter circle. */
int lmp_preintegrated_brdf_view_at(const brdf_series *series, int part, int parts);

/* Some of the views, in rising order, interleaved. */
typedef struct brdf_views {
    const brdf_series *series;
    size_t count;
    int view[BRDF_STEPS_MAX + 1]; /* of the series */
    int columns[BRDF_STEPS_MAX +
                1];      /* azimuths: of half a circle and both its ends, or a full circle */
    float *coefficients; /* [l² + l + m][view][channel] */
} brdf_views;

/* columns 0: as many as each view's orders ask for. */
lmp_result lmp_preintegrated_brdf_views(const brdf_series *series, const int *view, size_t count,
                                        int columns, brdf_views *views);
void lmp_preintegrated_brdf_views_free(brdf_views *views);

/* The scaled mean over the cap of a half angle, at `rows` angles g from the mirror direction (any
 * number: below 0 and past pi the circle goes on): values[i] receives [channel][row][column] of
 * view i of the set. */
lmp_result lmp_preintegrated_brdf_sum(const brdf_views *views, double angle, const double *g,
                                      size_t rows, float *const *values);

#endif
