/* SPDX-License-Identifier: MIT */
/* brdf_nodes.c - chooses the views and the half angles of caps that a preintegrated BRDF holds:
 * steps between which its values are linear, to a fraction of the error. */
#include "src/preintegrated/brdf_nodes.h"

#include "src/base/host.h"
#include "src/preintegrated/brdf_rings.h"
#include "src/preintegrated/brdf_rows.h"

#include <string.h>

/* The constants were measured like those of brdf_thin.h: two probes or eight intervals increase the
 * error (rms 0.034 % in place of 0.031 %, gold paint); half or twice the columns and rows do not
 * change it. */
#define PROBES    4
#define COLUMNS   8   /* intervals of half a circle */
#define STEP      0.7 /* of the row coordinate */
#define TOLERANCE 0.3 /* fraction of the error */
#define INTERVALS 16  /* the fewest */

/* Values at every node that may be chosen, and every probe: nodes are views and probes half angles,
 * or nodes are half angles and probes views. */
typedef struct probes {
    const brdf_series *series;
    int last;                     /* the last node */
    int step[BRDF_STEPS_MAX + 1]; /* the step of each node */
    size_t rows, columns, size;   /* size of a node's values at one probe: 3 rows columns */
    double *x;                    /* coordinates of the rows, from the rim */
    float *values;                /* [node][probe][channel][row][column] */
    double rim[BRDF_STEPS_MAX + 1][PROBES]; /* angles of the caps' rims */
    double task_angle[BRDF_STEPS_MAX + 1];
    brdf_views views;
    float peaks[BRDF_STEPS_MAX + 1][PROBES]; /* largest values, at least the floor */
    bool by_cap;                             /* steps are half angles */
} probes;

/* --- probing ---------------------------------------------------------------------------------- */

static float *values_at(const probes *p, size_t node, size_t probe) {
    return p->values + (node * PROBES + probe) * p->size;
}

/* Computes the values of one half angle: of a node with all probes, or of a probe with all nodes.
 */
static lmp_result probe_task(size_t index, void *data) {
    probes *p = data;
    float *values[BRDF_STEPS_MAX + 1];
    const double angle = p->task_angle[index],
                 rim = lmpi_preintegrated_brdf_rim_of(p->series, angle);
    double *g = lmpi_allocate(&p->series->host, p->rows * sizeof *g);
    if (!g)
        return LMP_ERROR_MEMORY;
    for (size_t i = 0; i < p->rows; i++)
        g[i] = p->x[i] + rim;
    for (size_t v = 0; v < p->views.count; v++) {
        const size_t node = p->by_cap ? index : v, probe = p->by_cap ? v : index;
        values[v] = values_at(p, node, probe);
        p->rim[node][probe] = rim;
    }
    const lmp_result result = lmpi_preintegrated_brdf_sum(&p->views, angle, g, p->rows, values);
    lmpi_release(&p->series->host, g);
    return result;
}

static lmp_result sum_probes(probes *p, double from, double to, size_t tasks) {
    const brdf_series *series = p->series;
    const double first =
        floor(lmpi_preintegrated_brdf_row_of(series, -LMPI_PREINTEGRATED_PI / 2) / STEP);
    const double last = ceil(lmpi_preintegrated_brdf_row_of(series, LMPI_PREINTEGRATED_PI) / STEP);
    p->rows = (size_t)(last - first) + 1;
    p->columns = (size_t)p->views.columns[0];
    p->size = 3 * p->rows * p->columns;
    p->x = lmpi_allocate(&series->host, p->rows * sizeof *p->x);
    p->values =
        lmpi_allocate(&series->host, ((size_t)p->last + 1) * PROBES * p->size * sizeof *p->values);
    if (!p->x || !p->values)
        return LMP_ERROR_MEMORY;
    for (size_t i = 0; i < p->rows; i++)
        p->x[i] = lmpi_preintegrated_brdf_x_of(series, STEP * (first + (double)i));
    return lmpi_host_run(&series->host, from, to, tasks, probe_task, p);
}

/* --- choosing --------------------------------------------------------------------------------- */

/* Whether a row lies on the sphere itself, g in 0 … pi. */
static bool row_counts(const probes *p, size_t row, double rim) {
    const double g = p->x[row] + rim;
    return g >= 0 && g <= LMPI_PREINTEGRATED_PI;
}

/* Returns how far the values of node `middle` are from the line between `low` and `high`. */
static float error_at(const probes *p, int low, int high, int middle, size_t probe) {
    const float *a = values_at(p, (size_t)low, probe), *b = values_at(p, (size_t)high, probe);
    const float *v = values_at(p, (size_t)middle, probe);
    const float t = (float)(p->step[middle] - p->step[low]) / (float)(p->step[high] - p->step[low]);
    float error = 0;
    for (size_t row = 0; row < 3 * p->rows; row++) {
        if (!row_counts(p, row % p->rows, p->rim[middle][probe]))
            continue;
        for (size_t i = row * p->columns; i < (row + 1) * p->columns; i++) {
            const float off = fabsf(a[i] + t * (b[i] - a[i]) - v[i]);
            error = off > error ? off : error;
        }
    }
    return error;
}

static void find_peaks(probes *p) {
    for (int node = 0; node <= p->last; node++)
        for (size_t probe = 0; probe < PROBES; probe++) {
            const float *v = values_at(p, (size_t)node, probe);
            float peak = 0;
            for (size_t row = 0; row < 3 * p->rows; row++)
                for (size_t i = row * p->columns; i < (row + 1) * p->columns; i++)
                    if (row_counts(p, row % p->rows, p->rim[node][probe]))
                        peak = fmaxf(peak, fabsf(v[i]));
            p->peaks[node][probe] = peak;
        }
    /* The floor is of all views: these are the probes of a node, or the nodes of a probe. */
    for (int node = 0; node <= p->last; node++)
        for (size_t probe = 0; probe < PROBES; probe++) {
            float all = 0;
            for (size_t k = 0; k < PROBES && p->by_cap; k++)
                all = fmaxf(all, p->peaks[node][k]);
            for (int k = 0; k <= p->last && !p->by_cap; k++)
                all = fmaxf(all, p->peaks[k][probe]);
            p->peaks[node][probe] =
                fmaxf(p->peaks[node][probe], (float)LMPI_PREINTEGRATED_BRDF_FLOOR * all);
        }
}

static void divide(const probes *p, int low, int high, float tolerance, bool *chosen) {
    bool close = p->step[high] - p->step[low] <= p->step[p->last] / INTERVALS;
    for (int middle = low + 1; close && middle < high; middle++)
        for (size_t probe = 0; close && probe < PROBES; probe++)
            close = error_at(p, low, high, middle, probe) <= tolerance * p->peaks[middle][probe];
    if (close || high - low == 1)
        return;
    const int middle = low + (high - low) / 2;
    chosen[middle] = true;
    divide(p, low, middle, tolerance, chosen);
    divide(p, middle, high, tolerance, chosen);
}

static int choose(probes *p, float error, int *nodes) {
    bool chosen[BRDF_STEPS_MAX + 1] = { false };
    int count = 0;
    find_peaks(p);
    chosen[0] = chosen[p->last] = true;
    divide(p, 0, p->last, (float)TOLERANCE * error, chosen);
    for (int i = 0; i <= p->last; i++)
        if (chosen[i])
            nodes[count++] = i;
    return count;
}

static void release(probes *p) {
    lmpi_release(&p->series->host, p->x);
    lmpi_release(&p->series->host, p->values);
    if (p->views.coefficients)
        lmpi_preintegrated_brdf_views_free(&p->views);
    lmpi_release(&p->series->host, p);
}

static probes *create(const brdf_series *series, int last, bool by_cap) {
    probes *p = lmpi_allocate(&series->host, sizeof *p);
    if (p)
        memset(p, 0, sizeof *p);
    if (p) {
        p->series = series;
        p->last = last;
        p->by_cap = by_cap;
        for (int i = 0; i <= last; i++)
            p->step[i] = by_cap ? i : series->step[i];
    }
    return p;
}

static int probe_columns(const brdf_series *series) {
    return series->mirrored ? COLUMNS + 1 : 2 * COLUMNS;
}

lmp_result lmpi_preintegrated_brdf_caps(const brdf_series *series, float error, int *nodes,
                                        int *count) {
    probes *p = create(series, BRDF_CAP_STEPS, true);
    if (!p)
        return LMP_ERROR_MEMORY;
    const int views[PROBES] = {
        lmpi_preintegrated_brdf_view_at(series, 1, 4),
        lmpi_preintegrated_brdf_view_at(series, 3, 4),
        lmpi_preintegrated_brdf_view_at(series, 9, 10),
        lmpi_preintegrated_brdf_view_at(series, 39, 40),
    };
    for (int i = 0; i <= p->last; i++)
        p->task_angle[i] = lmpi_preintegrated_brdf_angle_at(i);
    lmp_result result =
        lmpi_preintegrated_brdf_views(series, views, PROBES, probe_columns(series), &p->views);
    if (result == LMP_OK)
        result = sum_probes(p, BRDF_SERIES_DONE, BRDF_CAPS_DONE, (size_t)p->last + 1);
    if (result == LMP_OK)
        *count = choose(p, error, nodes);
    release(p);
    return result;
}

lmp_result lmpi_preintegrated_brdf_view_nodes(const brdf_series *series, float error, int *nodes,
                                              int *count) {
    static const int caps[PROBES] = { 0, BRDF_CAP_STEPS / 8, BRDF_CAP_STEPS / 3,
                                      BRDF_CAP_STEPS * 3 / 4 };
    probes *p = create(series, series->view_count - 1, false);
    int all[BRDF_STEPS_MAX + 1];
    if (!p)
        return LMP_ERROR_MEMORY;
    for (int i = 0; i < series->view_count; i++)
        all[i] = i;
    for (int i = 0; i < PROBES; i++)
        p->task_angle[i] = lmpi_preintegrated_brdf_angle_at(caps[i]);
    lmp_result result = lmpi_preintegrated_brdf_views(series, all, (size_t)series->view_count,
                                                      probe_columns(series), &p->views);
    if (result == LMP_OK)
        result = sum_probes(p, BRDF_CAPS_DONE, BRDF_NODES_DONE, PROBES);
    if (result == LMP_OK)
        *count = choose(p, error, nodes);
    release(p);
    return result;
}
