/* SPDX-License-Identifier: MIT */
/* The cost of a field per point, and its difference from the sum of all lights, which the paper
 * computes (docs/fields.md). */
#include "app/base/timing.h"
#include "app/scene/random.h"
#include "app/study/paper.h"

#include <math.h>
#include <stdlib.h>

enum {
    COUNTS = 5,
    BANDS = 5,
    SIDE = 48,
    POINTS = SIDE * SIDE,
    VALUES = 3 * BANDS * BANDS,
    NODES = 32,
    RUNS = 3
};
static const int counts[COUNTS] = { 10, 50, 250, 1000, 4000 };

typedef struct room {
    lmp_light lights[4000];
    lmp_vec3 points[POINTS];
    float exact[POINTS * VALUES], read[POINTS * VALUES];
} room;

/* Times per point in microseconds, of the lights' nodes in milliseconds; errors relative to the
 * coefficients at the point. */
typedef struct outcome {
    double exact, read, update, largest, rms;
} outcome;

static lmp_vec3 random_point(uint64_t *random) {
    float at[3];
    for (int k = 0; k < 3; k++)
        at[k] = random_between(random, 0, 1);
    return (lmp_vec3) { at[0], at[1], at[2] };
}

/* Distributes lights over a box of edge 1, and points side by side on a plane in it. */
static void fill(room *r) {
    uint64_t random = 1;
    for (size_t i = 0; i < sizeof r->lights / sizeof *r->lights; i++) {
        const lmp_vec3 position = random_point(&random);
        r->lights[i] = (lmp_light) { .position = position,
                                     .radius = 0.004f,
                                     .radiance = { random_unit(&random), random_unit(&random),
                                                   random_unit(&random) } };
    }
    for (int i = 0; i < POINTS; i++)
        r->points[i] = (lmp_vec3) { 0.3f + 0.2f * (float)(i % SIDE) / SIDE, 0.5f,
                                    0.4f + 0.2f * (float)(i / SIDE) / SIDE };
}

static lmp_vec3_array points_of(const room *r) {
    return (lmp_vec3_array) { &r->points->x, &r->points->y, &r->points->z, sizeof *r->points };
}

static void compare(const room *r, outcome *o) {
    double squares = 0;
    for (int i = 0; i < POINTS; i++) {
        double difference = 0, all = 0;
        for (int k = 0; k < VALUES; k++) {
            const double exact = (double)r->exact[i * VALUES + k];
            const double read = (double)r->read[i * VALUES + k];
            difference += (read - exact) * (read - exact);
            all += exact * exact;
        }
        o->largest = fmax(o->largest, sqrt(difference / all));
        squares += difference / all;
    }
    o->rms = sqrt(squares / POINTS);
}

/* Measures on one core; times per point are the least of several runs. */
static bool measure(room *r, int count, outcome *o, base_error *error) {
    const lmp_field_desc desc = { .bands = BANDS,
                                  .nodes = { NODES, NODES, NODES },
                                  .cell = { 1.0f / (NODES - 1), 1.0f / (NODES - 1),
                                            1.0f / (NODES - 1) },
                                  .light_max = (size_t)count };
    const lmp_spheres spheres = lmp_spheres_of(r->lights);
    const size_t stride = VALUES * sizeof(float);
    lmp_field *field;
    lmp_result result = lmp_field_create(NULL, &desc, &field);
    *o = (outcome) { .exact = HUGE_VAL, .read = HUGE_VAL };
    const double begun = timing_now();
    if (result == LMP_OK)
        result = lmp_field_update(NULL, field, r->lights, (size_t)count);
    o->update = 1e3 * (timing_now() - begun);
    for (int run = 0; run < RUNS && result == LMP_OK; run++) {
        const double start = timing_now();
        lmp_field_eval_n(field, points_of(r), POINTS, lmp_sh_interleaved(r->read, stride));
        const double read = timing_now();
        lmp_sphere_sum_n(NULL, BANDS, &spheres, (size_t)count, NULL, points_of(r), POINTS,
                         lmp_sh_interleaved(r->exact, stride));
        o->exact = fmin(o->exact, 1e6 * (timing_now() - read) / POINTS);
        o->read = fmin(o->read, 1e6 * (read - start) / POINTS);
    }
    lmp_field_destroy(field);
    if (result != LMP_OK)
        return base_fail(error, NULL, "a field of %d lights: %s", count, lmp_result_text(result));
    compare(r, o);
    return true;
}

static bool write_measures(paper *p, room *r, base_error *error) {
    double lights[COUNTS], exact[COUNTS], read[COUNTS];
    page_table table;
    if (!page_table_begin(&p->page, &table, "fields-cost",
                          "lights|sum of all, µs a point|field, µs a point|its nodes, ms|"
                          "largest error %|rms error %",
                          error))
        return false;
    bool ok = true;
    for (int i = 0; i < COUNTS && ok; i++) {
        outcome o;
        ok = measure(r, counts[i], &o, error);
        lights[i] = counts[i];
        exact[i] = o.exact;
        read[i] = o.read;
        page_table_row(&table, "%d|%.2f|%.2f|%.1f|%.3f|%.4f", counts[i], o.exact, o.read, o.update,
                       100 * o.largest, 100 * o.rms);
    }
    base_error ignored;
    if (!page_table_end(&table, ok ? error : &ignored) || !ok)
        return false;
    const figure_series series[] = { { "sum of all lights", lights, exact, COUNTS },
                                     { "field", lights, read, COUNTS } };
    return page_plot_write(&p->page,
                           &(figure_plot) { .file = "fields",
                                            .title = "Coefficients at a point under many lights",
                                            .x_label = "lights",
                                            .y_label = "microseconds a point",
                                            .log_x = true,
                                            .log_y = true,
                                            .dots = true,
                                            .series = series,
                                            .series_count = 2 },
                           error);
}

bool paper_step_fields(paper *p, base_error *error) {
    room *r = calloc(1, sizeof *r);
    if (!r)
        return base_fail(error, NULL, "out of memory");
    fill(r);
    page_text(&p->page,
              "Beyond the paper, whose cost at a point is proportional to the lights. A field "
              "holds coefficients and their derivatives on a grid, here %d nodes along each edge "
              "of a box, and sums only the lights near a point. %d points, %d bands, one core; "
              "errors in parts of the coefficients at the point.",
              NODES, POINTS, BANDS);
    const bool ok = write_measures(p, r, error);
    free(r);
    return ok;
}
