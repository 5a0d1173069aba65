/* SPDX-License-Identifier: MIT */
#include "app/truth/scoreboard_plates.h"
#include "app/image/figure.h"
#include "app/scene/vector.h"
#include "app/truth/reference_ggx.h"

#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 192, HEIGHT = 96, PIXELS = WIDTH * HEIGHT, GAP = 6, COLUMNS = 4, STEPS = 32 };

static const lmp_vec3 camera = { 0, -3.2f, 1.1f }, center = { 0, 0.4f, 0.7f };
static const float radius = 0.35f, roughness = 0.4f;

/* --- the plate, z = 0 ------------------------------------------------------------------------- */

static formula_query query_of(int pixel) {
    const float x = ((float)(pixel % WIDTH) + 0.5f) / WIDTH - 0.5f;
    const float y = ((float)(pixel / WIDTH) + 0.5f) / WIDTH;
    const lmp_vec3 ray = vec(x * 0.9f, 1, -0.14f - y * 1.2f);
    const lmp_vec3 point = vec_add(camera, vec_scale(ray, camera.z / -ray.z));
    const lmp_vec3 to_light = vec_sub(center, point), up = vec(0, 0, 1);
    return (formula_query) { .normal = up,
                             .view = vec_normalize(vec_sub(camera, point), up),
                             .light = vec_normalize(to_light, up),
                             .sine = radius / vec_length(to_light),
                             .material = RULER_METAL,
                             .color = 1,
                             .roughness = roughness };
}

/* Computes what glTF's appendix B reflects, by midpoints of equal solid angles around the light. */
static double truth_of(const formula_query *q) {
    const double base[3] = { 1, 1, 1 }, sine = (double)q->sine;
    const double height = sine * sine / (1 + sqrt(1 - sine * sine));
    const reference_dielectric dielectric = { { 0.04, 0.04, 0.04 }, 1 };
    const reference_vec axis = reference_from(q->light), x = reference_around(axis, 0, 1, 0);
    const reference_vec y = reference_cross(axis, x);
    double sum = 0;
    reference_ggx ggx;
    reference_ggx_set(&ggx, base, 1, (double)q->roughness, &dielectric, reference_from(q->normal),
                      reference_from(q->view));
    for (int k = 0; k < STEPS * STEPS; k++) {
        const double z = 1 - height * (k % STEPS + 0.5) / STEPS, across = sqrt(1 - z * z);
        const double phi = 2 * REFERENCE_PI * (k / STEPS + 0.5) / STEPS;
        const reference_vec w = reference_add(reference_scale(z, axis),
                                              reference_add(reference_scale(across * cos(phi), x),
                                                            reference_scale(across * sin(phi), y)));
        double rgb[3];
        reference_ggx_at(&ggx, w, rgb);
        sum += rgb[0];
    }
    return sum * 2 * REFERENCE_PI * height / (STEPS * STEPS);
}

static double truths(double truth[PIXELS]) {
    double peak = 0;
#pragma omp parallel for schedule(dynamic, WIDTH) reduction(max : peak)
    for (int i = 0; i < PIXELS; i++) {
        const formula_query q = query_of(i);
        truth[i] = truth_of(&q);
        peak = fmax(peak, truth[i]);
    }
    return peak;
}

/* --- cells ------------------------------------------------------------------------------------ */

static lmp_rgb difference_color(double part) {
    const float t = (float)fmin(fabs(part) / PLATES_FULL, 1);
    return part > 0 ? (lmp_rgb) { 1, 1 - t, 1 - t } : (lmp_rgb) { 1 - t, 1 - t, 1 };
}

static void draw_cell(image *pixels, int cell, const double *value, const double *truth,
                      double peak) {
    const int left = GAP + cell % COLUMNS * (WIDTH + GAP);
    const int top = GAP + cell / COLUMNS * (2 * HEIGHT + 2 * GAP);
    char number[12];
    for (int i = 0; i < PIXELS; i++) {
        const float v = (float)fmin(value[i] / peak, 1);
        const figure_box dot = { left + i % WIDTH, top + i / WIDTH, 1, 1 };
        const figure_box below = { dot.x, dot.y + HEIGHT, 1, 1 };
        figure_fill(pixels, dot, (lmp_rgb) { v, v, v });
        figure_fill(pixels, below, difference_color((value[i] - truth[i]) / peak));
    }
    snprintf(number, sizeof number, "%d", cell);
    figure_text(pixels, (figure_box) { left + 2, top + 2, 20, 16 }, 12, (lmp_rgb) { 1, 1, 1 },
                number);
}

static bool draw_formula(image *pixels, const board *b, const formula *by, int cell,
                         const double *truth, double peak, base_error *error) {
    static double value[PIXELS];
    formula_reads reads;
    if (!formula_open(by, b->published, &reads, error))
        return false;
    for (int i = 0; i < PIXELS; i++) {
        const formula_query q = query_of(i);
        value[i] = (double)by->radiance(&q, &reads);
    }
    formula_close(&reads);
    draw_cell(pixels, cell, value, truth, peak);
    return true;
}

static int cells_of(const board *b) {
    int cells = 1;
    for (int k = 0; k < b->count; k++)
        cells += b->scores[k].by->applies[RULER_METAL];
    return cells;
}

bool plates_write(const board *b, const char *path, base_error *error) {
    static double truth[PIXELS];
    const int cells = cells_of(b), rows = (cells + COLUMNS - 1) / COLUMNS;
    image pixels;
    if (!image_check_path(path, error) || !image_create(&pixels, GAP + COLUMNS * (WIDTH + GAP),
                                                        GAP + rows * (2 * HEIGHT + 2 * GAP), error))
        return false;
    figure_fill(&pixels, (figure_box) { 0, 0, pixels.width, pixels.height }, (lmp_rgb) { 1, 1, 1 });
    const double peak = truths(truth);
    bool drawn = true;
    draw_cell(&pixels, 0, truth, truth, peak);
    for (int k = 0, cell = 1; k < b->count && drawn; k++)
        if (b->scores[k].by->applies[RULER_METAL])
            drawn = draw_formula(&pixels, b, b->scores[k].by, cell++, truth, peak, error);
    drawn = drawn && image_write_figure(&pixels, path, error);
    image_free(&pixels);
    return drawn;
}
