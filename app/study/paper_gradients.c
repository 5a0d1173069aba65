/* SPDX-License-Identifier: MIT */
/* The benefit of derivatives of the coefficients by position, which the paper omits: a probe that
 * has them represents the points around it. */
#include "app/study/paper.h"

#include <math.h>

enum { STEPS = 24, DIRECTIONS = 6, BANDS = 10, COUNT = BANDS * BANDS };
#define RATIO 0.2f /* r/d of the light */

/* Errors of coefficients at a point beside the probe, relative to those there: with the probe's
 * own, and with its derivatives as well. */
typedef struct outcome {
    double constant, linear;
} outcome;

/* Measures with a probe at the origin, a light at distance 1, and a point at distance `step` toward
 * the light, away from it or aside. */
static outcome measure(double step, int direction) {
    const lmp_vec3 light = { 0.36f, 0.48f, 0.8f }, origin = { 0, 0, 0 };
    float offset[3] = { 0 }, sh[COUNT], there[COUNT], gradient[3 * COUNT];
    offset[direction / 2] = (float)(direction % 2 ? -step : step);
    const lmp_vec3 point = { offset[0], offset[1], offset[2] };
    lmp_sphere_project_gradient(BANDS, light, RATIO, origin, sh, gradient);
    lmp_sphere_project(BANDS, light, RATIO, point, there);
    double constant = 0, linear = 0, all = 0;
    for (int i = 0; i < COUNT; i++) {
        const double exact = (double)there[i], left = exact - (double)sh[i];
        double slope = 0;
        for (int k = 0; k < 3; k++)
            slope += (double)offset[k] * (double)gradient[k * COUNT + i];
        all += exact * exact;
        constant += left * left;
        linear += (left - slope) * (left - slope);
    }
    return (outcome) { sqrt(constant / all), sqrt(linear / all) };
}

bool paper_step_gradients(paper *p, base_error *error) {
    double steps[STEPS], constant[STEPS] = { 0 }, linear[STEPS] = { 0 };
    for (int i = 0; i < STEPS; i++) {
        steps[i] = 0.002 * pow(100, (double)i / (STEPS - 1));
        for (int k = 0; k < DIRECTIONS; k++) {
            const outcome o = measure(steps[i], k);
            constant[i] = fmax(constant[i], o.constant);
            linear[i] = fmax(linear[i], o.linear);
        }
    }
    page_text(&p->page,
              "Beyond the paper. The coefficients of a light, %d bands, r/d %g, are wanted beside "
              "the point where they are known, at parts of the light's distance: its own "
              "coefficients there, against those of the point with their derivatives by the "
              "position (<code>lmp_sphere_project_gradient</code>), which make the error fall with "
              "the square of the step. Largest error over six directions, root of the sum of "
              "squares in parts of the coefficients'.",
              BANDS, (double)RATIO);
    const figure_series series[] = { { "as they are", steps, constant, STEPS },
                                     { "with derivatives", steps, linear, STEPS } };
    return page_plot_write(&p->page,
                           &(figure_plot) { .file = "gradients",
                                            .title = "Coefficients taken for those beside them",
                                            .x_label = "step, in parts of the distance",
                                            .y_label = "error",
                                            .log_x = true,
                                            .log_y = true,
                                            .series = series,
                                            .series_count = 2 },
                           error);
}
