/* SPDX-License-Identifier: MIT */
#include "app/base/file_json.h"
#include "app/base/timing.h"
#include "app/command/render.h"
#include "app/scene/instance.h"

#include <stdio.h>
#include <stdlib.h>

enum { SHADE = 2, PASSES = 7 };

/* Returns the samples per pixel of the frames that --stats times: one, as a frame in motion has,
 * unless the option gives them. */
static int timed_samples(const render_options *o) {
    return o->samples_given ? o->samples : 1;
}

/* Measures the median of each pass over the repetitions of one method, after a frame to warm up. */
static bool measure(render_job *j, method_kind method, double medians[PASSES], base_error *error) {
    static double samples[PASSES][RENDER_REPEAT_MAX];
    render_frame frame = j->frame;
    frame.method = method;
    frame.samples = timed_samples(j->options);
    unsigned char *rgb8 = malloc(3 * (size_t)frame.width * (size_t)frame.height);
    bool ok = rgb8 || base_fail(error, NULL, "out of memory");
    ok = ok && renderer_draw(j->renderer, &frame, NULL, error);
    for (int i = 0; i < j->options->repeat && ok; i++) {
        render_times times;
        shade_field_forget(j->field);
        ok = renderer_draw(j->renderer, &frame, &times, error) &&
             renderer_read_rgb8(j->renderer, &j->display, rgb8, &times, error);
        if (ok) {
            const double passes[PASSES] = { times.surfaces, times.transfer, times.shade,
                                            times.shadow,   times.bounces,  times.tone,
                                            times.total };
            for (int p = 0; p < PASSES; p++)
                samples[p][i] = passes[p];
        }
    }
    free(rgb8);
    for (int p = 0; p < PASSES && ok; p++)
        medians[p] = timing_of(samples[p], j->options->repeat).median;
    return ok;
}

/* Whether --stats times a method: that of the image or, with --compare-methods, every one with
 * enough bands on this device. */
static bool compared(const render_job *j, method_kind method) {
    if (method == j->method)
        return true;
    return j->options->compare &&
           method_table[method].bands_max[j->device.kind] >= j->options->bands;
}

static json_t *passes_to_json(const double medians[PASSES]) {
    static const char *const names[PASSES] = { "gbuffer", "transfer", "shade", "shadow",
                                               "bounces", "tonemap",  "total" };
    json_t *passes = json_object();
    for (int p = 0; p < PASSES; p++)
        passes = file_json_with(passes, names[p], file_json_real(medians[p]));
    return passes;
}

static bool add_timings(render_job *j, json_t **stats, base_error *error) {
    json_t *timings = json_object();
    double medians[PASSES], shade[METHODS] = { 0 };
    for (int m = 0; m < METHODS; m++) {
        if (!compared(j, (method_kind)m))
            continue;
        if (!measure(j, (method_kind)m, medians, error)) {
            json_decref(timings);
            return false;
        }
        timings = file_json_with(timings, method_table[m].name, passes_to_json(medians));
        shade[m] = medians[SHADE];
    }
    *stats = file_json_with(*stats, "milliseconds", timings);
    for (int m = 0; m < METHODS; m++) {
        const method_row *row = &method_table[m];
        if (row->speedup && shade[m] > 0 && shade[row->compared] > 0)
            *stats = file_json_with(*stats, row->speedup,
                                    file_json_real(shade[row->compared] / shade[m]));
    }
    return true;
}

/* Writes the estimates by which auto chooses a method when the CPU shades. */
static json_t *estimates_to_json(const render_job *j) {
    json_t *estimates = json_object();
    for (int m = 0; m < METHODS; m++) {
        const double milliseconds = method_estimate((method_kind)m, &j->work);
        if (milliseconds > 0)
            estimates =
                file_json_with(estimates, method_table[m].name, file_json_real(milliseconds));
    }
    return estimates;
}

/* Adds the exposure and, if it was determined automatically, the statistics that it is based on. */
static json_t *with_exposure(json_t *stats, const render_job *j) {
    stats = file_json_with(stats, "exposure", file_json_float(j->display.exposure));
    if (!(j->lit.average > 0))
        return stats;
    return file_json_with(stats, "lit_surface",
                          json_pack("{s:o, s:o, s:o}", "part_of_image",
                                    file_json_float(j->lit.part), "average_radiance",
                                    file_json_float(j->lit.average), "brightest_twentieth",
                                    file_json_float(j->lit.brightest)));
}

/* Writes the shadows' statistics of the last timed frame. */
static json_t *shadows_to_json(const render_job *j) {
    const shadow_statistics s = shadow_describe(j->shadow);
    return json_pack("{s:o, s:I, s:o, s:o, s:o}", "rays_a_pixel", file_json_real(s.rays_a_pixel),
                     "rays", (json_int_t)s.rays, "rays_a_second",
                     file_json_real(1e3 * (double)s.rays / s.rays_milliseconds),
                     "rays_milliseconds", file_json_real(s.rays_milliseconds),
                     "filter_milliseconds", file_json_real(s.filter_milliseconds));
}

static json_t *bounces_to_json(const render_job *j) {
    const transfer_statistics s = transfer_describe(j->bounces);
    return json_pack("{s:i, s:I, s:I, s:o, s:I, s:o, s:o, s:o}", "bounces", j->options->bounces,
                     "surfels", (json_int_t)s.surfels, "receivers", (json_int_t)s.receivers,
                     "spacing", file_json_float(s.spacing), "bytes", (json_int_t)s.bytes,
                     "create_milliseconds", file_json_real(s.create_milliseconds),
                     "light_milliseconds", file_json_real(s.light_milliseconds),
                     "bounce_milliseconds", file_json_real(s.bounce_milliseconds));
}

/* Measures the median shading time of frames with resting lights and a moving camera: the field
 * keeps its nodes, and computes only those that come into view. */
static bool time_rest(render_job *j, double *milliseconds, base_error *error) {
    static double samples[RENDER_REPEAT_MAX];
    render_frame frame = j->frame;
    const float step = 0.002f * (j->world.maximum[0] - j->world.minimum[0]);
    bool ok = true;
    frame.method = METHOD_FIELD;
    frame.samples = timed_samples(j->options);
    for (int i = 0; i < j->options->repeat && ok; i++) {
        render_times times;
        frame.camera.eye[0] += step;
        ok = renderer_draw(j->renderer, &frame, &times, error);
        samples[i] = ok ? times.shade : 0;
    }
    if (ok)
        *milliseconds = timing_of(samples, j->options->repeat).median;
    return ok;
}

static bool add_field(render_job *j, json_t **stats, base_error *error) {
    /* from the last frame that the field shaded */
    const shade_field_statistics s = shade_field_describe(j->field);
    const int *nodes = s.info.desc.nodes;
    double resting;
    if (!time_rest(j, &resting, error))
        return false;
    json_t *field = json_pack("{s:[i, i, i], s:o, s:o, s:I, s:o}", "nodes", nodes[0], nodes[1],
                              nodes[2], "error", file_json_float(s.info.desc.error), "reach",
                              file_json_float(s.info.reach), "bytes", (json_int_t)s.info.bytes,
                              "update_milliseconds", file_json_real(s.update_milliseconds));
    if (s.evaluate_milliseconds > 0) /* only measured when the library shades */
        field =
            file_json_with(field, "evaluate_milliseconds", file_json_real(s.evaluate_milliseconds));
    field = file_json_with(field, "resting_milliseconds", file_json_real(resting));
    *stats = file_json_with(*stats, "field", field);
    return true;
}

bool render_print_stats(render_job *j, base_error *error) {
    const render_options *o = j->options;
    json_t *stats = json_pack(
        "{s:o, s:I, s:I, s:i, s:s, s:s, s:i, s:i}", "scene", file_json_string(j->world.name),
        "triangles", (json_int_t)scene_triangle_count(&j->world), "lights",
        (json_int_t)j->world.light_count, "bands", o->bands, "method", method_table[j->method].name,
        "window", lmp_sh_window_name((lmp_window)o->window), "width", o->size[0], "height",
        o->size[1]);
    stats = with_exposure(stats, j);
    stats = file_json_with(stats, "device", file_json_string(j->device.name));
    stats = file_json_with(stats, "driver", file_json_string(j->device.driver));
    stats = file_json_with(stats, "clock", json_string(render_device_clock(&j->device)));
    stats = file_json_with(stats, "samples", json_integer(timed_samples(o)));
    stats = file_json_with(stats, "repeat", json_integer(o->repeat));
    stats = file_json_with(stats, "shading", json_string(device_table[j->device.kind].name));
    if (j->lobes) {
        const size_t bytes = lmp_preintegrated_lobe_describe(j->lobes).bytes;
        stats = file_json_with(stats, "preintegrated_bytes", json_integer((json_int_t)bytes));
    }
    if (j->device.kind == DEVICE_CPU)
        stats = file_json_with(stats, "estimated_milliseconds", estimates_to_json(j));
    if (!add_timings(j, &stats, error) || (j->field && !add_field(j, &stats, error))) {
        json_decref(stats);
        return false;
    }
    if (j->shadow)
        stats = file_json_with(stats, "shadows", shadows_to_json(j));
    if (j->bounces)
        stats = file_json_with(stats, "bounces", bounces_to_json(j));
    return file_json_print(stats, NULL, error);
}
