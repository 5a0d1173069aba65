/* SPDX-License-Identifier: MIT */
/* plot.h - lines and points over two axes, as SVG and as a table. */
#ifndef LAMPION_IMAGE_PLOT_H
#define LAMPION_IMAGE_PLOT_H

#include <stdbool.h>
#include <stdio.h>

typedef struct figure_series {
    const char *name;
    const double *x, *y;
    int count;
} figure_series;

/* A plot; points that a logarithmic axis cannot show are skipped. */
typedef struct figure_plot {
    const char *file, *title, *x_label, *y_label;
    bool log_x, log_y;
    double y_floor; /* with log_y: smallest y shown; 0: that of the data */
    bool dots;      /* whether each point is also drawn */
    const figure_series *series;
    int series_count; /* at most FIGURE_SERIES_MAX */
} figure_plot;
#define FIGURE_SERIES_MAX 20

void figure_plot_draw(FILE *svg, const figure_plot *plot);
void figure_plot_list(FILE *csv, const figure_plot *plot);

#endif
