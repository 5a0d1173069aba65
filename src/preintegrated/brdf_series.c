/* SPDX-License-Identifier: MIT */
/* brdf_series.c - a table's series seen from the mirror direction, summed on rings around it.
 *
 * There a lobe is nearly round, so few orders m matter but at grazing views; and a ring's azimuths
 * share the sum over l (paper Eq. 6 with the cap's R_l, Eq. 13). */
#include "src/preintegrated/brdf.h"

#include "src/base/allocator.h"
#include "src/base/parallel.h"
#include "src/light/cap.h"

#include <stdlib.h>
#include <string.h>

#define TAIL_BANDS  0.06 /* of the error: what the bands left out may reach */
#define TAIL_ORDERS 0.12
#define CUT_VIEWS   32     /* that decide how many bands matter */
#define STEPS_BANDS 40     /* up to which every step of the view is turned */
#define STEPS_FEW   256    /* about as many as are turned of more bands, and */
#define STEPS_LAST  0.9375 /* all of this share of the views on */
#define SAMPLES_MIN 16     /* and two a band */
#define WIDTH       1.2f   /* of the finest detail, times the bands */
#define ROWS        16     /* rings at a time */
#define TERMS       4      /* of a sum at a time */
#define COLUMNS_MIN 4
#define FEW_ORDERS  16
#define COLUMNS_MAX 128

/* --- the coefficients ---------------------------------------------------------------------------
 */

/* One channel of a view on the full layout l² + l + m, `bands` bands of it. */
static void expand(const lmp_brdf_table_info *info, const float *plane, int bands, float *sh) {
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++) {
            const int half = l * (l + 1) / 2 + m, full = l * l + l + m;
            sh[full] = !info->mirrored ? plane[full] : m < 0 ? 0 : plane[half];
        }
}

/* Where series are sampled: angles g from the mirror direction, Y_lm at azimuth 0. */
typedef struct samples {
    int bands;
    size_t count;
    float *basis; /* [sample][bands²] */
} samples;

static lmp_result samples_create(const lmp_allocator *heap, int bands, samples *made) {
    *made = (samples) { .bands = bands, .count = (size_t)(2 * bands + SAMPLES_MIN) };
    made->basis = lmp_allocate(heap, made->count * LMP_SH_COUNT(bands) * sizeof *made->basis);
    if (!made->basis)
        return LMP_ERROR_MEMORY;
    for (size_t i = 0; i < made->count; i++) {
        const double g = LMP_PREINTEGRATED_LOBE_PI * (double)i / (double)(made->count - 1);
        lmp_sh_eval(bands, (lmp_vec3) { (float)sin(g), 0, (float)cos(g) },
                    made->basis + i * LMP_SH_COUNT(bands));
    }
    return LMP_OK;
}

/* One view on its way to the lobe's frame. */
typedef struct turning {
    const lmp_brdf_table *table;
    brdf_series *series;
    const lmp_preintegrated_brdf_desc *desc;
    samples samples;
    float floor;                     /* peaks count as at least that */
    float peaks[BRDF_STEPS_MAX + 1]; /* < 0: no memory */
    int bands[BRDF_STEPS_MAX + 1];   /* that matter */
} turning;

/* The first `bands` bands of a view of the table, turned: [channel][bands²]. */
static bool turn(const turning *job, int step, int bands, float *turned) {
    const brdf_series *series = job->series;
    const lmp_brdf_table_info info = lmp_brdf_table_describe(job->table);
    const size_t count = LMP_SH_COUNT(bands);
    const double theta = LMP_PREINTEGRATED_LOBE_PI / 2 * step / series->steps;
    const lmp_quat to_mirror = { 0, (float)sin(theta / 2), 0, (float)cos(theta / 2) };
    float *memory = lmp_allocate(
        &series->heap, (3 * info.count + count + LMP_SH_ROTATION_COUNT(bands)) * sizeof *memory);
    if (!memory)
        return false;
    float *planes = memory, *sh = planes + 3 * info.count, *matrices = sh + count;
    lmp_sh_rotation(bands, to_mirror, matrices);
    lmp_brdf_table_view(job->table, (float)cos(theta), 0, planes);
    for (size_t c = 0; c < 3; c++) {
        expand(&info, planes + c * info.count, bands, sh);
        lmp_sh_rotate(bands, matrices, sh, turned + c * count);
    }
    lmp_release(&series->heap, memory);
    return true;
}

/* Band l of a channel at a sample, on both sides of the mirror direction. */
static void band_at(const float *sh, const float *basis, int l, float sides[2]) {
    const int at = l * l + l;
    float even = 0, odd = 0;
    for (int m = 0; m <= l; m += 2)
        even += sh[at + m] * basis[at + m];
    for (int m = 1; m <= l; m += 2)
        odd += sh[at + m] * basis[at + m];
    sides[0] = even + odd;
    sides[1] = even - odd;
}

/* The largest of the bands from l on, as one falls to 0: peaks[l], for every l. */
static void tails(const turning *job, const float *turned, float *peaks) {
    const int bands = job->samples.bands;
    const size_t count = LMP_SH_COUNT(bands);
    for (int l = 0; l < bands; l++)
        peaks[l] = 0;
    for (size_t c = 0; c < 3; c++)
        for (size_t i = 0; i < job->samples.count; i++) {
            float sums[2] = { 0, 0 }, sides[2];
            for (int l = bands - 1; l >= 0; l--) {
                band_at(turned + c * count, job->samples.basis + i * count, l, sides);
                sums[0] += sides[0];
                sums[1] += sides[1];
                peaks[l] = fmaxf(peaks[l], fmaxf(fabsf(sums[0]), fabsf(sums[1])));
            }
        }
}

/* How many bands of one view matter. */
static void cut_view(size_t index, void *data) {
    turning *job = data;
    const int bands = job->samples.bands, step = (int)index * job->series->steps / CUT_VIEWS;
    float peaks[LMP_BANDS_MAX];
    float *turned = lmp_allocate(&job->series->heap, 3 * LMP_SH_COUNT(bands) * sizeof *turned);
    job->peaks[index] = -1;
    if (turned && turn(job, step, bands, turned)) {
        tails(job, turned, peaks);
        job->peaks[index] = peaks[0];
        job->bands[index] = 1;
        for (int l = 1; l < bands; l++)
            if (!(peaks[l] <= (float)TAIL_BANDS * job->desc->error * peaks[0]))
                job->bands[index] = l + 1;
    }
    lmp_release(&job->series->heap, turned);
}

static bool cut_bands(turning *job) {
    const size_t views = CUT_VIEWS + 1;
    lmp_parallel_run(job->desc->parallel, job->desc->user, views, cut_view, job);
    job->series->bands = 1;
    for (size_t i = 0; i < views; i++) {
        if (job->peaks[i] < 0)
            return false;
        if (job->bands[i] > job->series->bands)
            job->series->bands = job->bands[i];
        job->floor = fmaxf(job->floor, (float)LMP_PREINTEGRATED_BRDF_FLOOR * job->peaks[i]);
    }
    return true;
}

/* What each order of a channel gives at a sample; no sines where the table is mirrored. */
static void sum_orders(const float *sh, const float *basis, int bands, bool mirrored,
                       float *cosines, float *sines) {
    for (int m = 0; m < bands; m++)
        cosines[m] = sines[m] = 0;
    for (int l = 0; l < bands; l++) {
        const float *c = sh + l * l + l, *y = basis + l * l + l;
        for (int m = 0; m <= l; m++)
            cosines[m] += c[m] * y[m];
        for (int m = 1; m <= l && !mirrored; m++)
            sines[m] += c[-m] * y[m];
    }
}

/* The orders without which a view keeps its values, and its largest value. */
static int count_orders(const turning *job, const float *turned, float *peak) {
    const int bands = job->series->bands;
    const size_t count = LMP_SH_COUNT(bands), all = LMP_SH_COUNT(job->samples.bands);
    float largest[LMP_BANDS_MAX] = { 0 }, cosines[LMP_BANDS_MAX], sines[LMP_BANDS_MAX];
    *peak = 0;
    for (size_t c = 0; c < 3; c++)
        for (size_t i = 0; i < job->samples.count; i++) {
            float even = 0, odd = 0;
            sum_orders(turned + c * count, job->samples.basis + i * all, bands,
                       job->series->mirrored, cosines, sines);
            for (int m = 0; m < bands; m++) {
                *(m % 2 ? &odd : &even) += cosines[m];
                largest[m] = fmaxf(largest[m], fmaxf(fabsf(cosines[m]), fabsf(sines[m])));
            }
            *peak = fmaxf(*peak, fmaxf(fabsf(even + odd), fabsf(even - odd)));
        }
    const float limit = (float)TAIL_ORDERS * job->desc->error * fmaxf(*peak, job->floor);
    float rest = 0;
    for (int m = bands - 1; m > 0; m--) {
        rest += largest[m];
        if (!(rest <= limit))
            return m + 1;
    }
    return 1;
}

static void turn_view(size_t index, void *data) {
    turning *job = data;
    brdf_series *series = job->series;
    const size_t count = LMP_SH_COUNT(series->bands);
    float *turned = series->coefficients + 3 * count * index, ambient[3];
    job->peaks[index] = -1;
    if (!turn(job, series->step[index], series->bands, turned))
        return;
    for (size_t c = 0; c < 3; c++)
        ambient[c] = turned[c * count] * (float)sqrt(4 * LMP_PREINTEGRATED_LOBE_PI);
    series->ambient[index] = (lmp_rgb) { ambient[0], ambient[1], ambient[2] };
    series->orders[index] = count_orders(job, turned, &job->peaks[index]);
}

/* The solid angle of a lobe as high as its peak with all that it reflects, of the narrowest. */
static float lobe_angle(const turning *job) {
    const brdf_series *series = job->series;
    const int bands = series->bands;
    float angle = (float)(2 * LMP_PREINTEGRATED_LOBE_PI);
    for (int i = 0; series->step[i] < series->steps * 3 / 4; i++) {
        const lmp_rgb all = series->ambient[i];
        const float most = fmaxf(all.r, fmaxf(all.g, all.b));
        if (most < angle * job->peaks[i])
            angle = most / job->peaks[i];
    }
    return fmaxf(angle, (float)LMP_PREINTEGRATED_LOBE_PI / (float)(bands * bands));
}

/* A table bends at its views, and falls where a fit's shadowing begins: steps are parts of the
 * views' step, so that none bends within one. (Tables of more than 512 views have finer steps, and
 * hardly bend.) */
static int count_steps(int views) {
    const int halves = 2 * views - 1;
    return halves > BRDF_STEPS_MAX ? BRDF_STEPS_MAX : halves * (BRDF_STEPS_MAX / halves);
}

/* The steps that are turned, which costs bands³ each: all of few bands. Of many, every so many,
 * the table's own views among them, and all of the last, where the light that a fit reflects grows
 * and falls fastest. */
static void choose_steps(brdf_series *series, int views, int bands) {
    const int parts = series->steps / (2 * views - 1); /* of half a view's step */
    int stride = 1;
    while (bands > STEPS_BANDS && stride < parts &&
           (series->steps > stride * STEPS_FEW || parts % stride))
        stride++;
    for (int step = 0; step <= series->steps; step++)
        if (step % stride == 0 || step >= (int)(STEPS_LAST * series->steps))
            series->step[series->view_count++] = step;
}

int lmp_preintegrated_brdf_view_at(const brdf_series *series, int part, int parts) {
    int view = series->view_count - 1;
    while (series->step[view] > series->steps * part / parts)
        view--;
    return view;
}

static lmp_result turn_all(turning *job) {
    brdf_series *series = job->series;
    const size_t views = (size_t)series->view_count;
    if (!cut_bands(job))
        return LMP_ERROR_MEMORY;
    series->coefficients = lmp_allocate(&series->heap, 3 * LMP_SH_COUNT(series->bands) * views *
                                                           sizeof *series->coefficients);
    if (!series->coefficients)
        return LMP_ERROR_MEMORY;
    lmp_parallel_run(job->desc->parallel, job->desc->user, views, turn_view, job);
    for (size_t i = 0; i < views; i++) {
        if (job->peaks[i] < 0)
            return LMP_ERROR_MEMORY;
        if (i > 0 && series->orders[i] < series->orders[i - 1])
            series->orders[i] = series->orders[i - 1];
    }
    series->width = WIDTH / (float)series->bands;
    series->lobe_angle = lobe_angle(job);
    series->radius = sqrtf(series->lobe_angle / (float)LMP_PREINTEGRATED_LOBE_PI);
    return LMP_OK;
}

lmp_result lmp_preintegrated_brdf_series(const lmp_allocator *allocator,
                                         const lmp_brdf_table *table,
                                         const lmp_preintegrated_brdf_desc *desc,
                                         brdf_series *series) {
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    *series = (brdf_series) { .heap = lmp_allocator_resolve(allocator),
                              .steps = count_steps(info.views),
                              .mirrored = info.mirrored };
    choose_steps(series, info.views, info.bands);
    turning *job = lmp_allocate(&series->heap, sizeof *job);
    if (!job)
        return LMP_ERROR_MEMORY;
    *job = (turning) { .table = table, .series = series, .desc = desc };
    lmp_result result = samples_create(&series->heap, info.bands, &job->samples);
    if (result == LMP_OK)
        result = turn_all(job);
    if (result != LMP_OK)
        lmp_preintegrated_brdf_series_free(series);
    lmp_release(&series->heap, job->samples.basis);
    lmp_release(&series->heap, job);
    return result;
}

void lmp_preintegrated_brdf_series_free(brdf_series *series) {
    lmp_release(&series->heap, series->coefficients);
    series->coefficients = NULL;
}

/* --- sets of views ------------------------------------------------------------------------------
 */

/* Intervals over the azimuths: a power of two, for slices to halve it. Where there are many orders
 * the last ones are faint. */
static int columns_for(const brdf_series *series, int orders) {
    int intervals = COLUMNS_MIN;
    while (intervals < COLUMNS_MAX && intervals < (orders <= FEW_ORDERS ? 2 * orders : orders))
        intervals *= 2;
    return series->mirrored ? intervals + 1 : 2 * intervals;
}

lmp_result lmp_preintegrated_brdf_views(const brdf_series *series, const int *view, size_t count,
                                        int columns, brdf_views *views) {
    const size_t values = LMP_SH_COUNT(series->bands);
    *views = (brdf_views) { .series = series, .count = count };
    views->coefficients =
        lmp_allocate(&series->heap, values * count * 3 * sizeof *views->coefficients);
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

void lmp_preintegrated_brdf_views_free(brdf_views *views) {
    lmp_release(&views->series->heap, views->coefficients);
    views->coefficients = NULL;
}

/* --- the sum ------------------------------------------------------------------------------------
 */

/* The mean of P_l over the cap, times the solid angles: R_l/R_0 (fill.c). */
static void cap_means(const brdf_series *series, double half_angle, float *means) {
    const double one_minus_cos = 2 * sin(half_angle / 2) * sin(half_angle / 2);
    const double angle = 2 * LMP_PREINTEGRATED_LOBE_PI * one_minus_cos + (double)series->lobe_angle;
    lmp_cap_polynomials(series->bands, (float)one_minus_cos, means);
    for (int l = 0; l < series->bands; l++)
        means[l] *= (float)(angle * (1 - one_minus_cos / 2));
}

/* What a thread of the sum works on. A table of all orders is mirrored (cosines alone), or holds
 * the sines of order m after its cosines. */
typedef struct rings {
    const brdf_views *views;
    size_t rows;
    size_t first[LMP_BANDS_MAX]; /* the first view that order m matters to */
    int orders;
    float means[LMP_BANDS_MAX];
    float *basis;                  /* ROWS * bands²: Y_lm at azimuth 0 */
    float *sums;                   /* [order][row][view][channel] */
    float circle[2 * COLUMNS_MAX]; /* cosines of a turn */
    float *turns;                  /* [order][column]: of the azimuths */
} rings;

/* Where an order's cosines, or for negative m its sines, lie in such a table. */
static size_t slot_of(const rings *r, int m) {
    return r->views->series->mirrored ? (size_t)m : (size_t)(m > 0 ? 2 * m - 1 : -2 * m);
}

/* Adds `terms` rows times their weights, in this order whatever is done at once. */
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

/* Σ_l of one order, negative for the sines. Some bands at a time, so that their coefficients are
 * fetched once for all rows. */
static void sum_bands(const rings *r, int m) {
    const size_t width = 3 * r->views->count, bands = (size_t)r->views->series->bands;
    const size_t order = (size_t)abs(m), first = 3 * r->first[order];
    float *sums = r->sums + slot_of(r, m) * ROWS * width, weights[TERMS];
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

/* cos(m p) at the azimuths p; sines for negative m. */
static void turn_order(rings *r, int m, int columns) {
    const int circle = 2 * COLUMNS_MAX;
    const int intervals = r->views->series->mirrored ? 2 * (columns - 1) : columns;
    float *turns = r->turns + slot_of(r, m) * 2 * COLUMNS_MAX;
    for (int j = 0; j < columns; j++) {
        const int at = abs(m) * j * (circle / intervals) + (m < 0 ? circle * 3 / 4 : 0);
        turns[j] = r->circle[at % circle];
    }
}

/* One view's values of the rings, from all orders' sums. */
static void add_orders_of(const rings *r, size_t v, size_t row_first, size_t row_count,
                          float *values) {
    const brdf_views *views = r->views;
    const size_t columns = (size_t)views->columns[v], width = 3 * views->count;
    const int orders = views->series->orders[views->view[v]];
    const size_t slots = views->series->mirrored ? (size_t)orders : 2 * (size_t)orders - 1;
    float sums[TERMS];
    const float *turns[TERMS];
    for (size_t c = 0; c < 3; c++)
        for (size_t row = 0; row < r->rows; row++) {
            float *to = values + (c * row_count + row_first + row) * columns;
            memset(to, 0, columns * sizeof *to);
            for (size_t slot = 0; slot < slots; slot += TERMS) {
                const size_t terms = terms_of(slots - slot);
                for (size_t i = 0; i < terms; i++) {
                    sums[i] = r->sums[((slot + i) * ROWS + row) * width + 3 * v + c];
                    turns[i] = r->turns + (slot + i) * 2 * COLUMNS_MAX;
                }
                add_terms(columns, sums, turns, terms, to);
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
            turn_order(r, m, r->views->columns[v]);
            if (m > 0 && !series->mirrored)
                turn_order(r, -m, r->views->columns[v]);
        }
        columns = r->views->columns[v];
        add_orders_of(r, v, row_first, row_count, values[v]);
    }
}

lmp_result lmp_preintegrated_brdf_sum(const brdf_views *views, double angle, const double *g,
                                      size_t rows, float *const *values) {
    const brdf_series *series = views->series;
    rings r = { .views = views, .orders = series->orders[views->view[views->count - 1]] };
    const size_t slots = (size_t)(series->mirrored ? r.orders : 2 * r.orders - 1);
    const size_t basis = ROWS * LMP_SH_COUNT(series->bands);
    const size_t sums = slots * ROWS * 3 * views->count, turns = slots * 2 * COLUMNS_MAX;
    r.basis = lmp_allocate(&series->heap, (basis + sums + turns) * sizeof *r.basis);
    if (!r.basis)
        return LMP_ERROR_MEMORY;
    r.sums = r.basis + basis;
    r.turns = r.sums + sums;
    for (int i = 0; i < 2 * COLUMNS_MAX; i++)
        r.circle[i] = (float)cos(LMP_PREINTEGRATED_LOBE_PI * i / COLUMNS_MAX);
    for (int m = 0; m < r.orders; m++)
        while (series->orders[views->view[r.first[m]]] <= m)
            r.first[m]++;
    cap_means(series, angle, r.means);
    for (size_t row = 0; row < rows; row += ROWS) {
        r.rows = rows - row < ROWS ? rows - row : ROWS;
        sum_rows(&r, g, row, rows, values);
    }
    lmp_release(&series->heap, r.basis);
    return LMP_OK;
}
