/* SPDX-License-Identifier: MIT */
/* measured.h - the inside of a measured material's response: series in the frames of the mirror
 * directions, then nodes and slices from them, then reading. */
#ifndef LAMPION_RESPONSE_MEASURED_H
#define LAMPION_RESPONSE_MEASURED_H

#include "src/response/eval.h"

/* Views and half angles are chosen among so many steps. */
#define MEASURED_STEPS_MAX 1024
#define MEASURED_CAP_STEPS 128
/* Kernels count three numbers a texel in 31 bits. */
#define MEASURED_TEXELS_MAX ((size_t)INT32_MAX / 3)
/* Errors are relative to a view's largest value, but at least this part of all views'. */
#define LMP_MEASURED_FLOOR 0.05

/* One allocation: this, then what info points to. */
struct lmp_brdf_response {
    lmp_allocator allocator;
    lmp_brdf_response_info info;
    float view_warp[MEASURED_STEPS_MAX + 1], cap_warp[MEASURED_STEPS_MAX + 1];
    lmp_rgb *ambient;
    lmp_brdf_response_slice *slices;
    int16_t *texels;
};

/* A response like `plan`, whose info gives view_count, cap_count and texel_count; warps copied, the
 * rest not yet set. */
lmp_result lmp_measured_allocate(const lmp_allocator *allocator, const lmp_brdf_response *plan,
                                 lmp_brdf_response **response);

/* Where the rim of a cap shows: at its half angle, but a cap smaller than the lobe moves nothing.
 */
static inline float lmp_measured_rim(float radius, float a) {
    return a * a / (sqrtf(a * a + radius * radius) + radius);
}

/* The row coordinate of x, the angle from the rim, but for density and origin. */
static inline float lmp_measured_row(float width, float reach, float slope, float x) {
    return x * (reach / (width * sqrtf(x * x + reach * reach)) + slope);
}

/* cap_warp's argument: finer steps for small lights. */
static inline float lmp_measured_cap(float a) {
    const float quarter = (float)(LMP_RESPONSE_PI / 2);
    return a / (a + 0.5f) * ((quarter + 0.5f) / quarter);
}

/* --- the series ----------------------------------------------------------------------------------
 */

/* A table's coefficients at some views, each in its lobe's frame: z the mirror direction, x in the
 * plane of incidence on the side of the normal. Cut where the rest is negligible. */
typedef struct measured_series {
    lmp_allocator heap;
    int bands;      /* that matter */
    int steps;      /* of the quarter turn */
    int view_count; /* the table's own among them, up to 512 */
    int step[MEASURED_STEPS_MAX +
             1]; /* of a view, theta_o = step pi/2 / steps; rising, 0 … steps */
    bool mirrored;
    float width, radius, lobe_angle;
    float reach, slope;                 /* of the rows, by lmp_measured_rows */
    float *coefficients;                /* [view][channel][bands²] */
    int orders[MEASURED_STEPS_MAX + 1]; /* m < orders matter; rising */
    lmp_rgb ambient[MEASURED_STEPS_MAX + 1];
} measured_series;

/* desc: with its defaults in place. */
lmp_result lmp_measured_series(const lmp_allocator *allocator, const lmp_brdf_table *table,
                               const lmp_brdf_response_desc *desc, measured_series *series);
void lmp_measured_series_free(measured_series *series);

/* The last of the views that is not past part / parts of the quarter turn. */
int lmp_measured_view_at(const measured_series *series, int part, int parts);

/* Some of the views, in rising order, side by side. */
typedef struct measured_views {
    const measured_series *series;
    size_t count;
    int view[MEASURED_STEPS_MAX + 1]; /* of the series */
    int columns[MEASURED_STEPS_MAX +
                1];      /* azimuths: of half a turn and both its ends, or a full turn */
    float *coefficients; /* [l² + l + m][view][channel] */
} measured_views;

/* columns 0: as many as each view's orders ask for. */
lmp_result lmp_measured_views(const measured_series *series, const int *view, size_t count,
                              int columns, measured_views *views);
void lmp_measured_views_free(measured_views *views);

/* The scaled mean over the cap of a half angle, at `rows` angles g from the mirror direction (any
 * number: below 0 and past pi the circle goes on): values[i] receives [channel][row][column] of
 * view i of the set. */
lmp_result lmp_measured_sum(const measured_views *views, double angle, const double *g, size_t rows,
                            float *const *values);

#endif
