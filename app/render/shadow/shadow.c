/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/shadow.h"

#include "app/render/shadow/ground.h"
#include "app/render/shadow/rays.h"
#include "app/render/shadow/reuse.h"
#include "app/render/shadow/sequence.h"
#include "app/scene/vector.h"
#include "app/timing/timing.h"

#include <stdlib.h>
#include <string.h>

struct shadow {
    const scene *scene;
    shadow_settings settings;
    const trace_bvh *bvh;
    shadow_around around;
    bool ground; /* receives shadows as well */
    shadow_source *sources;
    shadow_planes planes;
    shadow_statistics statistics;
};

static bool fail_memory(const char *subject, cli_error *error) {
    return cli_fail(error, subject,
                    "out of memory for shadows (--no-shadows renders without them)");
}

shadow *shadow_create(const scene *world, const trace_bvh *bvh, const environment *surroundings,
                      const shadow_settings *settings, cli_error *error) {
    shadow *s = calloc(1, sizeof *s);
    if (s) {
        s->scene = world;
        s->settings = *settings;
        s->sources = malloc(SHADOW_SOURCES(SCENE_LIGHTS_MAX) * sizeof *s->sources);
        s->bvh = bvh;
    }
    if (s && s->sources && s->bvh && shadow_surround(s, surroundings, error))
        return s;
    shadow_destroy(s);
    fail_memory(world->name, error);
    return NULL;
}

bool shadow_surround(shadow *s, const environment *surroundings, cli_error *error) {
    shadow_around_free(&s->around);
    memset(&s->around, 0, sizeof s->around);
    s->ground = surroundings && surroundings->ground;
    return shadow_around_create(surroundings, &s->around) || fail_memory(s->scene->name, error);
}

void shadow_destroy(shadow *s) {
    if (!s)
        return;
    shadow_around_free(&s->around);
    shadow_planes_free(&s->planes);
    free(s->sources);
    free(s);
}

shadow_statistics shadow_describe(const shadow *s) {
    return s->statistics;
}

/* One of so many samples of a pixel sends rays. */
enum { SAMPLES_APART = 3 };

/* Whether the samples between take their shadows from the one before that sent rays. */
static bool alternates(const shadow *s) {
    return !s->settings.apart && !s->settings.raw;
}

/* Which of the samples that send rays it is, from 0. */
static int sample_of(const shadow *s, const render_surfaces *surfaces) {
    const int sample = surfaces->camera.sample;
    return alternates(s) ? sample / SAMPLES_APART : sample;
}

/* Of samples that stand alone the first is shown while things move. */
static int spacing_of(const shadow *s, const render_surfaces *surfaces) {
    if (!s->settings.sparse || s->settings.raw)
        return 1;
    return s->settings.apart && surfaces->camera.sample == 0 ? 4 : 2;
}

static int rays_of(const shadow *s) {
    const int usual = s->settings.apart ? SHADOW_RAYS_APART : SHADOW_RAYS_USUAL;
    if (s->settings.rays > 0)
        return s->settings.rays;
    return shadow_around_shines(&s->around) ? SHADOW_RAYS_AROUND * usual : usual;
}

static shadow_job job_of(shadow *s, const render_frame *frame, const render_surfaces *surfaces) {
    const bool shines = shadow_around_shines(&s->around);
    shadow_job job = {
        .view = { .scene = s->scene,
                  .bvh = s->bvh,
                  .lift = (float)trace_lift(s->scene),
                  .camera = &frame->camera,
                  .pixel = scene_camera_height(&frame->camera, 1) / (float)frame->height,
                  .settings = { .bands = frame->bands, .window = frame->window } },
        .hits = surfaces->hits,
        .sources = s->sources,
        .rays = rays_of(s),
        .spacing = spacing_of(s, surfaces),
        .sample = sample_of(s, surfaces),
        .seed = shadow_hash(s->settings.seed, (uint32_t)sample_of(s, surfaces)),
    };
    job.source_count = shadow_sources_make(frame->lights, frame->light_count,
                                           shines ? &s->around : NULL, s->sources);
    return job;
}

/* Pixels with the ground beneath. */
static void fill_tile(const shadow *s, const render_surfaces *surfaces,
                      const render_rectangle *pixels, render_tile *tile) {
    render_surfaces_tile(surfaces, pixels->x, pixels->y, pixels->width, pixels->height, tile);
    if (s->ground)
        shadow_ground_lay(s->scene, &surfaces->camera, pixels, tile);
}

static bool send_rays(shadow *s, const shadow_job *job, const render_surfaces *surfaces) {
    const int width = s->planes.width, height = s->planes.height;
    const int count = render_tile_count(width, height);
    size_t rays = 0;
    bool ok = true;
#pragma omp parallel reduction(&& : ok) reduction(+ : rays)
    {
        shadow_work *work = shadow_work_create(job);
        ok = work != NULL;
#pragma omp for schedule(dynamic)
        for (int i = 0; i < count; i++)
            if (work) {
                const render_rectangle pixels = render_tile_at(width, height, i);
                fill_tile(s, surfaces, &pixels, &work->tile);
                rays += shadow_rays_tile(job, &pixels, work, &s->planes);
            }
        shadow_work_destroy(work);
    }
    s->statistics.rays_a_pixel = job->rays;
    s->statistics.rays = rays;
    return ok;
}

/* Where no light would arrive, nothing is hidden. */
static float ratio_of(const shadow_planes *planes, int channel, size_t pixel) {
    const float all = planes->values[SHADOW_ALL + channel][pixel];
    const float unhidden = planes->values[SHADOW_UNHIDDEN + channel][pixel];
    return all > 0 && unhidden < all ? unhidden / all : 1;
}

/* The ground emits nothing. */
static lmp_rgb emission_of(const render_surfaces *surfaces, size_t pixel) {
    return surfaces->seen[pixel] < RENDER_SEES_LIGHT ? render_surfaces_emission(surfaces, pixel)
                                                     : (lmp_rgb) { 0, 0, 0 };
}

static void apply(const shadow *s, const render_surfaces *surfaces, float *rgba) {
    const ptrdiff_t count = (ptrdiff_t)s->planes.width * s->planes.height;
#pragma omp parallel for
    for (ptrdiff_t i = 0; i < count; i++) {
        const size_t pixel = (size_t)i;
        if (!(s->planes.values[SHADOW_ALL][pixel] + s->planes.values[SHADOW_ALL + 1][pixel] +
                  s->planes.values[SHADOW_ALL + 2][pixel] >
              0))
            continue;
        const lmp_rgb glow = emission_of(surfaces, pixel);
        const float emission[3] = { glow.r, glow.g, glow.b };
        for (int c = 0; c < 3; c++) {
            float *radiance = &rgba[4 * pixel + (size_t)c];
            *radiance = emission[c] + (*radiance - emission[c]) * ratio_of(&s->planes, c, pixel);
        }
    }
}

/* Less for samples 1, 2, … of a pixel: of a mean of n, blur that falls as the fourth root falls as
 * the root of n, and so does variance. More where few pixels send rays. */
static float narrowing_of(const shadow_job *job) {
    return sqrtf((float)(job->sample + 1) / (float)job->spacing);
}

static bool cast(shadow *s, const render_frame *frame, const render_surfaces *surfaces,
                 float *rgba) {
    const double start = timing_now();
    const shadow_job job = job_of(s, frame, surfaces);
    if (!shadow_planes_resize(&s->planes, frame->width, frame->height) ||
        !send_rays(s, &job, surfaces))
        return false;
    const double sent = timing_now();
    if (!s->settings.raw)
        shadow_filter(&s->planes, job.spacing, narrowing_of(&job));
    apply(s, surfaces, rgba);
    s->statistics.rays_milliseconds = 1e3 * (sent - start);
    s->statistics.filter_milliseconds = 1e3 * (timing_now() - sent);
    return true;
}

static bool reuse(const shadow *s, const render_surfaces *surfaces, float *rgba) {
    bool ok = true;
#pragma omp parallel reduction(&& : ok)
    {
        render_tile row;
        const bool mine = ok = render_tile_create(s->planes.width, &row);
#pragma omp for schedule(dynamic, 4)
        for (int y = 0; y < s->planes.height; y++)
            if (mine) {
                const render_rectangle pixels = { 0, y, s->planes.width, 1 };
                fill_tile(s, surfaces, &pixels, &row);
                shadow_reuse_row(&s->planes, &row, y, rgba);
            }
        if (mine)
            render_tile_free(&row);
    }
    return ok;
}

bool shadow_frame(void *user, const render_frame *frame, const render_surfaces *surfaces,
                  float *rgba, cli_error *error) {
    shadow *s = user;
    const bool again = alternates(s) && surfaces->camera.sample % SAMPLES_APART != 0;
    return (again ? reuse(s, surfaces, rgba) : cast(s, frame, surfaces, rgba)) ||
           fail_memory(NULL, error);
}
