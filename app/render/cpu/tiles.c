/* SPDX-License-Identifier: MIT */
#include "app/render/cpu/tiles.h"

#include "app/base/memory.h"
#include "app/base/timing.h"
#include "app/render/cpu/shared.h"
#include "app/render/shade.h"

#include <stdlib.h>
#include <string.h>

enum { SURFACES, BOUNCES, SHADE, SHADOW, STEPS }; /* steps whose time is measured */
enum { HELD = 5 }; /* planes that are kept: what is seen, emission, weights */

/* The job of one frame. */
typedef struct tiles_job {
    const cpu_drawing *drawing;
    bool by_field;    /* whether the only sample reads a field */
    lmp_field *nodes; /* the field's, while they are requested */
    shade_job *shade;
    const render_camera *cameras;  /* of the samples */
    const render_tiled_pass *pass; /* or NULL */
    cpu_tiles *kept;
} tiles_job;

/* The buffers with which a thread draws tiles. */
typedef struct tile_work {
    render_surfaces surfaces, first;
    render_tile tile;
    void *pass; /* the work that the pass opened for this thread */
    float rgba[4 * RENDER_TILE_PIXELS], first_rgba[4 * RENDER_TILE_PIXELS];
    float weighed[4 * RENDER_TILE_PIXELS], sums[4 * RENDER_TILE_PIXELS]; /* the first; all */
    uint16_t repeats[RENDER_TILE_PIXELS]; /* later samples of a pixel that are as the first */
    double now, seconds[STEPS];
} tile_work;

/* A tile, and the buffers of its samples: the thread's, or those kept for all tiles. */
typedef struct tile_place {
    render_rectangle pixels;
    render_surfaces first, held;
    float *first_rgba, *rgba, *sums;
    trace_hit *hits; /* that were found beforehand, or NULL */
} tile_place;

static void close_work(const tiles_job *job, tile_work *w) {
    if (!w)
        return;
    if (job->pass)
        job->pass->close(job->drawing->frame->shadow.user, w->pass);
    render_surfaces_free(&w->surfaces);
    render_surfaces_free(&w->first);
    render_tile_free(&w->tile);
    free(w);
}

static tile_work *open_work(const tiles_job *job) {
    const render_materials *const materials = job->drawing->materials;
    tile_work *w = calloc(1, sizeof *w);
    if (w && render_surfaces_create(RENDER_TILE, RENDER_TILE, materials, &w->surfaces) &&
        render_surfaces_share(&w->surfaces) &&
        (!job->pass || render_surfaces_keep_hits(&w->surfaces)) &&
        render_surfaces_create(RENDER_TILE, RENDER_TILE, materials, &w->first) &&
        render_surfaces_keep_smooth(&w->first) &&
        render_surfaces_fit_bounced(job->drawing->frame, &w->surfaces) &&
        render_surfaces_fit_bounced(job->drawing->frame, &w->first) &&
        render_tile_create(RENDER_TILE_PIXELS, &w->tile) &&
        (!job->pass || (w->pass = job->pass->open(job->drawing->frame->shadow.user))))
        return w;
    close_work(job, w);
    return NULL;
}

static void note_time(tile_work *w, int step) {
    const double now = timing_now();
    w->seconds[step] += now - w->now;
    w->now = now;
}

/* Returns the index of a pixel in a tile's planes. */
static size_t tile_index(int row, int column) {
    return (size_t)row * RENDER_TILE + (size_t)column;
}

/* Finds and shades a sample: the first one into its own planes, a later one into the thread's. */
static const render_surfaces *draw_sample(const tiles_job *job, int sample, tile_place *at,
                                          tile_work *w) {
    const cpu_drawing *d = job->drawing;
    const bool later = sample > 0;
    const shade_sample before = { &at->first, at->first_rgba };
    render_surfaces *s = later ? &w->surfaces : &at->first;
    float *rgba = later ? w->rgba : at->first_rgba;
    s->x = at->pixels.x;
    s->y = at->pixels.y;
    s->hits = at->hits ? at->hits : w->surfaces.hits;
    s->first = later ? &at->first : NULL;
    cpu_set_planes(d, &job->cameras[sample], s);
    if (at->hits)
        cpu_rays_fill_found(&d->view, &at->pixels, s);
    else
        cpu_rays_fill(&d->view, &at->pixels, later ? &at->first : NULL, s);
    note_time(w, SURFACES);
    const render_bounces *bounces = &d->frame->bounces;
    if (bounces->fill)
        bounces->fill(bounces->user, s, &at->pixels, &w->tile);
    note_time(w, BOUNCES);
    shade_tile(job->shade, s, later ? &before : NULL, &at->pixels, &w->tile, rgba);
    if (!later && d->samples > 1)
        cpu_shared_mark(s, rgba, &at->pixels);
    return s;
}

static void add_samples(float exposure, const render_surfaces *s, const render_rectangle *pixels,
                        const float *rgba, float *sums) {
    for (int row = 0; row < pixels->height; row++)
        for (int column = 0; column < pixels->width; column++) {
            const size_t at = tile_index(row, column);
            cpu_add_sample(exposure, rgba + 4 * at, cpu_blended(s, at), sums + 4 * at);
        }
}

static void set_image(const cpu_drawing *d, const render_rectangle *pixels, const float *rgba,
                      const float *sums) {
    for (int row = 0; row < pixels->height; row++) {
        const size_t first =
            (size_t)(pixels->y + row) * (size_t)d->frame->width + (size_t)pixels->x;
        for (int column = 0; column < pixels->width; column++) {
            const size_t at = 4 * tile_index(row, column);
            cpu_set_pixel(d->samples, rgba + at, sums + at,
                          d->image->rgb + 3 * (first + (size_t)column));
        }
    }
}

/* --- all samples of a tile at once ------------------------------------------------------------ */

static void weigh_first(float exposure, tile_work *w) {
    for (size_t at = 0; at < RENDER_TILE_PIXELS; at++)
        cpu_weigh_sample(exposure, w->first_rgba + 4 * at, cpu_blended(&w->first, at),
                         w->weighed + 4 * at);
    memcpy(w->sums, w->weighed, sizeof w->sums);
    memset(w->repeats, 0, sizeof w->repeats);
}

/* Adds a later sample to the sums. Pixels that are the same as in the first sample are counted, not
 * added, unless the samples' weights differ: with blended surfaces. */
static void add_later(float exposure, const render_rectangle *pixels, tile_work *w) {
    const render_surfaces *s = &w->surfaces;
    if (s->weight) {
        add_samples(exposure, s, pixels, w->rgba, w->sums);
        return;
    }
    for (size_t at = 0; at < RENDER_TILE_PIXELS; at++)
        w->repeats[at] = (uint16_t)(w->repeats[at] + s->same[at]);
    for (int row = 0; row < pixels->height; row++) {
        size_t list[RENDER_TILE];
        const size_t others = render_surfaces_others(s, tile_index(row, 0), pixels->width, list);
        for (size_t i = 0; i < others; i++)
            cpu_add_sample(exposure, w->rgba + 4 * list[i], 0, w->sums + 4 * list[i]);
    }
}

static void add_repeats(tile_work *w) {
    for (size_t at = 0; at < RENDER_TILE_PIXELS; at++)
        for (size_t i = 4 * at; i < 4 * at + 4; i++)
            w->sums[i] += (float)w->repeats[at] * w->weighed[i];
}

static trace_hit *hits_of(const cpu_tiles *kept, int number) {
    return kept->hits + (size_t)number * RENDER_TILE_PIXELS;
}

static void draw_alone(const tiles_job *job, int number, tile_work *w) {
    const cpu_drawing *d = job->drawing;
    tile_place at = { .pixels = render_tile_at(d->frame->width, d->frame->height, number),
                      .first = w->first,
                      .first_rgba = w->first_rgba,
                      .hits = job->by_field ? hits_of(job->kept, number) : NULL };
    for (int i = 0; i < d->samples; i++) {
        draw_sample(job, i, &at, w);
        if (i > 0)
            add_later(d->exposure, &at.pixels, w);
        else if (d->samples > 1)
            weigh_first(d->exposure, w);
        note_time(w, SHADE);
    }
    if (d->samples > 1)
        add_repeats(w);
    set_image(d, &at.pixels, w->first_rgba, w->sums);
    note_time(w, SHADE);
}

/* --- the surfaces of a field's only sample ---------------------------------------------------- */

static bool size_hits(const render_frame *frame, cpu_tiles *t) {
    const int count = render_tile_count(frame->width, frame->height);
    if (t->hits && t->hit_count == count)
        return true;
    free(t->hits);
    t->hits = memory_large((size_t)count * RENDER_TILE_PIXELS * sizeof *t->hits);
    t->hit_count = count;
    return t->hits != NULL;
}

/* Finds what a tile sees, and requests the field's nodes there. */
static void want_tile(const tiles_job *job, int number, tile_work *w) {
    const cpu_drawing *d = job->drawing;
    const render_rectangle pixels = render_tile_at(d->frame->width, d->frame->height, number);
    render_surfaces *s = &w->first;
    s->x = pixels.x;
    s->y = pixels.y;
    s->hits = hits_of(job->kept, number);
    cpu_set_planes(d, &job->cameras[0], s);
    const size_t count = cpu_rays_find(&d->view, &pixels, s, &w->tile);
    s->hits = NULL;
    note_time(w, SURFACES);
    lmp_field_want_n(job->nodes, render_vectors(w->tile.position), count);
    note_time(w, SHADE);
}

/* --- a sample that is looked at, and those after it ------------------------------------------- */

static bool size_kept(const cpu_drawing *d, cpu_tiles *t) {
    const int count = render_tile_count(d->frame->width, d->frame->height);
    const size_t pixels = (size_t)count * RENDER_TILE_PIXELS;
    const size_t planes =
        d->samples > 1 ? render_surfaces_values(RENDER_TILE, RENDER_TILE, d->materials) : 0;
    const bool bounces = planes > 0 && d->frame->bounces.fill;
    if (t->count == count && t->planes == planes && !t->bounced == !bounces)
        return true;
    cpu_tiles_free(t);
    t->first_rgba = memory_large(4 * pixels * sizeof *t->first_rgba);
    t->held = memory_large(HELD * pixels * sizeof *t->held);
    if (planes > 0) {
        t->first = memory_large((size_t)count * planes * sizeof *t->first);
        t->smooth = memory_large(pixels * sizeof *t->smooth);
        t->rgba = memory_large(4 * pixels * sizeof *t->rgba);
        t->sums = memory_large(4 * pixels * sizeof *t->sums);
    }
    if (bounces)
        t->bounced = memory_large(RENDER_BOUNCED_PLANES * pixels * sizeof *t->bounced);
    if (!t->first_rgba || !t->held || (bounces && !t->bounced) ||
        (planes > 0 && (!t->first || !t->smooth || !t->rgba || !t->sums)))
        return false;
    t->count = count;
    t->planes = planes;
    return true;
}

void cpu_tiles_free(cpu_tiles *t) {
    free(t->first);
    free(t->smooth);
    free(t->bounced);
    free(t->first_rgba);
    free(t->held);
    free(t->rgba);
    free(t->sums);
    free(t->hits);
    memset(t, 0, sizeof *t);
}

static tile_place place_of(const tiles_job *job, int number, const tile_work *w) {
    const render_frame *frame = job->drawing->frame;
    const cpu_tiles *t = job->kept;
    const size_t before = (size_t)number * RENDER_TILE_PIXELS;
    float *held = t->held + HELD * before;
    tile_place at = { .pixels = render_tile_at(frame->width, frame->height, number),
                      .first = w->first,
                      .first_rgba = t->first_rgba + 4 * before };
    at.held = (render_surfaces) { .x = at.pixels.x,
                                  .y = at.pixels.y,
                                  .width = RENDER_TILE,
                                  .height = RENDER_TILE,
                                  .seen = (uint32_t *)(void *)held };
    for (int c = 0; c < 3; c++)
        at.held.emission[c] = held + (1 + c) * RENDER_TILE_PIXELS;
    if (job->drawing->materials->blends)
        at.held.weight = held + 4 * RENDER_TILE_PIXELS;
    if (t->planes == 0)
        return at;
    render_surfaces_lay(t->first + (size_t)number * t->planes, RENDER_TILE, RENDER_TILE,
                        job->drawing->materials, &at.first);
    cpu_set_planes(job->drawing, &job->cameras[0], &at.first);
    at.first.smooth = t->smooth + before;
    if (t->bounced)
        render_surfaces_lay_bounced(t->bounced + RENDER_BOUNCED_PLANES * before, &at.first);
    at.rgba = t->rgba + 4 * before;
    at.sums = t->sums + 4 * before;
    return at;
}

static void hold(const render_surfaces *s, const render_rectangle *pixels, render_surfaces *held) {
    for (int row = 0; row < pixels->height; row++)
        for (int column = 0; column < pixels->width; column++) {
            const size_t i = tile_index(row, column);
            const render_surfaces *from = render_surfaces_owner(s, i);
            held->seen[i] = s->seen[i];
            if (held->weight)
                held->weight[i] = s->weight[i];
            render_set_color(held->emission, i, render_surfaces_emission(from, i));
        }
}

static void look_at(const tiles_job *job, int sample, int number, tile_work *w) {
    tile_place at = place_of(job, number, w);
    const render_surfaces *s = draw_sample(job, sample, &at, w);
    if (sample > 0)
        memcpy(at.rgba, w->rgba, sizeof w->rgba);
    note_time(w, SHADE);
    hold(s, &at.pixels, &at.held);
    job->pass->look(job->drawing->frame->shadow.user, w->pass, s, &at.pixels);
    note_time(w, SHADOW);
}

/* Lets the pass change the samples from the one it looked at to the one before `end`. */
static void change(const tiles_job *job, int sample, int end, int number, tile_work *w) {
    const cpu_drawing *d = job->drawing;
    const void *user = d->frame->shadow.user;
    tile_place at = place_of(job, number, w);
    memcpy(w->rgba, sample > 0 ? at.rgba : at.first_rgba, sizeof w->rgba);
    job->pass->change(user, &at.held, &at.pixels, w->rgba);
    note_time(w, SHADOW);
    if (at.sums && sample == 0)
        memset(at.sums, 0, sizeof w->sums);
    const render_surfaces *s = &at.held;
    for (int i = sample;;) {
        if (at.sums)
            add_samples(d->exposure, s, &at.pixels, w->rgba, at.sums);
        if (++i == end)
            break;
        s = draw_sample(job, i, &at, w);
        note_time(w, SHADE);
        job->pass->change_later(user, w->pass, s, &at.pixels, w->rgba);
        note_time(w, SHADOW);
    }
    if (end == d->samples)
        set_image(d, &at.pixels, w->rgba, at.sums);
    note_time(w, SHADE);
}

/* --- all tiles -------------------------------------------------------------------------------- */

/* What to do with each tile: find its surfaces for a field; draw all samples, the one that the pass
 * looks at, or those it changes. */
typedef enum tiles_step { WANT, ALL, LOOK, CHANGE } tiles_step;

static bool run(const tiles_job *job, tiles_step step, int sample, int end, render_times *times,
                base_error *error) {
    const int count = render_tile_count(job->drawing->frame->width, job->drawing->frame->height);
    const double start = timing_now();
    double surfaces = 0, bounces = 0, shade = 0, shadow = 0;
    bool ok = true;
#pragma omp parallel reduction(&& : ok) reduction(+ : surfaces, bounces, shade, shadow)
    {
        tile_work *work = open_work(job);
        ok = work != NULL;
#pragma omp for schedule(dynamic)
        for (int i = 0; i < count; i++) {
            if (!work || !render_next_tile(job->drawing->frame))
                continue;
            work->now = timing_now();
            if (step == WANT)
                want_tile(job, i, work);
            else if (step == ALL)
                draw_alone(job, i, work);
            else if (step == LOOK)
                look_at(job, sample, i, work);
            else
                change(job, sample, end, i, work);
        }
        if (work) {
            surfaces += work->seconds[SURFACES];
            bounces += work->seconds[BOUNCES];
            shade += work->seconds[SHADE];
            shadow += work->seconds[SHADOW];
        }
        close_work(job, work);
    }
    const double sum = surfaces + bounces + shade + shadow;
    if (ok && times && sum > 0) { /* scales the threads' sums to the time that passed */
        const double scale = 1e3 * (timing_now() - start) / sum;
        times->surfaces += scale * surfaces;
        times->bounces += scale * bounces;
        times->shade += scale * shade;
        times->shadow += scale * shadow;
    }
    if (!ok)
        return base_fail(error, NULL, "out of memory");
    return render_goes_on(job->drawing->frame, error);
}

/* Returns how often each tile is worked on. */
static int count_steps(const tiles_job *job) {
    int steps = 0;
    for (int i = 0; i < job->drawing->samples && job->pass; i++)
        steps += job->pass->looks(job->drawing->frame->shadow.user, i) ? 2 : 0;
    return job->pass ? steps : job->by_field ? 2 : 1;
}

/* Draws the samples that the pass looks at, each followed by the samples up to the next one. */
static bool run_pass(const tiles_job *job, render_times *times, base_error *error) {
    const cpu_drawing *d = job->drawing;
    void *user = d->frame->shadow.user;
    for (int i = 0, end; i < d->samples; i = end) {
        for (end = i + 1; end < d->samples && !job->pass->looks(user, end);)
            end++;
        if (!job->pass->begin(user, d->frame, i, error))
            return false;
        if (!run(job, LOOK, i, i + 1, times, error))
            return false;
        const double start = timing_now();
        job->pass->mix(user);
        if (times)
            times->shadow += 1e3 * (timing_now() - start);
        if (!run(job, CHANGE, i, end, times, error))
            return false;
    }
    return true;
}

/* A job whose field's nodes are to be requested, tile by tile. */
typedef struct tiles_want {
    tiles_job *job;
    render_times *times;
    base_error *error;
    bool failed; /* and the error is set */
    double seconds;
} tiles_want;

/* A shade_want. */
static bool want_tiles(lmp_field *nodes, void *user) {
    tiles_want *w = user;
    const double start = timing_now();
    w->job->nodes = nodes;
    w->failed = !run(w->job, WANT, 0, 1, w->times, w->error);
    w->seconds = timing_now() - start;
    return !w->failed;
}

/* Begins shading; what that takes, except for finding surfaces, counts as shading. */
static bool begin_shade(tiles_job *job, render_times *times, base_error *error) {
    tiles_want wanted = { .job = job, .times = times, .error = error };
    const double start = timing_now();
    job->shade = shade_begin(job->drawing->frame, want_tiles, &wanted);
    if (times)
        times->shade += 1e3 * (timing_now() - start - wanted.seconds);
    return job->shade || (!wanted.failed && base_fail(error, NULL, "out of memory"));
}

static bool draw_all(const tiles_job *job, render_times *times, base_error *error) {
    const double before = times ? times->shade : 0;
    if (!run(job, ALL, 0, job->drawing->samples, times, error))
        return false;
    if (times)
        shade_note(job->shade, times->shade - before);
    return true;
}

bool cpu_tiles_draw(cpu_tiles *kept, const cpu_drawing *d, render_times *times, base_error *error) {
    const render_frame *frame = d->frame;
    render_camera *cameras = malloc((size_t)d->samples * sizeof *cameras);
    tiles_job job = { .drawing = d,
                      .by_field = method_table[frame->method].reads & METHOD_READS_FIELD,
                      .cameras = cameras,
                      .pass = frame->shadow.tiled,
                      .kept = kept };
    bool ok = (cameras && (!job.by_field || size_hits(frame, kept)) &&
               (!job.pass || size_kept(d, kept))) ||
              base_fail(error, NULL, "out of memory for an image of %d x %d", frame->width,
                        frame->height);
    for (int i = 0; ok && i < d->samples; i++)
        ok = render_camera_set(d->view.scene, frame, i, &cameras[i], error);
    render_progress_reset(frame->progress,
                          count_steps(&job) * render_tile_count(frame->width, frame->height));
    ok = ok && begin_shade(&job, times, error) &&
         (job.pass ? run_pass(&job, times, error) : draw_all(&job, times, error));
    shade_end(job.shade);
    free(cameras);
    return ok;
}
