/* SPDX-License-Identifier: MIT */
/* brdf_slices.c - makes the slices of one half angle: values on a fine grid, thinned as far as
 * cubic splines reproduce them, then stored as the splines' coefficients. */
#include "src/preintegrated/brdf_slices.h"

#include "src/base/host.h"
#include "src/preintegrated/brdf_rows.h"
#include "src/preintegrated/brdf_thin.h"
#include "src/preintegrated/spline.h"

#include <string.h>

/* --- one slice -------------------------------------------------------------------------------- */

/* Computes the spline's coefficients at the rows and columns kept, with a column before the first
 * and as many after the last as a reading needs: [channel][row][column]. */
static void to_coefficients(const brdf_grid *g, size_t *rows, size_t *columns) {
    const size_t f = g->column_factor;
    const size_t kept = g->mirrored ? (g->columns - 1) / f + 1 : g->columns / f;
    *rows = (g->rows - 1) / g->row_factor + 1;
    *columns = kept + (g->mirrored ? 2 : 3);
    for (size_t c = 0; c < 3; c++)
        for (size_t i = 0; i < *rows; i++) {
            const float *from = g->values + (c * g->rows + i * g->row_factor) * g->columns;
            lmpi_preintegrated_brdf_copy_around(g, from, -BRDF_WRAP * (ptrdiff_t)f,
                                                kept + 2 * BRDF_WRAP, f, g->line);
            lmpi_spline_coefficients(g->line, kept + 2 * BRDF_WRAP, 1);
            memcpy(g->coefficients + (c * *rows + i) * *columns, g->line + BRDF_WRAP - 1,
                   *columns * sizeof *g->coefficients);
        }
    for (size_t c = 0; c < 3; c++)
        lmpi_spline_coefficients(g->coefficients + c * *rows * *columns, *rows, *columns);
}

/* The rows of one half angle: s = BRDF_ROW_STEP (first + i). */
typedef struct row_range {
    double low, high; /* the range of s that readings reach */
    int first;
    size_t count;
} row_range;

/* Appends the slice to the column, without the rows that no reading reaches. */
static void store(const brdf_grid *g, const row_range *range, brdf_column *column,
                  lmp_preintegrated_brdf_slice *slice) {
    size_t rows, columns;
    to_coefficients(g, &rows, &columns);
    const double density = 1 / (BRDF_ROW_STEP * (double)g->row_factor);
    const double start = (double)range->first / (double)g->row_factor;
    const size_t before = (size_t)(floor(range->low * density - start) - 1);
    const size_t after = (size_t)(floor(range->high * density - start) + 3);
    float peak = 0;
    for (size_t c = 0; c < 3; c++)
        for (size_t i = (c * rows + before) * columns; i < (c * rows + after) * columns; i++)
            peak = brdf_larger(peak, fabsf(g->coefficients[i]));
    const double full = g->mirrored ? LMPI_PREINTEGRATED_PI : 2 * LMPI_PREINTEGRATED_PI;
    *slice = (lmp_preintegrated_brdf_slice) {
        .first = (uint32_t)column->texel_count,
        .rows = (uint32_t)(after - before),
        .columns = (uint32_t)columns,
        .row_density = (float)density,
        .row_origin = (float)(start + (double)before),
        .column_density = (float)((double)(columns - 3) / full),
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

/* --- one half angle --------------------------------------------------------------------------- */

/* Returns the rows of a slice, whose readings come from half angles up to the neighbors'. */
static row_range range_of(const brdf_series *series, const int *caps, int count, int index) {
    const int below = index > 0 ? index - 1 : index, above = index + 1 < count ? index + 1 : index;
    const double least =
        lmpi_preintegrated_brdf_rim_of(series, lmpi_preintegrated_brdf_angle_at(caps[below]));
    const double most =
        lmpi_preintegrated_brdf_rim_of(series, lmpi_preintegrated_brdf_angle_at(caps[above]));
    row_range range = { .low = lmpi_preintegrated_brdf_row_of(series, -most),
                        .high =
                            lmpi_preintegrated_brdf_row_of(series, LMPI_PREINTEGRATED_PI - least) };
    const int first = (int)floor(range.low / BRDF_ROW_STEP) - BRDF_THINNING - BRDF_MARGIN;
    const int last = (int)ceil(range.high / BRDF_ROW_STEP) + 2 * BRDF_THINNING + BRDF_MARGIN;
    range.first = first - (BRDF_THINNING + first % BRDF_THINNING) % BRDF_THINNING;
    const int rows = last - range.first;
    range.count = (size_t)(rows + BRDF_THINNING - rows % BRDF_THINNING) + 1;
    return range;
}

/* Sizes of memory: texels at most, values of all views, and the longest line. */
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
        const size_t line = 2 * (columns * (1 + 2 * BRDF_WRAP));
        need.largest = coefficients > need.largest ? coefficients : need.largest;
        need.line = line > need.line ? line : need.line;
    }
    return need;
}

static void store_all(const brdf_views *views, const row_range *range, float error,
                      float *const *values, float *scratch, const room *need, brdf_column *column) {
    float peaks[BRDF_STEPS_MAX + 1], floor_peak = 0;
    brdf_grid g = { .rows = range->count,
                    .mirrored = views->series->mirrored,
                    .coefficients = scratch,
                    .line = scratch + need->largest };
    for (size_t v = 0; v < views->count; v++) {
        g.values = values[v];
        g.columns = (size_t)views->columns[v];
        peaks[v] = lmpi_preintegrated_brdf_largest(&g);
        floor_peak = fmaxf(floor_peak, (float)LMPI_PREINTEGRATED_BRDF_FLOOR * peaks[v]);
    }
    for (size_t v = 0; v < views->count; v++) {
        g.values = values[v];
        g.columns = (size_t)views->columns[v];
        lmpi_preintegrated_brdf_thin(&g,
                                     (float)BRDF_TOLERANCE * error * fmaxf(peaks[v], floor_peak));
        store(&g, range, column, &column->slices[v]);
    }
}

lmp_result lmpi_preintegrated_brdf_slices(const brdf_views *views, const int *caps, int count,
                                          int index, float error, brdf_column *column) {
    const brdf_series *series = views->series;
    const double angle = lmpi_preintegrated_brdf_angle_at(caps[index]);
    const row_range range = range_of(series, caps, count, index);
    const room need = room_for(views, range.count);
    float *values[BRDF_STEPS_MAX + 1];
    float *memory =
        lmpi_allocate(&series->host, (need.values + need.largest + need.line) * sizeof *memory);
    double *g = lmpi_allocate(&series->host, range.count * sizeof *g);
    int16_t *texels = lmpi_allocate(&series->host, need.texels * 3 * sizeof *texels);
    *column = (brdf_column) { .texels = texels };
    column->slices = lmpi_allocate(&series->host, views->count * sizeof *column->slices);
    lmp_result result = memory && g && texels && column->slices ? LMP_OK : LMP_ERROR_MEMORY;
    if (result == LMP_OK) {
        for (size_t i = 0; i < range.count; i++)
            g[i] = lmpi_preintegrated_brdf_x_of(series,
                                                BRDF_ROW_STEP * (double)(range.first + (int)i)) +
                   lmpi_preintegrated_brdf_rim_of(series, angle);
        float *next = memory + need.largest + need.line;
        for (size_t v = 0; v < views->count; v++) {
            values[v] = next;
            next += 3 * range.count * (size_t)views->columns[v];
        }
        result = lmpi_preintegrated_brdf_sum(views, angle, g, range.count, values);
    }
    if (result == LMP_OK)
        store_all(views, &range, error, values, memory, &need, column);
    lmpi_release(&series->host, memory);
    lmpi_release(&series->host, g);
    if (result != LMP_OK)
        lmpi_preintegrated_brdf_column_free(series, column);
    return result;
}

void lmpi_preintegrated_brdf_column_free(const brdf_series *series, brdf_column *column) {
    lmpi_release(&series->host, column->slices);
    lmpi_release(&series->host, column->texels);
    *column = (brdf_column) { 0 };
}
