/* SPDX-License-Identifier: MIT */
#include "app/image/plot.h"

#include <math.h>

enum {
    WIDTH = 720,
    HEIGHT = 400,
    LEFT = 76,
    RIGHT = 170,
    TOP = 40,
    BOTTOM = 50,
    COLORS = FIGURE_SERIES_MAX
};

static const char *const colors[COLORS] = { "#1f5fa8", "#c0392b", "#2e8b57", "#8e5ea2", "#d9831f",
                                            "#16828c", "#7f8c8d", "#b03a7d", "#5b6f1f", "#00a0e0",
                                            "#e05a8a", "#4a3b8f", "#a06a3c", "#30b090", "#c8a400",
                                            "#202020", "#ff7043", "#6d4c41", "#9ccc65", "#5c6bc0" };

/* One axis: values low … high map to pixels from … to. */
typedef struct axis {
    bool log;
    double low, high, from, to;
} axis;

static double scaled(const axis *a, double value) {
    return a->log ? log10(value) : value;
}

static double position(const axis *a, double value) {
    const double low = scaled(a, a->low), high = scaled(a, a->high);
    return a->from + (a->to - a->from) * (scaled(a, value) - low) / (high > low ? high - low : 1);
}

static bool shown(const figure_plot *plot, double x, double y) {
    return isfinite(x) && isfinite(y) && (!plot->log_x || x > 0) &&
           (!plot->log_y || y > plot->y_floor);
}

static void span(const figure_plot *plot, axis *x, axis *y) {
    x->low = y->low = (double)INFINITY;
    x->high = y->high = -(double)INFINITY;
    for (int s = 0; s < plot->series_count; s++)
        for (int i = 0; i < plot->series[s].count; i++) {
            const double px = plot->series[s].x[i], py = plot->series[s].y[i];
            if (!shown(plot, px, py))
                continue;
            x->low = fmin(x->low, px);
            x->high = fmax(x->high, px);
            y->low = fmin(y->low, py);
            y->high = fmax(y->high, py);
        }
    if (y->log) {
        y->low = pow(10, floor(log10(y->low)));
        y->high = pow(10, ceil(log10(y->high)));
    } else {
        y->low = fmin(y->low, 0);
    }
}

/* Returns the distance of tick marks: 1, 2 or 5 times a power of ten, about six along the axis. */
static double mark_step(double low, double high) {
    const double raw = (high - low) / 6, power = pow(10, floor(log10(raw))), r = raw / power;
    return power * (r < 1.5 ? 1 : r < 3.5 ? 2 : r < 7.5 ? 5 : 10);
}

static void mark(FILE *svg, const axis *a, bool vertical, double value) {
    const double at = position(a, value);
    if (vertical)
        fprintf(svg,
                "<path d=\"M%d %.1fH%d\" stroke=\"#e3e6ea\"/><text x=\"%d\" y=\"%.1f\" "
                "text-anchor=\"end\">%g</text>\n",
                LEFT, at, WIDTH - RIGHT, LEFT - 8, at + 4, value);
    else
        fprintf(svg,
                "<path d=\"M%.1f %dV%d\" stroke=\"#e3e6ea\"/><text x=\"%.1f\" y=\"%d\" "
                "text-anchor=\"middle\">%g</text>\n",
                at, TOP, HEIGHT - BOTTOM, at, HEIGHT - BOTTOM + 18, value);
}

static void draw_marks(FILE *svg, const axis *a, bool vertical) {
    if (!(a->high > a->low))
        return;
    if (!a->log) {
        const double step = mark_step(a->low, a->high);
        for (double v = ceil(a->low / step) * step; v <= a->high + step * 1e-9; v += step)
            mark(svg, a, vertical, fabs(v) < step * 1e-9 ? 0 : v);
        return;
    }
    const double first = ceil(log10(a->low) - 1e-9), last = floor(log10(a->high) + 1e-9);
    const double step = fmax(1, ceil((last - first) / 8));
    for (double e = first - 1; e <= last; e += step)
        for (int i = 1; i <= 5; i += i == 1 ? 1 : 3) {
            const double v = i * pow(10, e);
            if (v >= a->low * 0.999 && v <= a->high * 1.001 && (i == 1 || last - first < 2))
                mark(svg, a, vertical, v);
        }
}

static void draw_series(FILE *svg, const figure_plot *plot, int s, const axis *x, const axis *y) {
    const figure_series *series = &plot->series[s];
    const char *color = colors[s % COLORS];
    bool down = false;
    fprintf(svg, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"2\" d=\"", color);
    for (int i = 0; i < series->count; i++) {
        if (!shown(plot, series->x[i], series->y[i])) {
            down = false;
            continue;
        }
        fprintf(svg, "%c%.1f %.1f", down ? 'L' : 'M', position(x, series->x[i]),
                position(y, series->y[i]));
        down = true;
    }
    fputs("\"/>\n", svg);
    for (int i = 0; plot->dots && i < series->count; i++)
        if (shown(plot, series->x[i], series->y[i]))
            fprintf(svg, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"5\" fill=\"%s\"/>\n",
                    position(x, series->x[i]), position(y, series->y[i]), color);
    fprintf(svg,
            "<path d=\"M%d %dh18\" stroke=\"%s\" stroke-width=\"3\"/><text x=\"%d\" "
            "y=\"%d\">%s</text>\n",
            WIDTH - RIGHT + 12, TOP + 8 + 20 * s, color, WIDTH - RIGHT + 36, TOP + 12 + 20 * s,
            series->name);
}

void figure_plot_draw(FILE *svg, const figure_plot *plot) {
    axis x = { .log = plot->log_x, .from = LEFT, .to = WIDTH - RIGHT };
    axis y = { .log = plot->log_y, .from = HEIGHT - BOTTOM, .to = TOP };
    span(plot, &x, &y);
    fprintf(svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" "
            "height=\"%d\" font-family=\"system-ui,sans-serif\" font-size=\"13\" "
            "fill=\"#1d2126\"><rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n"
            "<text x=\"%d\" y=\"22\" font-size=\"15\" font-weight=\"600\">%s</text>\n",
            WIDTH, HEIGHT, WIDTH, HEIGHT, LEFT, plot->title);
    draw_marks(svg, &x, false);
    draw_marks(svg, &y, true);
    fprintf(svg, "<path d=\"M%d %dV%dH%d\" fill=\"none\" stroke=\"#1d2126\"/>\n", LEFT, TOP,
            HEIGHT - BOTTOM, WIDTH - RIGHT);
    fprintf(svg, "<text x=\"%d\" y=\"%d\" text-anchor=\"middle\">%s</text>\n",
            (LEFT + WIDTH - RIGHT) / 2, HEIGHT - 10, plot->x_label);
    fprintf(svg,
            "<text transform=\"translate(16 %d) rotate(-90)\" text-anchor=\"middle\">%s</text>\n",
            (TOP + HEIGHT - BOTTOM) / 2, plot->y_label);
    for (int s = 0; s < plot->series_count; s++)
        draw_series(svg, plot, s, &x, &y);
    fputs("</svg>\n", svg);
}

void figure_plot_list(FILE *csv, const figure_plot *plot) {
    fprintf(csv, "series,%s,%s\n", plot->x_label, plot->y_label);
    for (int s = 0; s < plot->series_count; s++)
        for (int i = 0; i < plot->series[s].count; i++)
            fprintf(csv, "%s,%.9g,%.9g\n", plot->series[s].name, plot->series[s].x[i],
                    plot->series[s].y[i]);
}
