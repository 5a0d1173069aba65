/* SPDX-License-Identifier: MIT */
/* brdf_slices.c - the slices of one half angle: values on a fine grid, thinned as far as cubic
 * splines keep them, then stored as the splines' coefficients. */
#include "src/preintegrated/brdf_make.h"

#include "src/base/allocator.h"
#include "src/preintegrated/spline.h"

#include <string.h>

#define STEP      0.6 /* of the row coordinate; 1 is about the finest detail's width */
#define THINNING  8   /* the most, of rows: a power of two */
#define MARGIN    16  /* rows past the far ends: what is unknown there has faded */
#define WRAP      8   /* the same of columns */
#define TOLERANCE 0.5 /* of the error, of rows and of columns each */

double lmp_preintegrated_brdf_row_of(const brdf_series *series, double x) {
    const double reach = (double)series->reach;
    return x *
           (reach / ((double)series->width * sqrt(x * x + reach * reach)) + (double)series->slope);
}

double lmp_preintegrated_brdf_x_of(const brdf_series *series, double s) {
    const double reach = (double)series->reach, slope = (double)series->slope;
    const double dense = 1 / (double)series->width;
    double x = s / (dense + slope);
    for (int i = 0; i < 100; i++) {
        const double root = sqrt(x * x + reach * reach);
        const double derivative = dense * reach * reach * reach / (root * root * root) + slope;
        const double step = (lmp_preintegrated_brdf_row_of(series, x) - s) / derivative;
        /* s bends over: a full step from the flat part would overshoot for ever */
        const double most = reach + fabs(x) / 2;
        x -= fmax(-most, fmin(step, most));
        if (fabs(step) < 1e-12)
            break;
    }
    return x;
}

double lmp_preintegrated_brdf_rim_of(const brdf_series *series, double a) {
    const double radius = (double)series->radius;
    return a * a / (sqrt(a * a + radius * radius) + radius);
}

double lmp_preintegrated_brdf_angle_at(int step) {
    const double share = (double)step / BRDF_CAP_STEPS * (LMP_PREINTEGRATED_LOBE_PI / 2) /
                         (LMP_PREINTEGRATED_LOBE_PI / 2 + 0.5);
    return 0.5 * share / (1 - share);
}

/* --- one slice ----------------------------------------------------------------------------------
 */

/* A slice's values while it is thinned: [channel][row][column]. */
typedef struct grid {
    float *values;
    size_t rows, columns; /* evaluated, not thinned */
    size_t row_factor, column_factor;
    bool mirrored;
    float *coefficients; /* room for them, with the columns past the ends */
    float *line;         /* room for two rows with their margins */
} grid;

/* Copies a row's columns first … first + count - 1, `step` apart: azimuths go round, or mirror. */
static void copy_around(const grid *g, const float *row, ptrdiff_t first, size_t count, size_t step,
                        float *to) {
    const ptrdiff_t columns = (ptrdiff_t)g->columns;
    const ptrdiff_t turn = g->mirrored ? 2 * columns - 2 : columns;
    ptrdiff_t j = (first % turn + turn) % turn;
    for (size_t i = 0; i < count; i++) {
        to[i] = row[j < columns ? j : turn - j];
        j += (ptrdiff_t)step;
        j -= j < turn ? 0 : turn;
    }
}

static float larger(float a, float b) {
    return a > b ? a : b;
}

/* The largest difference between dropped values and the spline through the others, of `width`
 * series side by side; `skip` values at either end do not count. */
static float spline_error(const float *values, size_t count, size_t width, size_t factor,
                          float *kept_values, size_t skip) {
    const size_t kept = (count - 1) / factor + 1;
    float error = 0, w[4];
    for (size_t i = 0; i < kept; i++)
        memcpy(kept_values + i * width, values + i * factor * width, width * sizeof *values);
    lmp_spline_coefficients(kept_values, kept, width);
    for (size_t phase = 1; phase < factor; phase++) {
        lmp_spline_weights((float)phase / (float)factor, w);
        for (size_t i = skip / factor; i + 2 < kept && i * factor + phase + skip < count; i++) {
            const float *c = kept_values + (i - 1) * width;
            const float *value = values + (i * factor + phase) * width;
            for (size_t j = 0; j < width; j++) {
                const float sum = w[0] * c[j] + w[1] * c[width + j] + w[2] * c[2 * width + j] +
                                  w[3] * c[3 * width + j];
                error = larger(error, fabsf(sum - value[j]));
            }
        }
    }
    return error;
}

static bool rows_thin(const grid *g, size_t factor, float limit) {
    for (size_t c = 0; c < 3; c++)
        if (!(spline_error(g->values + c * g->rows * g->columns, g->rows, g->columns, factor,
                           g->coefficients, MARGIN) <= limit))
            return false;
    return true;
}

/* Some of the rows tell: they are much closer than what they show. */
static bool columns_thin(const grid *g, size_t factor, float limit) {
    const size_t count = g->columns + 2 * WRAP * factor;
    float *around = g->line, *line = around + count;
    for (size_t row = MARGIN; row + MARGIN < 3 * g->rows; row += 4) {
        const float *values = g->values + row * g->columns;
        if (row % g->rows < MARGIN || row % g->rows + MARGIN >= g->rows)
            continue;
        copy_around(g, values, -(ptrdiff_t)(WRAP * factor), count, 1, around);
        if (!(spline_error(around, count, 1, factor, line, WRAP * factor) <= limit))
            return false;
    }
    return true;
}

static float largest(const grid *g) {
    float peak = 0;
    for (size_t c = 0; c < 3; c++) {
        const float *values = g->values + (c * g->rows + MARGIN) * g->columns;
        for (size_t i = 0; i < (g->rows - 2 * MARGIN) * g->columns; i++)
            peak = larger(peak, fabsf(values[i]));
    }
    return peak;
}

static void thin(grid *g, float limit) {
    const size_t intervals = g->mirrored ? g->columns - 1 : g->columns / 2;
    g->row_factor = g->column_factor = 1;
    while (intervals / g->column_factor > 4 && columns_thin(g, 2 * g->column_factor, limit))
        g->column_factor *= 2;
    while (g->row_factor < THINNING && rows_thin(g, 2 * g->row_factor, limit))
        g->row_factor *= 2;
}

/* The spline's coefficients at the kept rows and columns, a column before the first and as many
 * after the last as a reading needs: [channel][row][column]. */
static void to_coefficients(const grid *g, size_t *rows, size_t *columns) {
    const size_t f = g->column_factor;
    const size_t kept = g->mirrored ? (g->columns - 1) / f + 1 : g->columns / f;
    *rows = (g->rows - 1) / g->row_factor + 1;
    *columns = kept + (g->mirrored ? 2 : 3);
    for (size_t c = 0; c < 3; c++)
        for (size_t i = 0; i < *rows; i++) {
            const float *from = g->values + (c * g->rows + i * g->row_factor) * g->columns;
            copy_around(g, from, -WRAP * (ptrdiff_t)f, kept + 2 * WRAP, f, g->line);
            lmp_spline_coefficients(g->line, kept + 2 * WRAP, 1);
            memcpy(g->coefficients + (c * *rows + i) * *columns, g->line + WRAP - 1,
                   *columns * sizeof *g->coefficients);
        }
    for (size_t c = 0; c < 3; c++)
        lmp_spline_coefficients(g->coefficients + c * *rows * *columns, *rows, *columns);
}

/* Where the rows of one half angle lie: s = STEP (first + i). */
typedef struct row_range {
    double low, high; /* s that readings reach */
    int first;
    size_t count;
} row_range;

/* Appends the slice to the column, without the rows no reading reaches. */
static void store(const grid *g, const row_range *range, brdf_column *column,
                  lmp_preintegrated_brdf_slice *slice) {
    size_t rows, columns;
    to_coefficients(g, &rows, &columns);
    const double density = 1 / (STEP * (double)g->row_factor);
    const double start = (double)range->first / (double)g->row_factor;
    const size_t before = (size_t)(floor(range->low * density - start) - 1);
    const size_t after = (size_t)(floor(range->high * density - start) + 3);
    float peak = 0;
    for (size_t c = 0; c < 3; c++)
        for (size_t i = (c * rows + before) * columns; i < (c * rows + after) * columns; i++)
            peak = larger(peak, fabsf(g->coefficients[i]));
    const double turn = g->mirrored ? LMP_PREINTEGRATED_LOBE_PI : 2 * LMP_PREINTEGRATED_LOBE_PI;
    *slice = (lmp_preintegrated_brdf_slice) {
        .first = (uint32_t)column->texel_count,
        .rows = (uint32_t)(after - before),
        .columns = (uint32_t)columns,
        .row_density = (float)density,
        .row_origin = (float)(start + (double)before),
        .column_density = (float)((double)(columns - 3) / turn),
        .unit = peak > 0 ? peak / 32767 : 1,
    };
    int16_t *to = column->texels + 3 * column->texel_count;
    for (size_t i = before; i < after; i++)
        for (size_t j = 0; j < columns; j++)
            for (size_t c = 0; c < 3; c++)
                *to++ = (int16_t)lrintf(fminf(
                    fmaxf(g->coefficients[(c * rows + i) * columns + j] / slice->unit, -32767),
                    32767));
    column->texel_count += (after - before) * columns;
}

/* --- one half angle ------------------------------------------------------------------------------
 */

/* Readings of the slice come from half angles up to the neighbors'. */
static row_range range_of(const brdf_series *series, const int *caps, int count, int index) {
    const int below = index > 0 ? index - 1 : index, above = index + 1 < count ? index + 1 : index;
    const double least =
        lmp_preintegrated_brdf_rim_of(series, lmp_preintegrated_brdf_angle_at(caps[below]));
    const double most =
        lmp_preintegrated_brdf_rim_of(series, lmp_preintegrated_brdf_angle_at(caps[above]));
    row_range range = { .low = lmp_preintegrated_brdf_row_of(series, -most),
                        .high = lmp_preintegrated_brdf_row_of(series,
                                                              LMP_PREINTEGRATED_LOBE_PI - least) };
    const int first = (int)floor(range.low / STEP) - THINNING - MARGIN;
    const int last = (int)ceil(range.high / STEP) + 2 * THINNING + MARGIN;
    range.first = first - (THINNING + first % THINNING) % THINNING;
    const int rows = last - range.first;
    range.count = (size_t)(rows + THINNING - rows % THINNING) + 1;
    return range;
}

/* Texels at most, values of all views, and the longest line. */
typedef struct room {
    size_t texels, values, largest, line;
} room;

static room room_for(const brdf_views *views, size_t rows) {
    room need = { 0 };
    for (size_t v = 0; v < views->count; v++) {
        const size_t columns = (size_t)views->columns[v];
        need.texels += rows * (columns + 3);
        need.values += 3 * rows * columns;
        const size_t coefficients = 3 * rows * (columns + 3);
        const size_t line = 2 * (columns * (1 + 2 * WRAP));
        need.largest = coefficients > need.largest ? coefficients : need.largest;
        need.line = line > need.line ? line : need.line;
    }
    return need;
}

static void store_all(const brdf_views *views, const row_range *range, float error,
                      float *const *values, float *scratch, const room *need, brdf_column *column) {
    float peaks[BRDF_STEPS_MAX + 1], floor_peak = 0;
    grid g = { .rows = range->count,
               .mirrored = views->series->mirrored,
               .coefficients = scratch,
               .line = scratch + need->largest };
    for (size_t v = 0; v < views->count; v++) {
        g.values = values[v];
        g.columns = (size_t)views->columns[v];
        peaks[v] = largest(&g);
        floor_peak = fmaxf(floor_peak, (float)LMP_PREINTEGRATED_BRDF_FLOOR * peaks[v]);
    }
    for (size_t v = 0; v < views->count; v++) {
        g.values = values[v];
        g.columns = (size_t)views->columns[v];
        thin(&g, (float)TOLERANCE * error * fmaxf(peaks[v], floor_peak));
        store(&g, range, column, &column->slices[v]);
    }
}

bool lmp_preintegrated_brdf_slices(const brdf_views *views, const int *caps, int count, int index,
                                   float error, brdf_column *column) {
    const brdf_series *series = views->series;
    const double angle = lmp_preintegrated_brdf_angle_at(caps[index]);
    const row_range range = range_of(series, caps, count, index);
    const room need = room_for(views, range.count);
    float *values[BRDF_STEPS_MAX + 1];
    float *memory =
        lmp_allocate(&series->heap, (need.values + need.largest + need.line) * sizeof *memory);
    double *g = lmp_allocate(&series->heap, range.count * sizeof *g);
    int16_t *texels = lmp_allocate(&series->heap, need.texels * 3 * sizeof *texels);
    *column = (brdf_column) { .texels = texels };
    column->slices = lmp_allocate(&series->heap, views->count * sizeof *column->slices);
    bool ok = memory && g && texels && column->slices;
    if (ok) {
        for (size_t i = 0; i < range.count; i++)
            g[i] = lmp_preintegrated_brdf_x_of(series, STEP * (double)(range.first + (int)i)) +
                   lmp_preintegrated_brdf_rim_of(series, angle);
        float *next = memory + need.largest + need.line;
        for (size_t v = 0; v < views->count; v++) {
            values[v] = next;
            next += 3 * range.count * (size_t)views->columns[v];
        }
        ok = lmp_preintegrated_brdf_sum(views, angle, g, range.count, values) == LMP_OK;
    }
    if (ok)
        store_all(views, &range, error, values, memory, &need, column);
    lmp_release(&series->heap, memory);
    lmp_release(&series->heap, g);
    if (!ok)
        lmp_preintegrated_brdf_column_free(series, column);
    return ok;
}

/* --- rows far from the rims ----------------------------------------------------------------------
 */

/* Whether rows at `step` of the row coordinate keep what rows between them show, at some views and
 * half angles; 1 yes, 0 no, -1 no memory. */
static int rows_hold(const brdf_views *views, double angle, float error) {
    const brdf_series *series = views->series;
    const double rim = lmp_preintegrated_brdf_rim_of(series, angle);
    const double low = lmp_preintegrated_brdf_row_of(series, -rim) / STEP - MARGIN;
    const double high =
        lmp_preintegrated_brdf_row_of(series, LMP_PREINTEGRATED_LOBE_PI - rim) / STEP + MARGIN;
    const size_t rows = 2 * (size_t)(ceil(high) - floor(low)) + 1;
    const size_t columns = (size_t)views->columns[0], size = 3 * rows * columns;
    double *g = lmp_allocate(&series->heap, rows * sizeof *g);
    float *memory = lmp_allocate(&series->heap, (views->count + 1) * size * sizeof *memory);
    float *values[BRDF_STEPS_MAX + 1];
    int holds = g && memory ? 1 : -1;
    for (size_t i = 0; g && i < rows; i++)
        g[i] = lmp_preintegrated_brdf_x_of(series, STEP * (floor(low) + (double)i / 2)) + rim;
    for (size_t v = 0; v < views->count; v++)
        values[v] = memory + v * size;
    if (holds > 0 && lmp_preintegrated_brdf_sum(views, angle, g, rows, values) != LMP_OK)
        holds = -1;
    for (size_t v = 0; holds > 0 && v < views->count; v++) {
        const grid at = { .values = values[v],
                          .rows = rows,
                          .columns = columns,
                          .coefficients = memory + views->count * size };
        holds = rows_thin(&at, 2, (float)TOLERANCE * error * largest(&at));
    }
    lmp_release(&series->heap, g);
    lmp_release(&series->heap, memory);
    return holds;
}

bool lmp_preintegrated_brdf_rows(brdf_series *series, float error) {
    /* reach in widths and slope in 1/widths, by rising number of rows */
    static const float choices[][2] = { { 2, 0.02f }, { 4, 0.02f }, { 4, 0.05f }, { 8, 0.05f },
                                        { 8, 0.1f },  { 16, 0.1f }, { 16, 0.2f }, { 16, 0.4f } };
    static const double angles[] = { 0, 0.05, 0.3, 1.2 };
    enum { CHOICES = sizeof choices / sizeof *choices, ANGLES = sizeof angles / sizeof *angles };
    const int at[3] = {
        lmp_preintegrated_brdf_view_at(series, 1, 4),
        lmp_preintegrated_brdf_view_at(series, 3, 4),
        lmp_preintegrated_brdf_view_at(series, 19, 20),
    };
    brdf_views views;
    if (lmp_preintegrated_brdf_views(series, at, 3, series->mirrored ? 9 : 16, &views) != LMP_OK)
        return false;
    int holds = 0;
    for (int i = 0; holds == 0 && i < CHOICES; i++) {
        series->reach = choices[i][0] * series->width;
        series->slope = choices[i][1] / series->width;
        holds = 1;
        for (int k = 0; holds > 0 && k < ANGLES; k++)
            holds = rows_hold(&views, angles[k], error);
    }
    lmp_preintegrated_brdf_views_free(&views);
    return holds >= 0;
}

void lmp_preintegrated_brdf_column_free(const brdf_series *series, brdf_column *column) {
    lmp_release(&series->heap, column->slices);
    lmp_release(&series->heap, column->texels);
    *column = (brdf_column) { 0 };
}
