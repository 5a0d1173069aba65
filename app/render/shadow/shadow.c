/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/shadow.h"

#include "app/base/timing.h"
#include "app/render/shadow/ground.h"
#include "app/render/shadow/rays.h"
#include "app/render/shadow/reuse.h"
#include "app/render/shadow/sequence.h"
#include "app/scene/vector.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

struct shadow {
    const scene *scene;
    shadow_settings settings;
    const trace_bvh *bvh;
    shadow_around around;
    bool ground; /* whether the ground receives shadows */
    scene_emitter *areas;
    shadow_source *sources;
    shadow_planes planes;
    shadow_job job; /* of the last sample that sent rays */
    shadow_statistics statistics;
};

static bool fail_memory(const char *subject, base_error *error) {
    return base_fail(error, subject,
                     "out of memory for shadows (--no-shadows renders without them)");
}

shadow *shadow_create(const scene *world, const trace_bvh *bvh, const environment *surroundings,
                      const shadow_settings *settings, base_error *error) {
    shadow *s = calloc(1, sizeof *s);
    if (s) {
        s->scene = world;
        s->settings = *settings;
        s->areas = malloc(SCENE_LIGHTS_MAX * sizeof *s->areas);
        s->sources = malloc(SHADOW_SOURCES(SCENE_LIGHTS_MAX) * sizeof *s->sources);
        s->bvh = bvh;
    }
    if (s && s->areas && s->sources && s->bvh && shadow_surround(s, surroundings, error))
        return s;
    shadow_destroy(s);
    fail_memory(world->name, error);
    return NULL;
}

bool shadow_surround(shadow *s, const environment *surroundings, base_error *error) {
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
    free(s->areas);
    free(s->sources);
    free(s);
}

shadow_statistics shadow_describe(const shadow *s) {
    return s->statistics;
}

/* One in so many samples of a pixel sends rays. */
enum { SAMPLES_APART = 3 };

/* Whether samples that send no rays take their shadows from the last one that did. */
static bool alternates(const shadow *s) {
    return !s->settings.apart && !s->settings.raw;
}

/* Returns the number of a sample among those that send rays, from 0. */
static int number_of(const shadow *s, int sample) {
    return alternates(s) ? sample / SAMPLES_APART : sample;
}

/* Returns the spacing of pixels that send rays. Of samples that stand alone, the first is coarser:
 * it is shown while things move. */
static int spacing_of(const shadow *s, int sample) {
    if (!s->settings.sparse || s->settings.raw)
        return 1;
    return s->settings.apart && sample == 0 ? 4 : 2;
}

static int rays_of(const shadow *s) {
    const int usual = s->settings.apart ? SHADOW_RAYS_APART : SHADOW_RAYS_USUAL;
    if (s->settings.rays > 0)
        return s->settings.rays;
    return shadow_around_shines(&s->around) ? SHADOW_RAYS_AROUND * usual : usual;
}

static shadow_job job_of(shadow *s, const render_frame *frame, int sample) {
    const bool shines = shadow_around_shines(&s->around);
    shadow_job job = {
        .view = { .scene = s->scene,
                  .bvh = s->bvh,
                  .lift = (float)trace_lift(s->scene),
                  .camera = &frame->camera,
                  .pixel = scene_camera_height(&frame->camera, 1) / (float)frame->height,
                  .settings = { .bands = frame->bands, .window = frame->window } },
        .sources = s->sources,
        .rays = rays_of(s),
        .spacing = spacing_of(s, sample),
        .sample = number_of(s, sample),
        .seed = shadow_hash(s->settings.seed, (uint32_t)number_of(s, sample)),
    };
    job.source_count = shadow_sources_make(frame->lights, frame->light_count,
                                           shines ? &s->around : NULL, s->areas, s->sources);
    return job;
}

/* --- a tile after another --------------------------------------------------------------------- */

static bool looks(const void *user, int sample) {
    const shadow *s = user;
    return !alternates(s) || sample % SAMPLES_APART == 0;
}

static bool begin(void *user, const render_frame *frame, int sample, base_error *error) {
    shadow *s = user;
    s->job = job_of(s, frame, sample);
    s->statistics = (shadow_statistics) { .rays_a_pixel = s->job.rays };
    return shadow_planes_resize(&s->planes, frame->width, frame->height,
                                shadow_job_sets(&s->job)) ||
           fail_memory(NULL, error);
}

static void *open_work(void *user) {
    const shadow *s = user;
    return shadow_work_create(&s->job);
}

static void close_work(void *user, void *work) {
    shadow *s = user;
    const shadow_work *done = work;
#pragma omp critical
    if (done) {
        s->statistics.rays += done->sent;
        s->statistics.rays_milliseconds += 1e3 * done->seconds / omp_get_num_threads();
    }
    shadow_work_destroy(work);
}

static void look(void *user, void *with, const render_surfaces *surfaces,
                 const render_rectangle *pixels) {
    shadow *s = user;
    shadow_work *work = with;
    const double start = timing_now();
    render_surfaces_tile(surfaces, pixels->x, pixels->y, pixels->width, pixels->height,
                         &work->tile);
    if (s->ground)
        shadow_ground_lay(s->scene, &surfaces->camera, pixels, &work->tile);
    shadow_rays_tile(&s->job, surfaces, pixels, work, &s->planes);
    work->seconds += timing_now() - start;
}

/* Returns how much to narrow the filter. For samples 1, 2, … of a pixel its radius falls with the
 * fourth root of their number n, so that both blur and variance of their mean fall with the square
 * root of n. It is wider where few pixels send rays. */
static float narrowing_of(const shadow_job *job) {
    return sqrtf((float)(job->sample + 1) / (float)job->spacing);
}

static void mix(void *user) {
    shadow *s = user;
    const double start = timing_now();
    if (!s->settings.raw)
        shadow_filter(&s->planes, s->job.spacing, narrowing_of(&s->job));
    s->statistics.filter_milliseconds = 1e3 * (timing_now() - start);
}

/* Returns the fraction of light that arrives; 1 where there is no light. */
static float ratio_of(const shadow_planes *planes, int channel, size_t pixel) {
    const float all = shadow_planes_sum(planes, SHADOW_ALL + channel, pixel);
    const float unhidden = shadow_planes_sum(planes, SHADOW_UNHIDDEN + channel, pixel);
    return all > 0 && unhidden < all ? unhidden / all : 1;
}

/* Whether a ray of a pixel or of its neighbors was worth sending. */
static bool casts(const shadow_planes *planes, size_t pixel) {
    float sum = 0;
    for (int c = 0; c < 3; c++)
        sum += shadow_planes_sum(planes, SHADOW_ALL + c, pixel);
    return sum > 0;
}

/* Returns what a pixel emits; the ground emits nothing. */
static lmp_rgb emission_of(const render_surfaces *surfaces, size_t pixel) {
    return surfaces->seen[pixel] < RENDER_SEES_LIGHT ? render_surfaces_emission(surfaces, pixel)
                                                     : (lmp_rgb) { 0, 0, 0 };
}

static void change(const void *user, const render_surfaces *surfaces,
                   const render_rectangle *pixels, float *rgba) {
    const shadow *s = user;
    for (int i = 0; i < pixels->width * pixels->height; i++) {
        const int x = pixels->x + i % pixels->width, y = pixels->y + i / pixels->width;
        const size_t pixel = (size_t)y * (size_t)s->planes.width + (size_t)x;
        const size_t at = render_surfaces_at(surfaces, x, y);
        if (!casts(&s->planes, pixel))
            continue;
        const lmp_rgb glow = emission_of(surfaces, at);
        const float emission[3] = { glow.r, glow.g, glow.b };
        for (int c = 0; c < 3; c++) {
            float *radiance = &rgba[4 * at + (size_t)c];
            *radiance = emission[c] + (*radiance - emission[c]) * ratio_of(&s->planes, c, pixel);
        }
    }
}

static void change_later(const void *user, void *with, const render_surfaces *surfaces,
                         const render_rectangle *pixels, float *rgba) {
    const shadow *s = user;
    shadow_work *work = with;
    render_surfaces_outline(surfaces, pixels, &work->tile);
    if (s->ground)
        shadow_ground_lay(s->scene, &surfaces->camera, pixels, &work->tile);
    for (int row = 0; row < pixels->height; row++) {
        const int y = pixels->y + row;
        shadow_reuse_row(&s->planes, &work->tile, (size_t)row * (size_t)pixels->width, pixels->x, y,
                         pixels->width, rgba + 4 * render_surfaces_at(surfaces, pixels->x, y));
    }
}

/* --- a whole image ---------------------------------------------------------------------------- */

typedef enum shadow_step { LOOK, CHANGE, CHANGE_LATER } shadow_step;

static bool run_tiles(shadow *s, shadow_step step, const render_frame *frame,
                      const render_surfaces *surfaces, float *rgba, base_error *error) {
    const int width = s->planes.width, height = s->planes.height;
    const int count = render_tile_count(width, height);
    bool ok = true;
#pragma omp parallel reduction(&& : ok)
    {
        shadow_work *work = open_work(s);
        ok = work != NULL;
#pragma omp for schedule(dynamic)
        for (int i = 0; i < count; i++) {
            const render_rectangle pixels = render_tile_at(width, height, i);
            if (!render_next_tile(frame))
                continue;
            if (work && step == LOOK)
                look(s, work, surfaces, &pixels);
            else if (step == CHANGE)
                change(s, surfaces, &pixels, rgba);
            else if (work)
                change_later(s, work, surfaces, &pixels, rgba);
        }
        close_work(s, work);
    }
    return ok ? render_goes_on(frame, error) : fail_memory(NULL, error);
}

static bool cast(void *user, const render_frame *frame, const render_surfaces *surfaces,
                 float *rgba, base_error *error) {
    shadow *s = user;
    const int sample = surfaces->camera.sample;
    if (!looks(s, sample))
        return run_tiles(s, CHANGE_LATER, frame, surfaces, rgba, error);
    if (!begin(s, frame, sample, error) || !run_tiles(s, LOOK, frame, surfaces, NULL, error))
        return false;
    mix(s);
    return run_tiles(s, CHANGE, frame, surfaces, rgba, error);
}

render_pass shadow_pass(shadow *s) {
    static const render_tiled_pass tiled = {
        .looks = looks,
        .begin = begin,
        .open = open_work,
        .close = close_work,
        .look = look,
        .mix = mix,
        .change = change,
        .change_later = change_later,
    };
    return (render_pass) { .run = cast, .user = s, .tiled = &tiled };
}
