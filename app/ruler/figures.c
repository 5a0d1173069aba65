/* SPDX-License-Identifier: MIT */
#include "app/ruler/figures.h"

#include <math.h>

double ruler_error(const ruler_row *row, double value) {
    const double difference = value - row->value, beyond = fabs(difference) - row->radius;
    return copysign(fmax(beyond, 0), difference) / (row->value + RULER_DARK * ruler_scale(row));
}

ruler_figures ruler_figures_of(const ruler_table *table, const double *values, ruler_filter belongs,
                               const void *user) {
    ruler_figures f = { .count = 0 };
    double squares = 0, sum = 0, truths = 0;
    for (int i = 0; i < table->count; i++) {
        const ruler_row *const row = &table->rows[i];
        if (belongs && !belongs(row, user))
            continue;
        const double error = ruler_error(row, values[i]), scale = ruler_scale(row);
        f.count++;
        f.largest = fmax(f.largest, fabs(error));
        squares += error * error;
        sum += values[i] / scale;
        truths += row->value / scale;
    }
    f.rms = f.count ? sqrt(squares / f.count) : 0;
    f.energy = truths > 0 ? sum / truths : 1;
    return f;
}
