/* SPDX-License-Identifier: MIT */
#include "app/base/file_writer.h"
#include "app/image/plot.h"
#include "app/truth/scoreboard_print.h"

_Static_assert(FORMULAS_MAX <= FIGURE_SERIES_MAX, "each formula is a series");

bool board_plot(const board *b, ruler_material material, const char *path, base_error *error) {
    figure_series series[FORMULAS_MAX];
    double cost[FORMULAS_MAX], balanced[FORMULAS_MAX];
    char title[96];
    int count = 0;
    for (int k = 0; k < b->count; k++) {
        const board_score *const score = &b->scores[k];
        board_cell cell = board_all(score);
        if (!score->by->applies[material])
            continue;
        cell.group[RULER_BY_MATERIAL] = (int)material;
        cost[count] = score->nanoseconds[material];
        balanced[count] = board_figures(b, score, &cell).balanced;
        series[count] = (figure_series) { score->by->name, &cost[count], &balanced[count], 1 };
        count++;
    }
    snprintf(title, sizeof title, "sphere lights on %s", ruler_material_names[material]);
    file_writer file;
    if (!file_write_begin(&file, path, error))
        return false;
    figure_plot_draw(file.stream, &(figure_plot) { .title = title,
                                                   .x_label = "ns an evaluation, one core",
                                                   .y_label = "balanced rms of the errors",
                                                   .log_x = true,
                                                   .log_y = true,
                                                   .y_floor = 1e-8,
                                                   .dots = true,
                                                   .series = series,
                                                   .series_count = count });
    return file_write_commit(&file, error);
}
