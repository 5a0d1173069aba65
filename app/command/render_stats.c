/* SPDX-License-Identifier: MIT */
#include "app/command/render.h"
#include "app/file/file.h"
#include "app/scene/instance.h"
#include "app/timing/timing.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>

enum { SHADE = 2, PASSES = 6 };

/* The median of each pass over the repetitions of one method, after a frame that warms it up. */
static bool measure(render_job *j, method_kind method, double medians[PASSES], cli_error *error) {
    static double samples[PASSES][RENDER_REPEAT_MAX];
    render_frame frame = j->frame;
    frame.method = method;
    frame.samples = 1;
    unsigned char *rgb8 = malloc(3 * (size_t)frame.width * (size_t)frame.height);
    bool ok = rgb8 || cli_fail(error, NULL, "out of memory");
    ok = ok && renderer_draw(j->renderer, &frame, NULL, error);
    for (int i = 0; i < j->options->repeat && ok; i++) {
        render_times times;
        shade_field_forget(j->field);
        ok = renderer_draw(j->renderer, &frame, &times, error) &&
             renderer_read_rgb8(j->renderer, &j->display, rgb8, &times, error);
        if (ok) {
            const double passes[PASSES] = { times.surfaces, times.transfer, times.shade,
                                            times.shadow,   times.tone,     times.total };
            for (int p = 0; p < PASSES; p++)
                samples[p][i] = passes[p];
        }
    }
    free(rgb8);
    for (int p = 0; p < PASSES && ok; p++)
        medians[p] = timing_of(samples[p], j->options->repeat).median;
    return ok;
}

/* Whether --stats times a method: its own, or with --compare-methods all that run as it does. */
static bool compared(const render_job *j, method_kind method) {
    if (method == j->method)
        return true;
    return j->options->compare &&
           method_table[method].bands_max[j->device.kind] >= j->options->bands;
}

static bool add_timings(render_job *j, cJSON *stats, cli_error *error) {
    static const char *const names[PASSES] = { "gbuffer", "transfer", "shade",
                                               "shadow",  "tonemap",  "total" };
    cJSON *timings = cJSON_AddObjectToObject(stats, "milliseconds");
    double medians[PASSES], shade[METHODS] = { 0 };
    for (int m = 0; m < METHODS; m++) {
        if (!compared(j, (method_kind)m))
            continue;
        if (!measure(j, (method_kind)m, medians, error))
            return false;
        cJSON *passes = cJSON_AddObjectToObject(timings, method_table[m].name);
        for (int p = 0; p < PASSES; p++)
            cJSON_AddNumberToObject(passes, names[p], medians[p]);
        shade[m] = medians[SHADE];
    }
    for (int m = 0; m < METHODS; m++) {
        const method_row *row = &method_table[m];
        if (row->speedup && shade[m] > 0 && shade[row->compared] > 0)
            cJSON_AddNumberToObject(stats, row->speedup, shade[row->compared] / shade[m]);
    }
    return true;
}

/* By which auto chooses, where the CPU shades. */
static void add_estimates(const render_job *j, cJSON *stats) {
    cJSON *estimates = cJSON_AddObjectToObject(stats, "estimated_milliseconds");
    for (int m = 0; m < METHODS; m++) {
        const double milliseconds = method_estimate((method_kind)m, &j->work);
        if (milliseconds > 0)
            cJSON_AddNumberToObject(estimates, method_table[m].name, milliseconds);
    }
}

/* What is judged by it, where the program has chosen it. */
static void add_exposure(const render_job *j, cJSON *stats) {
    cJSON_AddNumberToObject(stats, "exposure", (double)j->display.exposure);
    if (!(j->lit.average > 0))
        return;
    cJSON *lit = cJSON_AddObjectToObject(stats, "lit_surface");
    cJSON_AddNumberToObject(lit, "part_of_image", (double)j->lit.part);
    cJSON_AddNumberToObject(lit, "average_radiance", (double)j->lit.average);
    cJSON_AddNumberToObject(lit, "brightest_twentieth", (double)j->lit.brightest);
}

/* Of the last frame that was timed. */
static void add_shadows(const render_job *j, cJSON *stats) {
    const shadow_statistics s = shadow_describe(j->shadow);
    cJSON *shadows = cJSON_AddObjectToObject(stats, "shadows");
    cJSON_AddNumberToObject(shadows, "rays_a_pixel", s.rays_a_pixel);
    cJSON_AddNumberToObject(shadows, "rays", (double)s.rays);
    cJSON_AddNumberToObject(shadows, "rays_a_second", 1e3 * (double)s.rays / s.rays_milliseconds);
    cJSON_AddNumberToObject(shadows, "rays_milliseconds", s.rays_milliseconds);
    cJSON_AddNumberToObject(shadows, "filter_milliseconds", s.filter_milliseconds);
}

/* Of the last frame that was shaded by it. */
static void add_field(const render_job *j, cJSON *stats) {
    const shade_field_statistics s = shade_field_describe(j->field);
    const double nodes[3] = { s.info.desc.nodes[0], s.info.desc.nodes[1], s.info.desc.nodes[2] };
    cJSON *field = cJSON_AddObjectToObject(stats, "field");
    cJSON_AddItemToObject(field, "nodes", cJSON_CreateDoubleArray(nodes, 3));
    cJSON_AddNumberToObject(field, "error", (double)s.info.desc.error);
    cJSON_AddNumberToObject(field, "reach", (double)s.info.reach);
    cJSON_AddNumberToObject(field, "bytes", (double)s.info.bytes);
    cJSON_AddNumberToObject(field, "update_milliseconds", s.update_milliseconds);
    if (s.evaluate_milliseconds > 0) /* the library's alone */
        cJSON_AddNumberToObject(field, "evaluate_milliseconds", s.evaluate_milliseconds);
}

/* The median of shading frames whose lights rest, while the camera moves on: the field keeps its
 * nodes, and computes those that come into view. */
static bool add_rest(render_job *j, cJSON *stats, cli_error *error) {
    static double samples[RENDER_REPEAT_MAX];
    render_frame frame = j->frame;
    const float step = 0.002f * (j->world.maximum[0] - j->world.minimum[0]);
    bool ok = true;
    frame.method = METHOD_FIELD;
    frame.samples = 1;
    for (int i = 0; i < j->options->repeat && ok; i++) {
        render_times times;
        frame.camera.eye[0] += step;
        ok = renderer_draw(j->renderer, &frame, &times, error);
        samples[i] = ok ? times.shade : 0;
    }
    if (ok)
        cJSON_AddNumberToObject(cJSON_GetObjectItemCaseSensitive(stats, "field"),
                                "resting_milliseconds",
                                timing_of(samples, j->options->repeat).median);
    return ok;
}

bool render_print_stats(render_job *j, cli_error *error) {
    const render_options *o = j->options;
    cJSON *stats = cJSON_CreateObject();
    cJSON_AddStringToObject(stats, "scene", j->world.name);
    cJSON_AddNumberToObject(stats, "triangles", (double)scene_triangle_count(&j->world));
    cJSON_AddNumberToObject(stats, "lights", (double)j->world.light_count);
    cJSON_AddNumberToObject(stats, "bands", o->bands);
    cJSON_AddStringToObject(stats, "method", method_table[j->method].name);
    cJSON_AddStringToObject(stats, "window", lmp_sh_window_name((lmp_window)o->window));
    cJSON_AddNumberToObject(stats, "width", o->size[0]);
    cJSON_AddNumberToObject(stats, "height", o->size[1]);
    add_exposure(j, stats);
    cJSON_AddStringToObject(stats, "device", j->device.name);
    cJSON_AddStringToObject(stats, "driver", j->device.driver);
    cJSON_AddStringToObject(stats, "clock", render_device_clock(&j->device));
    cJSON_AddNumberToObject(stats, "repeat", o->repeat);
    cJSON_AddStringToObject(stats, "shading", device_table[j->device.kind].name);
    if (j->lobes)
        cJSON_AddNumberToObject(stats, "preintegrated_bytes",
                                (double)lmp_preintegrated_lobe_describe(j->lobes).bytes);
    if (j->device.kind == DEVICE_CPU)
        add_estimates(j, stats);
    if (!add_timings(j, stats, error)) {
        cJSON_Delete(stats);
        return false;
    }
    if (j->field) {
        add_field(j, stats);
        if (!add_rest(j, stats, error)) {
            cJSON_Delete(stats);
            return false;
        }
    }
    if (j->shadow)
        add_shadows(j, stats);
    return file_json_print(stats, NULL, error);
}
