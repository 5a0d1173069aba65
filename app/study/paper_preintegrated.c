/* SPDX-License-Identifier: MIT */
/* The memory and the errors of preintegrated lobes (docs/preintegration-notes.md). */
#include "app/base/timing.h"
#include "app/study/paper.h"

#include <math.h>

enum { BOUNDS = 6, SETTINGS = 3, EXPONENTS = 33, RATIOS = 12, ANGLES = 200 };

static const float bounds[BOUNDS] = { 0.002f, 0.005f, 0.01f, 0.02f, 0.05f, 0.1f };

/* Differences from the series, relative to its largest value over the angles. */
typedef struct outcome {
    double kilobytes, largest, rms, seconds;
} outcome;

/* Adds the errors for one lobe and one light at all angles, half of them where the lobe is. */
static void add_angles(const lmp_preintegrated_lobe *table, double exponent, double ratio,
                       double *largest, double *squares) {
    const int bands = lmp_preintegrated_lobe_describe(table).bands;
    const lmp_light light = { .position = { 0, 0, 1 },
                              .radius = (float)ratio,
                              .radiance = { 1, 1, 1 } };
    const lmp_vec3 origin = { 0, 0, 0 };
    const double near = fmin(asin(ratio) + 4 / sqrt(exponent + 1) + 4.0 / bands, 3.14159);
    float lambda[LMP_BANDS_MAX];
    double difference[ANGLES], top = 0;
    lmp_cap cap;
    lmp_lobe_make_phong(bands, (float)exponent, lambda);
    lmp_light_find_cap(&light, origin, &cap);
    for (int i = 0; i < ANGLES; i++) {
        const double part = (i / 2 + 0.5) / (ANGLES / 2.0);
        const float angle = (float)(i % 2 ? acos(1 - 2 * part) : near * part);
        const lmp_vec3 axis = { sinf(angle), 0, cosf(angle) };
        const double exact = (double)lmp_lobe_response(bands, lambda, axis, &light, 1, origin).r;
        const float read = lmp_preintegrated_lobe_eval(table, (float)exponent, cap.one_minus_cos,
                                                       cosf(angle) * cap.axis.z);
        difference[i] = fabs((double)(cap.strength.r * read + cap.ambient.r) - exact);
        top = fmax(top, fabs(exact));
    }
    for (int i = 0; i < ANGLES; i++) {
        *largest = fmax(*largest, difference[i] / top);
        *squares += difference[i] * difference[i] / (top * top);
    }
}

/* Measures exponents 1 … 10 000 and r/d 1e-4 … 0.99, in logarithmic steps. */
static bool measure(int bands, float bound, outcome *o, base_error *error) {
    const lmp_preintegrated_lobe_desc desc = { .bands = bands, .error = bound };
    const double start = timing_now();
    lmp_preintegrated_lobe *table;
    const lmp_result result = lmp_preintegrated_lobe_create(NULL, &desc, &table);
    if (result != LMP_OK)
        return base_fail(error, NULL, "the lobes of %d bands: %s", bands, lmp_result_text(result));
    *o = (outcome) { .seconds = timing_now() - start,
                     .kilobytes = (double)lmp_preintegrated_lobe_describe(table).bytes / 1024 };
    double largest = 0, squares = 0;
#pragma omp parallel for reduction(max : largest) reduction(+ : squares) schedule(dynamic)
    for (int e = 0; e < EXPONENTS; e++)
        for (int r = 0; r < RATIOS; r++)
            add_angles(table, pow(1e4, (e + 0.37) / EXPONENTS),
                       1e-4 * pow(9900, (r + 0.5) / RATIOS), &largest, &squares);
    o->largest = largest;
    o->rms = sqrt(squares / (EXPONENTS * RATIOS * ANGLES));
    lmp_preintegrated_lobe_destroy(table);
    return true;
}

bool paper_step_preintegrated(paper *p, base_error *error) {
    static const int bands[SETTINGS] = { 10, 20, 100 };
    static const char *const names[2 * SETTINGS] = { "10, largest", "20, largest", "100, largest",
                                                     "10, rms",     "20, rms",     "100, rms" };
    double x[SETTINGS][BOUNDS], y[2 * SETTINGS][BOUNDS];
    figure_series series[2 * SETTINGS];
    page_table table;
    page_text(&p->page, "Preintegrated lobes against their series of bands, %d values each.",
              EXPONENTS * RATIOS * ANGLES);
    if (!page_table_begin(&p->page, &table, "preintegrated",
                          "bands|bound %|KB|largest error %|rms error %|seconds", error))
        return false;
    bool ok = true;
    for (int s = 0; s < SETTINGS && ok; s++)
        for (int b = 0; b < BOUNDS && ok; b++) {
            outcome o = { 0, 0, 0, 0 };
            ok = measure(bands[s], bounds[b], &o, error);
            x[s][b] = o.kilobytes;
            y[s][b] = 100 * o.largest;
            y[SETTINGS + s][b] = 100 * o.rms;
            page_table_row(&table, "%d|%g|%.0f|%.3f|%.4f|%.2f", bands[s], 100 * (double)bounds[b],
                           o.kilobytes, 100 * o.largest, 100 * o.rms, o.seconds);
        }
    base_error ignored;
    if (!page_table_end(&table, ok ? error : &ignored) || !ok)
        return false;
    for (int s = 0; s < 2 * SETTINGS; s++)
        series[s] = (figure_series) { names[s], x[s % SETTINGS], y[s], BOUNDS };
    return page_plot_write(&p->page,
                           &(figure_plot) { .file = "preintegrated-memory",
                                            .title = "Preintegrated lobes: memory and error",
                                            .x_label = "KB",
                                            .y_label = "error, % of the peak",
                                            .log_x = true,
                                            .log_y = true,
                                            .series = series,
                                            .series_count = 2 * SETTINGS },
                           error);
}
