/* SPDX-License-Identifier: MIT */
/* brdf_rings.c - a BRDF's series averaged over a cap, on rings around the mirror direction.
 *
 * A ring's azimuths share the sum over l of each order m (paper Eq. 6 with the cap's R_l, Eq. 13);
 * then the orders are summed at every azimuth. */
#include "src/preintegrated/brdf_rings.h"

#include "src/base/host.h"
#include "src/sphere/sphere.h"

#include <stdlib.h>
#include <string.h>

#define ROWS        16 /* rings at a time: their sums of 512 views stay in the second-level cache */
#define TERMS       4  /* terms at a time: one load and one store of the sum for four products */
#define COLUMNS_MIN 4  /* fewest intervals over half a turn: a reading's spline spans three */
#define COLUMNS_MAX 128 /* most intervals, at least one per band */
#define FEW_ORDERS  16  /* orders up to which all are sampled at twice their frequency */

/* --- sets of views ---------------------------------------------------------------------------- */

/* Returns the intervals over the azimuths: a power of two, so that slices can halve it. If there
 * are many orders the last ones are faint, and one interval per order is enough. */
static int columns_for(const brdf_series *series, int orders) {
    int intervals = COLUMNS_MIN;
    while (intervals < COLUMNS_MAX && intervals < (orders <= FEW_ORDERS ? 2 * orders : orders))
        intervals *= 2;
    return series->mirrored ? intervals + 1 : 2 * intervals;
}

lmp_result lmpi_preintegrated_brdf_views(const brdf_series *series, const int *view, size_t count,
                                         int columns, brdf_views *views) {
    const size_t values = LMP_SH_COUNT(series->bands);
    *views = (brdf_views) { .series = series, .count = count };
    views->coefficients =
        lmpi_allocate(&series->host, values * count * 3 * sizeof *views->coefficients);
    if (!views->coefficients)
        return LMP_ERROR_MEMORY;
    for (size_t i = 0; i < count; i++) {
        const float *from = series->coefficients + 3 * values * (size_t)view[i];
        views->view[i] = view[i];
        views->columns[i] = columns ? columns : columns_for(series, series->orders[view[i]]);
        for (size_t c = 0; c < 3; c++)
            for (size_t k = 0; k < values; k++)
                views->coefficients[(k * count + i) * 3 + c] = from[c * values + k];
    }
    return LMP_OK;
}

void lmpi_preintegrated_brdf_views_free(brdf_views *views) {
    lmpi_release(&views->series->host, views->coefficients);
    views->coefficients = NULL;
}

/* --- the sum ---------------------------------------------------------------------------------- */

/* Computes the mean of P_l over the cap, times the solid angles: R_l/R_0 (lobe_fill.c). */
static void cap_means(const brdf_series *series, double half_angle, float *means) {
    const double one_minus_cos = 2 * sin(half_angle / 2) * sin(half_angle / 2);
    const double angle = 2 * LMPI_PREINTEGRATED_PI * one_minus_cos + (double)series->lobe_angle;
    lmpi_cap_polynomials(series->bands, (float)one_minus_cos, means);
    for (int l = 0; l < series->bands; l++)
        means[l] *= (float)(angle * (1 - one_minus_cos / 2));
}

/* Memory of one thread of the sum. A mirrored BRDF's orders have cosines alone; otherwise the sines
 * of order m follow its cosines. */
typedef struct rings {
    const brdf_views *views;
    size_t rows;
    size_t first[LMP_BANDS_MAX]; /* the first view that order m matters to */
    int orders;
    float means[LMP_BANDS_MAX];
    float *basis;                  /* ROWS * bands²: Y_lm at azimuth 0 */
    float *sums;                   /* [order][row][view][channel] */
    float circle[2 * COLUMNS_MAX]; /* cosines over the full circle */
    float *waves;                  /* [order][column]: cosines and sines at the azimuths */
} rings;

/* Returns the index of an order's cosines, or of its sines for negative m. */
static size_t index_of(const rings *r, int m) {
    return r->views->series->mirrored ? (size_t)m : (size_t)(m > 0 ? 2 * m - 1 : -2 * m);
}

/* Adds `terms` rows times their weights, in this order however many are done at once. */
static void add_terms(size_t count, const float *weights, const float *const *from, size_t terms,
                      float *restrict to) {
    if (terms == TERMS) {
        const float *a = from[0], *b = from[1], *c = from[2], *d = from[3];
        for (size_t k = 0; k < count; k++)
            to[k] = to[k] + weights[0] * a[k] + weights[1] * b[k] + weights[2] * c[k] +
                    weights[3] * d[k];
        return;
    }
    for (size_t i = 0; i < terms; i++)
        for (size_t k = 0; k < count; k++)
            to[k] += weights[i] * from[i][k];
}

static size_t terms_of(size_t left) {
    return left < TERMS ? left : TERMS;
}

/* Sums over l for one order; negative orders are the sines. A few bands are done at a time, so that
 * their coefficients are fetched once for all rows. */
static void sum_bands(const rings *r, int m) {
    const size_t width = 3 * r->views->count, bands = (size_t)r->views->series->bands;
    const size_t order = (size_t)abs(m), first = 3 * r->first[order];
    float *sums = r->sums + index_of(r, m) * ROWS * width, weights[TERMS];
    const float *from[TERMS];
    memset(sums, 0, ROWS * width * sizeof *sums);
    for (size_t l = order; l < bands; l += TERMS) {
        const size_t terms = terms_of(bands - l);
        for (size_t i = 0; i < terms; i++) {
            const size_t at = (l + i) * (l + i + 1);
            from[i] = r->views->coefficients + (m < 0 ? at - order : at + order) * width + first;
        }
        for (size_t row = 0; row < r->rows; row++) {
            const float *basis = r->basis + row * bands * bands + order;
            for (size_t i = 0; i < terms; i++)
                weights[i] = r->means[l + i] * basis[(l + i) * (l + i + 1)];
            add_terms(width - first, weights, from, terms, sums + row * width + first);
        }
    }
}

/* Fills in cos(m p) at the azimuths p, or sines for negative m. */
static void order_waves(rings *r, int m, int columns) {
    const int circle = 2 * COLUMNS_MAX;
    const int intervals = r->views->series->mirrored ? 2 * (columns - 1) : columns;
    float *waves = r->waves + index_of(r, m) * 2 * COLUMNS_MAX;
    for (int j = 0; j < columns; j++) {
        const int at = abs(m) * j * (circle / intervals) + (m < 0 ? circle * 3 / 4 : 0);
        waves[j] = r->circle[at % circle];
    }
}

/* Computes one view's values on the rings from the sums of all orders. */
static void add_orders_of(const rings *r, size_t v, size_t row_first, size_t row_count,
                          float *values) {
    const brdf_views *views = r->views;
    const size_t columns = (size_t)views->columns[v], width = 3 * views->count;
    const int orders = views->series->orders[views->view[v]];
    const size_t terms_all = views->series->mirrored ? (size_t)orders : 2 * (size_t)orders - 1;
    float sums[TERMS];
    const float *waves[TERMS];
    for (size_t c = 0; c < 3; c++)
        for (size_t row = 0; row < r->rows; row++) {
            float *to = values + (c * row_count + row_first + row) * columns;
            memset(to, 0, columns * sizeof *to);
            for (size_t k = 0; k < terms_all; k += TERMS) {
                const size_t terms = terms_of(terms_all - k);
                for (size_t i = 0; i < terms; i++) {
                    sums[i] = r->sums[((k + i) * ROWS + row) * width + 3 * v + c];
                    waves[i] = r->waves + (k + i) * 2 * COLUMNS_MAX;
                }
                add_terms(columns, sums, waves, terms, to);
            }
        }
}

static void sum_rows(rings *r, const double *g, size_t row_first, size_t row_count,
                     float *const *values) {
    const brdf_series *series = r->views->series;
    for (size_t i = 0; i < r->rows; i++) {
        const double angle = g[row_first + i];
        lmp_sh_eval(series->bands, (lmp_vec3) { (float)sin(angle), 0, (float)cos(angle) },
                    r->basis + i * LMP_SH_COUNT(series->bands));
    }
    for (int m = 0; m < r->orders; m++) {
        sum_bands(r, m);
        if (m > 0 && !series->mirrored)
            sum_bands(r, -m);
    }
    int columns = 0;
    for (size_t v = 0; v < r->views->count; v++) {
        for (int m = 0; m < r->orders && r->views->columns[v] != columns; m++) {
            order_waves(r, m, r->views->columns[v]);
            if (m > 0 && !series->mirrored)
                order_waves(r, -m, r->views->columns[v]);
        }
        columns = r->views->columns[v];
        add_orders_of(r, v, row_first, row_count, values[v]);
    }
}

lmp_result lmpi_preintegrated_brdf_sum(const brdf_views *views, double angle, const double *g,
                                       size_t rows, float *const *values) {
    const brdf_series *series = views->series;
    rings r = { .views = views, .orders = series->orders[views->view[views->count - 1]] };
    const size_t terms_all = (size_t)(series->mirrored ? r.orders : 2 * r.orders - 1);
    const size_t basis = ROWS * LMP_SH_COUNT(series->bands);
    const size_t sums = terms_all * ROWS * 3 * views->count, waves = terms_all * 2 * COLUMNS_MAX;
    r.basis = lmpi_allocate(&series->host, (basis + sums + waves) * sizeof *r.basis);
    if (!r.basis)
        return LMP_ERROR_MEMORY;
    r.sums = r.basis + basis;
    r.waves = r.sums + sums;
    for (int i = 0; i < 2 * COLUMNS_MAX; i++)
        r.circle[i] = (float)cos(LMPI_PREINTEGRATED_PI * i / COLUMNS_MAX);
    for (int m = 0; m < r.orders; m++)
        while (series->orders[views->view[r.first[m]]] <= m)
            r.first[m]++;
    cap_means(series, angle, r.means);
    for (size_t row = 0; row < rows; row += ROWS) {
        r.rows = rows - row < ROWS ? rows - row : ROWS;
        sum_rows(&r, g, row, rows, values);
    }
    lmpi_release(&series->host, r.basis);
    return LMP_OK;
}
