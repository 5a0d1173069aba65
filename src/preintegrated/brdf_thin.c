/* SPDX-License-Identifier: MIT */
/* brdf_thin.c - finds how many rows and columns of a slice's fine grid cubic splines can do
 * without. */
#include "src/preintegrated/brdf_thin.h"

#include "src/preintegrated/spline.h"

#include <string.h>

void lmpi_preintegrated_brdf_copy_around(const brdf_grid *g, const float *row, ptrdiff_t first,
                                         size_t count, size_t step, float *to) {
    const ptrdiff_t columns = (ptrdiff_t)g->columns;
    const ptrdiff_t period = g->mirrored ? 2 * columns - 2 : columns;
    ptrdiff_t j = (first % period + period) % period;
    for (size_t i = 0; i < count; i++) {
        to[i] = row[j < columns ? j : period - j];
        j += (ptrdiff_t)step;
        j -= j < period ? 0 : period;
    }
}

/* Returns the largest difference between dropped values and the spline through the others, of
 * `width` series side by side; `skip` values at either end do not count. */
static float spline_error(const float *values, size_t count, size_t width, size_t factor,
                          float *kept_values, size_t skip) {
    const size_t kept = (count - 1) / factor + 1;
    float error = 0, w[4];
    for (size_t i = 0; i < kept; i++)
        memcpy(kept_values + i * width, values + i * factor * width, width * sizeof *values);
    lmpi_spline_coefficients(kept_values, kept, width);
    for (size_t phase = 1; phase < factor; phase++) {
        lmpi_spline_weights((float)phase / (float)factor, w);
        for (size_t i = skip / factor; i + 2 < kept && i * factor + phase + skip < count; i++) {
            const float *c = kept_values + (i - 1) * width;
            const float *value = values + (i * factor + phase) * width;
            for (size_t j = 0; j < width; j++) {
                const float sum = w[0] * c[j] + w[1] * c[width + j] + w[2] * c[2 * width + j] +
                                  w[3] * c[3 * width + j];
                error = brdf_larger(error, fabsf(sum - value[j]));
            }
        }
    }
    return error;
}

bool lmpi_preintegrated_brdf_rows_hold(const brdf_grid *g, size_t factor, float limit) {
    for (size_t c = 0; c < 3; c++)
        if (!(spline_error(g->values + c * g->rows * g->columns, g->rows, g->columns, factor,
                           g->coefficients, BRDF_MARGIN) <= limit))
            return false;
    return true;
}

/* Tests some of the rows, which suffice because rows lie much closer than the detail they show. */
static bool columns_hold(const brdf_grid *g, size_t factor, float limit) {
    const size_t count = g->columns + 2 * BRDF_WRAP * factor;
    float *around = g->line, *line = around + count;
    for (size_t row = BRDF_MARGIN; row + BRDF_MARGIN < 3 * g->rows; row += 4) {
        const float *values = g->values + row * g->columns;
        if (row % g->rows < BRDF_MARGIN || row % g->rows + BRDF_MARGIN >= g->rows)
            continue;
        lmpi_preintegrated_brdf_copy_around(g, values, -(ptrdiff_t)(BRDF_WRAP * factor), count, 1,
                                            around);
        if (!(spline_error(around, count, 1, factor, line, BRDF_WRAP * factor) <= limit))
            return false;
    }
    return true;
}

float lmpi_preintegrated_brdf_largest(const brdf_grid *g) {
    float peak = 0;
    for (size_t c = 0; c < 3; c++) {
        const float *values = g->values + (c * g->rows + BRDF_MARGIN) * g->columns;
        for (size_t i = 0; i < (g->rows - 2 * BRDF_MARGIN) * g->columns; i++)
            peak = brdf_larger(peak, fabsf(values[i]));
    }
    return peak;
}

void lmpi_preintegrated_brdf_thin(brdf_grid *g, float limit) {
    const size_t intervals = g->mirrored ? g->columns - 1 : g->columns / 2;
    g->row_factor = g->column_factor = 1;
    while (intervals / g->column_factor > 4 && columns_hold(g, 2 * g->column_factor, limit))
        g->column_factor *= 2;
    while (g->row_factor < BRDF_THINNING &&
           lmpi_preintegrated_brdf_rows_hold(g, 2 * g->row_factor, limit))
        g->row_factor *= 2;
}
