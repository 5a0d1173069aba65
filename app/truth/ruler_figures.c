/* SPDX-License-Identifier: MIT */
#include "app/truth/ruler_figures.h"

#include <math.h>

static double error_in_parts_of(double unit, const ruler_row *row, double value) {
    const double difference = value - row->value, beyond = fabs(difference) - row->radius;
    return copysign(fmax(beyond, 0), difference) / (unit + RULER_DARK * ruler_scale(row));
}

double ruler_error(const ruler_row *row, double value) {
    return error_in_parts_of(row->value, row, value);
}

double ruler_balanced_error(const ruler_row *row, double value) {
    return error_in_parts_of(fmax(row->value, value), row, value);
}

ruler_figures ruler_figures_of(const ruler_table *table, const double *values, ruler_filter belongs,
                               const void *user) {
    ruler_figures f = { .count = 0 };
    double squares = 0, balanced = 0, sum = 0, truths = 0;
    for (int i = 0; i < table->count; i++) {
        const ruler_row *const row = &table->rows[i];
        if (belongs && !belongs(row, user))
            continue;
        const double error = ruler_error(row, values[i]), scale = ruler_scale(row);
        const double of_greater = ruler_balanced_error(row, values[i]);
        f.count++;
        f.largest = fmax(f.largest, fabs(error));
        squares += error * error;
        balanced += of_greater * of_greater;
        sum += values[i] / scale;
        truths += row->value / scale;
    }
    f.rms = f.count ? sqrt(squares / f.count) : 0;
    f.balanced = f.count ? sqrt(balanced / f.count) : 0;
    f.energy = truths > 0 ? sum / truths : 1;
    return f;
}
