/* SPDX-License-Identifier: MIT */
#include "app/study/volume.h"

#include "app/base/progress.h"
#include "app/scene/bake.h"
#include "app/study/volume_bounces.h"
#include "app/study/volume_visibility.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const lmp_probe_format own = { .name = "lampion", .unit = 1 };

static const lmp_probe_format *format_of(int preset) {
    return preset == VOLUME_OWN ? &own : lmp_probe_engine_format((lmp_probe_engine)(preset - 1));
}

const char *const *volume_presets(void) {
    static const char *names[LMP_PROBE_ENGINE_COUNT + 2];
    for (int i = 0; i <= LMP_PROBE_ENGINE_COUNT; i++)
        names[i] = format_of(i)->name;
    return names;
}

/* --- the grid --------------------------------------------------------------------------------- */

/* Returns the distance between nodes, which stays above 0 where the grid is flat. */
static float step_of(const volume_grid *grid, int axis) {
    float longest = 0;
    for (int a = 0; a < 3; a++)
        longest = fmaxf(longest, grid->maximum[a] - grid->minimum[a]);
    const float extent = fmaxf(grid->maximum[axis] - grid->minimum[axis], 1e-3f * longest);
    return extent / (float)(grid->counts[axis] - 1);
}

static lmp_vec3 node_position(const volume_grid *grid, const int node[3]) {
    float at[3];
    for (int a = 0; a < 3; a++)
        at[a] = grid->minimum[a] + step_of(grid, a) * (float)node[a];
    return (lmp_vec3) { at[0], at[1], at[2] };
}

/* Converts a vector from the scene's world to the preset's. */
static void to_preset(const lmp_probe_format *format, const double ours[3], double theirs[3]) {
    for (int a = 0; a < 3; a++) {
        const int axis = format->convention.axes[a] ? format->convention.axes[a] : a + 1;
        theirs[a] = (double)format->unit * (axis < 0 ? -ours[-axis - 1] : ours[axis - 1]);
    }
}

static void vector_to_preset(const lmp_probe_format *format, lmp_vec3 ours, float theirs[3]) {
    double moved[3];
    to_preset(format, (double[]) { (double)ours.x, (double)ours.y, (double)ours.z }, moved);
    for (int a = 0; a < 3; a++)
        theirs[a] = (float)moved[a];
}

void volume_node(const volume *v, size_t probe, int node[3]) {
    const int *counts = v->settings.grid.counts, i = (int)probe;
    node[0] = i % counts[0];
    node[1] = i / counts[0] % counts[1];
    node[2] = i / counts[0] / counts[1];
}

void volume_position(const volume *v, const int node[3], float position[3]) {
    vector_to_preset(v->format, node_position(&v->settings.grid, node), position);
}

void volume_step(const volume *v, int axis, float step[3]) {
    float along[3] = { 0 };
    along[axis] = step_of(&v->settings.grid, axis);
    vector_to_preset(v->format, (lmp_vec3) { along[0], along[1], along[2] }, step);
}

static size_t node_count(const volume_grid *grid) {
    return (size_t)grid->counts[0] * (size_t)grid->counts[1] * (size_t)grid->counts[2];
}

/* --- the light -------------------------------------------------------------------------------- */

static lmp_light *copy_lights(const scene *world) {
    lmp_light *lights = malloc((world->light_count + 1) * sizeof *lights);
    for (size_t i = 0; lights && i < world->light_count; i++)
        lights[i] = world->lights[i].emitter;
    return lights;
}

/* The data that probes are computed from. */
typedef struct volume_job {
    volume *volume;
    const scene *world;
    const environment *around;
    const lmp_light *lights;
    trace_bvh *bvh;                /* NULL: there are no rays */
    volume_visibility *visibility; /* NULL: nothing blocks light */
    volume_bounces *bounces;       /* NULL: light does not bounce */
} volume_job;

/* Adds three planes of the environment's bands, of which it has at least as many. */
static void add_around(const environment *around, int bands, float scale, float *sh) {
    const size_t count = LMP_SH_COUNT(bands);
    for (size_t i = 0; i < 3 * count; i++)
        sh[i] += scale * around->sh[i / count * LMP_SH_COUNT(around->bands) + i % count];
}

/* Damps ringing (Sloan 2008) in the irradiance: few bands of a small bright light fall below 0
 * behind it. One windowing filter for all channels keeps the color. */
static void dering(int bands, float *sh) {
    const size_t count = LMP_SH_COUNT(bands);
    float cosine[LMP_FIELD_BANDS_MAX], window[LMP_FIELD_BANDS_MAX];
    float irradiance[3 * LMP_FIELD_BANDS_MAX * LMP_FIELD_BANDS_MAX];
    lmp_lobe_make_diffuse(bands, cosine);
    for (size_t c = 0; c < 3; c++)
        lmp_sh_apply_window(bands, cosine, sh + c * count, irradiance + c * count);
    lmp_probe_make_positive_window(bands, irradiance, 3, window);
    for (size_t c = 0; c < 3; c++)
        lmp_sh_apply_window(bands, window, sh + c * count, sh + c * count);
}

/* Computes a probe; `seen` is memory for the lights as the probe sees them. */
static void make_probe(const volume_job *job, size_t probe, lmp_light *seen) {
    const volume *v = job->volume;
    const volume_settings *s = &v->settings;
    const lmp_light *lights = job->lights;
    int node[3];
    volume_node(v, probe, node);
    const lmp_vec3 point = node_position(&s->grid, node);
    float sh[3 * LMP_FIELD_BANDS_MAX * LMP_FIELD_BANDS_MAX], sky = 1;
    if (job->visibility) {
        sky = volume_visible_lights(job->visibility, point, seen);
        lights = seen;
    }
    lmp_light_project(s->bands, lights, job->world->light_count, point, sh);
    if (environment_shines(job->around))
        add_around(job->around, s->bands, sky, sh);
    if (job->bounces)
        volume_bounces_add(job->bounces, point, s->bands, sh);
    if (s->dering)
        dering(s->bands, sh);
    float *values = v->values + probe * v->value_count;
    if (s->preset == VOLUME_OWN)
        memcpy(values, sh, v->value_count * sizeof *values);
    else
        lmp_probe_export(s->bands, v->format, sh, values);
}

/* Computes probes first … end - 1. */
static bool make_some(const volume_job *job, size_t first, size_t end) {
    bool ok = true;
#pragma omp parallel reduction(&& : ok)
    {
        lmp_light *seen = malloc((job->world->light_count + 1) * sizeof *seen);
        ok = seen != NULL;
#pragma omp for schedule(dynamic, 8)
        for (size_t probe = first; probe < end; probe++)
            if (ok)
                make_probe(job, probe, seen);
        free(seen);
    }
    return ok;
}

static bool make_probes(const volume_job *job) {
    enum { SOME = 1024 }; /* between two progress reports */
    const size_t count = job->volume->probe_count;
    bool ok = true;
    for (size_t first = 0; first < count && ok; first += SOME) {
        progress_show("lighting", (double)first / (double)count);
        ok = make_some(job, first, first + SOME < count ? first + SOME : count);
    }
    progress_end();
    return ok;
}

/* Prepares what needs rays. */
static bool prepare(volume_job *job) {
    const volume_settings *s = &job->volume->settings;
    const bool shadows = s->rays > 0, bounces = s->bounces > 0;
    if (shadows || bounces)
        job->bvh = trace_create(job->world);
    if (job->bvh && shadows)
        job->visibility = volume_visibility_create(job->world, job->bvh, job->around, s->rays);
    if (job->bvh && bounces)
        job->bounces =
            volume_bounces_create(job->world, job->bvh, job->around, shadows, s->bounces);
    return (!shadows || job->visibility) && (!bounces || job->bounces);
}

static void clean_up(volume_job *job) {
    volume_bounces_destroy(job->bounces);
    volume_visibility_destroy(job->visibility);
    trace_destroy(job->bvh);
}

bool volume_make(const scene *world, const environment *around, const volume_settings *settings,
                 volume *v, base_error *error) {
    *v = (volume) { .settings = *settings,
                    .format = format_of(settings->preset),
                    .probe_count = node_count(&settings->grid),
                    .value_count = 3 * LMP_SH_COUNT(settings->bands) };
    to_preset(v->format, world->origin, v->origin);
    v->values = malloc(v->probe_count * v->value_count * sizeof *v->values);
    lmp_light *lights = copy_lights(world);
    volume_job job = { .volume = v, .world = world, .around = around, .lights = lights };
    const bool ok = v->values && lights && prepare(&job) && make_probes(&job);
    clean_up(&job);
    free(lights);
    if (ok)
        return true;
    volume_free(v);
    return base_fail(error, NULL, "out of memory for %zu probes", node_count(&settings->grid));
}

void volume_free(volume *v) {
    free(v->values);
    v->values = NULL;
}

void volume_name_value(const volume *v, size_t i, volume_name name) {
    const size_t count = v->value_count / 3;
    const size_t channel = v->format->interleaved ? i % 3 : i / count;
    snprintf(name, sizeof(volume_name), "%c%zu", "rgb"[channel],
             v -> format -> interleaved ? i / 3 : i % count);
}

/* --- as a field of the library ---------------------------------------------------------------- */

bool volume_make_field(const scene *world, const volume_settings *settings, lmp_field **field,
                       base_error *error) {
    const volume_grid *grid = &settings->grid;
    const int *counts = grid->counts;
    const lmp_field_desc desc = {
        .bands = settings->bands,
        .nodes = { counts[0], counts[1], counts[2] },
        .origin = { grid->minimum[0], grid->minimum[1], grid->minimum[2] },
        .cell = { step_of(grid, 0), step_of(grid, 1), step_of(grid, 2) },
        .light_max = world->light_count > 0 ? (size_t)world->light_count : 1,
    };
    const char *what = "lighting";
    const lmp_host host = bake_host(&what);
    lmp_light *lights = copy_lights(world);
    *field = NULL;
    lmp_result result = lights ? lmp_field_create(NULL, &desc, field) : LMP_ERROR_MEMORY;
    if (result == LMP_OK)
        result = lmp_field_update(&host, *field, lights, world->light_count);
    progress_end();
    free(lights);
    return result == LMP_OK ||
           base_fail(error, NULL, "no field of this grid: %s", lmp_result_text(result));
}
