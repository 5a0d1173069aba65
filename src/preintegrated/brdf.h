/* SPDX-License-Identifier: MIT */
/* measured.h - the inside of a measured material's response: series in the frames of the mirror
 * directions, then nodes and slices from them, then reading. */
#ifndef LAMPION_PREINTEGRATED_BRDF_H
#define LAMPION_PREINTEGRATED_BRDF_H

#include "src/preintegrated/lobe_eval.h"

/* Views and half angles are chosen among so many steps. */
#define BRDF_STEPS_MAX 1024
#define BRDF_CAP_STEPS 128
/* Kernels count three numbers a texel in 31 bits. */
#define BRDF_TEXELS_MAX ((size_t)INT32_MAX / 3)
/* Errors are relative to a view's largest value, but at least this part of all views'. */
#define LMP_PREINTEGRATED_BRDF_FLOOR 0.05

/* One allocation: this, then what info points to. */
struct lmp_preintegrated_brdf {
    lmp_allocator allocator;
    lmp_preintegrated_brdf_info info;
    float view_remap[BRDF_STEPS_MAX + 1], cap_remap[BRDF_STEPS_MAX + 1];
    lmp_rgb *ambient;
    lmp_preintegrated_brdf_slice *slices;
    int16_t *texels;
};

/* A response like `plan`, whose info gives view_count, cap_count and texel_count; warps copied, the
 * rest not yet set. */
lmp_result lmp_preintegrated_brdf_allocate(const lmp_allocator *allocator,
                                           const lmp_preintegrated_brdf *plan,
                                           lmp_preintegrated_brdf **response);

/* Where the rim of a cap shows: at its half angle, but a cap smaller than the lobe moves nothing.
 */
static inline float lmp_preintegrated_brdf_rim(float radius, float a) {
    return a * a / (sqrtf(a * a + radius * radius) + radius);
}

/* The row coordinate of x, the angle from the rim, but for density and origin. */
static inline float lmp_preintegrated_brdf_row(float width, float reach, float slope, float x) {
    return x * (reach / (width * sqrtf(x * x + reach * reach)) + slope);
}

/* cap_remap's argument: finer steps for small lights. */
static inline float lmp_preintegrated_brdf_cap(float a) {
    const float quarter = (float)(LMP_PREINTEGRATED_LOBE_PI / 2);
    return a / (a + 0.5f) * ((quarter + 0.5f) / quarter);
}

/* --- the series ----------------------------------------------------------------------------------
 */

/* A table's coefficients at some views, each in its lobe's frame: z the mirror direction, x in the
 * plane of incidence on the side of the normal. Cut where the rest is negligible. */
typedef struct brdf_series {
    lmp_allocator heap;
    int bands;                    /* that matter */
    int steps;                    /* of the quarter turn */
    int view_count;               /* the table's own among them, up to 512 */
    int step[BRDF_STEPS_MAX + 1]; /* of a view, theta_o = step pi/2 / steps; rising, 0 … steps */
    bool mirrored;
    float width, radius, lobe_angle;
    float reach, slope;             /* of the rows, by lmp_preintegrated_brdf_rows */
    float *coefficients;            /* [view][channel][bands²] */
    int orders[BRDF_STEPS_MAX + 1]; /* m < orders matter; rising */
    lmp_rgb ambient[BRDF_STEPS_MAX + 1];
} brdf_series;

/* desc: with its defaults in place. */
lmp_result lmp_preintegrated_brdf_series(const lmp_allocator *allocator,
                                         const lmp_brdf_table *table,
                                         const lmp_preintegrated_brdf_desc *desc,
                                         brdf_series *series);
void lmp_preintegrated_brdf_series_free(brdf_series *series);

/* The last of the views that is not past part / parts of the quarter turn. */
int lmp_preintegrated_brdf_view_at(const brdf_series *series, int part, int parts);

/* Some of the views, in rising order, side by side. */
typedef struct brdf_views {
    const brdf_series *series;
    size_t count;
    int view[BRDF_STEPS_MAX + 1]; /* of the series */
    int columns[BRDF_STEPS_MAX +
                1];      /* azimuths: of half a turn and both its ends, or a full turn */
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
