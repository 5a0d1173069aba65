/* SPDX-License-Identifier: MIT */
/* The error of truncating lobes to a number of bands, against quadrature of the whole lobes. */
#include "app/study/paper.h"
#include "app/truth/reference_quadrature.h"

#include <math.h>

enum { ANGLES = 91, BAND_COUNTS = 9, RATIOS = 14 }; /* 90 degrees is one of the angles */

static const int band_counts[BAND_COUNTS] = { 2, 3, 5, 8, 10, 15, 20, 30, 50 };

/* One lobe of weight 1 and one light of unit radiance. */
typedef struct setting {
    double exponent, ratio; /* r/d */
    lmp_window window;
} setting;

/* The errors of a setting, relative to the exact response's peak over all angles. */
typedef struct outcome {
    double largest;  /* largest difference */
    double negative; /* depth of ringing below 0 */
    double peak;     /* of the truncated response */
    double grazing;  /* largest difference where the lobe's axis points beside the light */
} outcome;

static double response(const setting *s, int bands, double angle) {
    const reference_band_limit limit = { .bands = bands, .window = s->window };
    const reference_material material = { .specular = { 1, 1, 1 }, .exponent = s->exponent };
    const scene_light light = {
        .emitter = { .position = { (float)sin(angle), (float)cos(angle), 0 },
                     .radius = (float)s->ratio,
                     .radiance = { 1, 1, 1 } },
    };
    const reference_vec up = { 0, 1, 0 };
    reference_surface surface;
    double radiance[3];
    reference_surface_set(&surface, &limit, &material, (reference_vec) { 0, 0, 0 }, up, up);
    reference_quadrature(&surface, &light, 1, radiance);
    return radiance[0];
}

static void exact_responses(const setting *s, double exact[ANGLES]) {
    for (int i = 0; i < ANGLES; i++)
        exact[i] = response(s, 0, REFERENCE_PI * i / (ANGLES - 1));
}

static outcome measure(const setting *s, const double exact[ANGLES], int bands) {
    outcome o = { 0, 0, 0, 0 };
    double top = 0;
    for (int i = 0; i < ANGLES; i++)
        top = fmax(top, exact[i]);
    for (int i = 0; i < ANGLES; i++) {
        const double angle = REFERENCE_PI * i / (ANGLES - 1), truncated = response(s, bands, angle);
        o.largest = fmax(o.largest, fabs(truncated - exact[i]) / top);
        o.negative = fmax(o.negative, -truncated / top);
        o.peak = fmax(o.peak, truncated / top);
        if (angle > REFERENCE_PI / 3 && angle < REFERENCE_PI * 2 / 3)
            o.grazing = fmax(o.grazing, fabs(truncated - exact[i]) / top);
    }
    return o;
}

static bool plot_by(paper *p, const char *file, const char *title, const setting *settings,
                    const char *const *names, int count, base_error *error) {
    double x[BAND_COUNTS], y[8][BAND_COUNTS];
    figure_series series[8];
#pragma omp parallel for schedule(dynamic)
    for (int s = 0; s < count; s++) {
        double exact[ANGLES];
        exact_responses(&settings[s], exact);
        for (int c = 0; c < BAND_COUNTS; c++)
            y[s][c] = measure(&settings[s], exact, band_counts[c]).largest;
    }
    for (int c = 0; c < BAND_COUNTS; c++)
        x[c] = band_counts[c];
    for (int s = 0; s < count; s++)
        series[s] = (figure_series) { names[s], x, y[s], BAND_COUNTS };
    return page_plot_write(&p->page,
                           &(figure_plot) { .file = file,
                                            .title = title,
                                            .x_label = "bands",
                                            .y_label = "largest error / peak",
                                            .log_x = true,
                                            .log_y = true,
                                            .y_floor = 1e-6,
                                            .series = series,
                                            .series_count = count },
                           error);
}

static bool plot_exponents(paper *p, base_error *error) {
    static const char *const names[] = { "diffuse", "e = 10", "e = 50", "e = 200", "e = 1000" };
    const double exponents[] = { 1, 10, 50, 200, 1000 };
    setting settings[5];
    for (int i = 0; i < 5; i++)
        settings[i] = (setting) { exponents[i], 0.3, LMP_WINDOW_NONE };
    return plot_by(p, "cost-exponent", "Error by exponent, r/d = 0.3, no windowing filter",
                   settings, names, 5, error);
}

static bool plot_sizes(paper *p, base_error *error) {
    static const char *const names[] = { "r/d = 0.95", "r/d = 0.5", "r/d = 0.1", "r/d = 0.01" };
    const double ratios[] = { 0.95, 0.5, 0.1, 0.01 };
    setting settings[4];
    for (int i = 0; i < 4; i++)
        settings[i] = (setting) { 50, ratios[i], LMP_WINDOW_NONE };
    return plot_by(p, "cost-size", "Error by size of the light, e = 50, no windowing filter",
                   settings, names, 4, error);
}

static bool plot_windows(paper *p, base_error *error) {
    static const char *const names[] = { "none", "Hanning", "Lanczos" };
    setting settings[3];
    for (int i = 0; i < 3; i++)
        settings[i] = (setting) { 50, 0.3, (lmp_window)i };
    return plot_by(p, "cost-window", "Error by windowing filter, e = 50, r/d = 0.3", settings,
                   names, 3, error);
}

/* Plots the approach of a light; its distance enters the cap and the coefficients only as r/d. */
static bool plot_distance(paper *p, base_error *error) {
    static const char *const names[] = { "diffuse, 3", "diffuse, 5", "diffuse, 10",
                                         "e = 50, 5",  "e = 50, 10", "e = 50, 20" };
    const double exponents[] = { 1, 1, 1, 50, 50, 50 };
    const int bands[] = { 3, 5, 10, 5, 10, 20 };
    const double ratios[RATIOS] = { 0.01, 0.02, 0.05, 0.1, 0.2, 0.3,  0.4,
                                    0.5,  0.6,  0.7,  0.8, 0.9, 0.97, 0.999 };
    double y[6][RATIOS];
    figure_series series[6];
#pragma omp parallel for schedule(dynamic)
    for (int r = 0; r < RATIOS; r++)
        for (int i = 0; i < 6; i++) {
            const setting s = { exponents[i], ratios[r], LMP_WINDOW_NONE };
            double exact[ANGLES];
            exact_responses(&s, exact);
            y[i][r] = measure(&s, exact, bands[i]).largest;
        }
    for (int i = 0; i < 6; i++)
        series[i] = (figure_series) { names[i], ratios, y[i], RATIOS };
    return page_plot_write(
        &p->page,
        &(figure_plot) { .file = "cost-distance",
                         .title = "Error by r/d, from far to near, no windowing filter",
                         .x_label = "r/d",
                         .y_label = "largest error / peak",
                         .log_x = true,
                         .log_y = true,
                         .series = series,
                         .series_count = 6 },
        error);
}

/* Plots the response as the light moves away from the lobe's axis. */
static bool plot_angles(paper *p, const char *file, const char *title, double exponent,
                        const int bands[3], base_error *error) {
    double x[ANGLES], y[5][ANGLES];
    char names[5][32] = { "exact" };
    figure_series series[5];
    const double ratio = 0.2;
    const double peak = response(&(setting) { exponent, ratio, LMP_WINDOW_NONE }, 0, 0);
    for (int k = 0; k < 5; k++) {
        const setting s = { exponent, ratio, k == 4 ? LMP_WINDOW_HANNING : LMP_WINDOW_NONE };
        const int n = k == 0 ? 0 : k == 4 ? bands[2] : bands[k - 1];
        if (k > 0)
            snprintf(names[k], sizeof names[k], "%d bands%s", n, k == 4 ? ", Hanning" : "");
        for (int i = 0; i < ANGLES; i++) {
            x[i] = 180.0 * i / (ANGLES - 1);
            y[k][i] = response(&s, n, REFERENCE_PI * i / (ANGLES - 1)) / peak;
        }
        series[k] = (figure_series) { names[k], x, y[k], ANGLES };
    }
    return page_plot_write(&p->page,
                           &(figure_plot) { .file = file,
                                            .title = title,
                                            .x_label = "degrees from the lobe's axis to the light",
                                            .y_label = "response / exact peak",
                                            .series = series,
                                            .series_count = 5 },
                           error);
}

static bool tabulate(paper *p, base_error *error) {
    const char *const names[] = { "diffuse", "50", "1000" };
    const double exponents[] = { 1, 50, 1000 }, ratios[] = { 0.9, 0.3, 0.03 };
    const int bands[] = { 5, 10, 20 };
    page_table table;
    if (!page_table_begin(
            &p->page, &table, "cost",
            "exponent|r/d|bands|window|error|lowest|peak|error, axis 60° to 120° away", error))
        return false;
    for (int e = 0; e < 3; e++)
        for (int r = 0; r < 3; r++)
            for (int w = 0; w < 2; w++)
                for (int b = 0; b < 3; b++) {
                    const setting s = { exponents[e], ratios[r], (lmp_window)w };
                    double exact[ANGLES];
                    exact_responses(&s, exact);
                    const outcome o = measure(&s, exact, bands[b]);
                    page_table_row(&table, "%s|%g|%d|%s|%.1e|%.3f|%.2f|%.1e", names[e], s.ratio,
                                   bands[b], w ? "Hanning" : "none", o.largest, -o.negative, o.peak,
                                   o.grazing);
                }
    return page_table_end(&table, error);
}

bool paper_step_cost(paper *p, base_error *error) {
    page_text(
        &p->page,
        "One lobe and one sphere light: the truncated series against quadrature of the whole lobe, "
        "at %d angles between the lobe's axis and the light. Errors are parts of the exact "
        "response's peak.",
        ANGLES);
    if (!plot_angles(p, "cost-diffuse", "Diffuse surface, r/d = 0.2", 1, (int[]) { 3, 5, 10 },
                     error) ||
        !plot_angles(p, "cost-lobe", "Lobe of exponent 50, r/d = 0.2", 50, (int[]) { 5, 10, 20 },
                     error) ||
        !plot_exponents(p, error) || !plot_sizes(p, error) || !plot_distance(p, error) ||
        !plot_windows(p, error) || !tabulate(p, error))
        return false;
    page_text(&p->page,
              "<b>Where the method is poor.</b> A lobe of exponent e needs about 3 √e bands: below "
              "that its highlight is too dim and too wide, and it rings, below zero at a distance "
              "from the highlight (column “lowest”). A windowing filter trades the ringing for "
              "more blur: the "
              "peak falls further and the error grows. Large lights are easier than small ones, "
              "for they blur the lobe themselves. Nothing here knows visibility: light passes "
              "through walls.");
    return true;
}
