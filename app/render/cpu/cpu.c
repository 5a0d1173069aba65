/* SPDX-License-Identifier: MIT */
#include "app/render/cpu/cpu.h"

#include "app/render/cpu/rays.h"
#include "app/render/shade/shade.h"
#include "app/timing/timing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct cpu_scene {
    const scene *scene;
    trace_bvh *bvh;
    cpu_textures *textures;
};

struct cpu_renderer {
    const cpu_scene *world;
    render_materials materials;
    const environment *environment;
    image image;
    /* Of frames whose samples are drawn whole, one after another; of the image's size, or nothing.
     */
    render_surfaces surfaces, first; /* of this sample, and of the first */
    float *rgba, *first_rgba;        /* what they come to, four values a pixel */
    float *sums;                     /* weighted radiances of the samples so far, and weights */
};

/* --- creation --------------------------------------------------------------------------------- */

cpu_scene *cpu_scene_create(const scene *world, cli_error *error) {
    cpu_scene *s = calloc(1, sizeof *s);
    if (s) {
        s->scene = world;
        s->bvh = trace_create(world);
        s->textures = cpu_textures_create(world);
    }
    if (s && s->bvh && s->textures)
        return s;
    cpu_scene_destroy(s);
    cli_fail(error, world->origin, "out of memory");
    return NULL;
}

void cpu_scene_destroy(cpu_scene *s) {
    if (!s)
        return;
    trace_destroy(s->bvh);
    cpu_textures_destroy(s->textures);
    free(s);
}

const trace_bvh *cpu_scene_bvh(const cpu_scene *s) {
    return s->bvh;
}

cpu_renderer *cpu_renderer_create(const cpu_scene *world, cli_error *error) {
    cpu_renderer *r = calloc(1, sizeof *r);
    if (r && render_materials_create(world->scene, &r->materials)) {
        r->world = world;
        return r;
    }
    free(r);
    cli_fail(error, world->scene->origin, "out of memory");
    return NULL;
}

static void free_planes(cpu_renderer *r) {
    render_surfaces_free(&r->surfaces);
    render_surfaces_free(&r->first);
    free(r->rgba);
    free(r->first_rgba);
    free(r->sums);
    r->rgba = r->first_rgba = r->sums = NULL;
}

void cpu_renderer_destroy(cpu_renderer *r) {
    if (!r)
        return;
    free_planes(r);
    image_free(&r->image);
    render_materials_free(&r->materials);
    free(r);
}

render_materials *cpu_renderer_materials(cpu_renderer *r) {
    return &r->materials;
}

void cpu_set_environment(cpu_renderer *r, const environment *around) {
    r->environment = around;
}

const image *cpu_image(const cpu_renderer *r) {
    return &r->image;
}

/* --- samples ---------------------------------------------------------------------------------- */

/* A frame while it is drawn. */
typedef struct drawing {
    cpu_renderer *renderer;
    const render_frame *frame;
    cpu_view view;
    double surfaces, shade; /* seconds of all threads */
} drawing;

static void set_planes(const drawing *d, const render_camera *camera, render_surfaces *s) {
    s->camera = *camera;
    s->frame = d->frame;
    s->materials = &d->renderer->materials;
    s->environment = d->renderer->environment;
}

/* Bright samples weigh less, as the tone curve will make of them: the edge of a lamp then fades
 * over a pixel instead of staying jagged (shaders/resolve.comp does the same). */
static void add_sample(const render_frame *frame, const float *rgba, float sum[4]) {
    const float brightest = fmaxf(rgba[0], fmaxf(rgba[1], rgba[2]));
    const float weight = 1 / (1 + frame->samples_exposure * brightest);
    for (int c = 0; c < 3; c++)
        sum[c] += rgba[c] * weight;
    sum[3] += weight;
}

static void set_mean(const float sum[4], float *rgb) {
    for (int c = 0; c < 3; c++)
        rgb[c] = sum[c] / sum[3];
}

static int least(int a, int b) {
    return a < b ? a : b;
}

/* --- a tile after another, all samples of each ------------------------------------------------ */

/* What a thread draws a tile with. */
typedef struct tile_work {
    render_surfaces surfaces, first;
    render_tile tile;
    float rgba[4 * SHADE_TILE * SHADE_TILE], first_rgba[4 * SHADE_TILE * SHADE_TILE];
    float sums[4 * SHADE_TILE * SHADE_TILE];
    double surfaces_seconds, shade_seconds;
} tile_work;

static tile_work *open_work(const drawing *d) {
    const bool layered = d->renderer->materials.layered;
    tile_work *w = calloc(1, sizeof *w);
    if (!w)
        return NULL;
    const bool ok = render_surfaces_create(SHADE_TILE, SHADE_TILE, layered, &w->surfaces) &&
                    render_surfaces_create(SHADE_TILE, SHADE_TILE, layered, &w->first) &&
                    render_tile_create(SHADE_TILE * SHADE_TILE, &w->tile);
    if (ok)
        return w;
    render_surfaces_free(&w->surfaces);
    render_surfaces_free(&w->first);
    free(w);
    return NULL;
}

static void close_work(tile_work *w) {
    if (!w)
        return;
    render_surfaces_free(&w->surfaces);
    render_surfaces_free(&w->first);
    render_tile_free(&w->tile);
    free(w);
}

static void draw_tile(const drawing *d, const shade_job *job, const render_camera *cameras, int x,
                      int y, tile_work *w) {
    const render_frame *frame = d->frame;
    const int width = least(SHADE_TILE, frame->width - x);
    const int height = least(SHADE_TILE, frame->height - y);
    const int samples = cameras[0].samples;
    render_surfaces *planes[2] = { &w->first, &w->surfaces };
    memset(w->sums, 0, sizeof w->sums);
    for (int i = 0; i < samples; i++) {
        render_surfaces *s = planes[i > 0];
        float *rgba = i > 0 ? w->rgba : w->first_rgba;
        const shade_sample before = { &w->first, w->first_rgba };
        const double start = timing_now();
        s->x = x;
        s->y = y;
        set_planes(d, &cameras[i], s);
        cpu_rays_fill(&d->view, x, y, width, height, s);
        const double found = timing_now();
        shade_tile(job, s, i > 0 ? &before : NULL, x, y, width, height, &w->tile, rgba);
        for (int row = 0; row < height; row++)
            for (int column = 0; column < width; column++) {
                const size_t pixel = 4 * ((size_t)row * SHADE_TILE + (size_t)column);
                add_sample(frame, rgba + pixel, w->sums + pixel);
            }
        w->surfaces_seconds += found - start;
        w->shade_seconds += timing_now() - found;
    }
    for (int row = 0; row < height; row++) {
        float *to =
            d->renderer->image.rgb + 3 * ((size_t)(y + row) * (size_t)frame->width + (size_t)x);
        const size_t first = 4 * (size_t)row * SHADE_TILE;
        for (size_t column = 0; column < (size_t)width; column++) {
            if (samples == 1)
                memcpy(to + 3 * column, w->first_rgba + first + 4 * column, 3 * sizeof *to);
            else
                set_mean(w->sums + first + 4 * column, to + 3 * column);
        }
    }
}

static bool draw_tiles(drawing *d, const shade_job *job, const render_camera *cameras) {
    const render_frame *frame = d->frame;
    const int columns = (frame->width + SHADE_TILE - 1) / SHADE_TILE;
    const int rows = (frame->height + SHADE_TILE - 1) / SHADE_TILE;
    double surfaces = 0, shade = 0;
    bool ok = true;
#pragma omp parallel reduction(&& : ok) reduction(+ : surfaces, shade)
    {
        tile_work *work = open_work(d);
        ok = work != NULL;
#pragma omp for schedule(dynamic)
        for (int i = 0; i < columns * rows; i++)
            if (work)
                draw_tile(d, job, cameras, i % columns * SHADE_TILE, i / columns * SHADE_TILE,
                          work);
        if (work) {
            surfaces += work->surfaces_seconds;
            shade += work->shade_seconds;
        }
        close_work(work);
    }
    d->surfaces += surfaces;
    d->shade += shade;
    return ok;
}

static bool draw_streamed(drawing *d, render_times *times, cli_error *error) {
    const render_frame *frame = d->frame;
    const int samples = frame->samples > 1 ? frame->samples : 1;
    render_camera *cameras = malloc((size_t)samples * sizeof *cameras);
    shade_job *job = cameras ? shade_begin(frame, NULL) : NULL;
    const double start = timing_now();
    bool ok = job || cli_fail(error, NULL, "out of memory");
    for (int i = 0; ok && i < samples; i++)
        ok = render_camera_set(d->view.scene, frame, i, &cameras[i], error);
    ok = ok && (draw_tiles(d, job, cameras) || cli_fail(error, NULL, "out of memory"));
    shade_end(job);
    free(cameras);
    if (ok && times) { /* what threads do side by side, as parts of what it takes together */
        const double all = 1e3 * (timing_now() - start);
        const double part = d->surfaces + d->shade > 0 ? d->surfaces / (d->surfaces + d->shade) : 0;
        times->surfaces += part * all;
        times->shade += (1 - part) * all;
    }
    return ok;
}

/* --- a sample of the whole image after another ------------------------------------------------ */

/* Of the frame's size, in place of those of another. */
static bool size_planes(const drawing *d, bool keep, cli_error *error) {
    cpu_renderer *r = d->renderer;
    const int width = d->frame->width, height = d->frame->height;
    const size_t bytes = 4 * (size_t)width * (size_t)height * sizeof(float);
    const bool layered = r->materials.layered;
    if (r->surfaces.width != width || r->surfaces.height != height)
        free_planes(r);
    const bool ok =
        (r->surfaces.memory || render_surfaces_create(width, height, layered, &r->surfaces)) &&
        (r->rgba || (r->rgba = malloc(bytes))) && (r->sums || (r->sums = malloc(bytes))) &&
        (!keep || r->first.memory || render_surfaces_create(width, height, layered, &r->first)) &&
        (!keep || r->first_rgba || (r->first_rgba = malloc(bytes)));
    if (!ok)
        free_planes(r);
    return ok || cli_fail(error, NULL, "out of memory for an image of %d x %d", width, height);
}

static void find_surfaces(const drawing *d, const render_camera *camera) {
    render_surfaces *s = &d->renderer->surfaces;
    const int columns = (s->width + SHADE_TILE - 1) / SHADE_TILE;
    const int rows = (s->height + SHADE_TILE - 1) / SHADE_TILE;
    set_planes(d, camera, s);
#pragma omp parallel for schedule(dynamic)
    for (int i = 0; i < columns * rows; i++) {
        const int x = i % columns * SHADE_TILE, y = i / columns * SHADE_TILE;
        cpu_rays_fill(&d->view, x, y, least(SHADE_TILE, s->width - x),
                      least(SHADE_TILE, s->height - y), s);
    }
}

/* Adds rgba to the sums; with `show` their mean becomes the image. */
static void resolve(const drawing *d, int index, bool show) {
    cpu_renderer *r = d->renderer;
    const ptrdiff_t count = (ptrdiff_t)d->frame->width * d->frame->height;
    const bool single = d->frame->samples <= 1;
#pragma omp parallel for schedule(static)
    for (ptrdiff_t i = 0; i < count; i++) {
        float *sum = r->sums + 4 * i, *to = r->image.rgb + 3 * i;
        if (single) {
            memcpy(to, r->rgba + 4 * i, 3 * sizeof *to);
            continue;
        }
        if (index == 0)
            memset(sum, 0, 4 * sizeof *sum);
        add_sample(d->frame, r->rgba + 4 * i, sum);
        if (show)
            set_mean(sum, to);
    }
}

static bool draw_sample(drawing *d, int index, bool keep, render_times *times, cli_error *error) {
    cpu_renderer *r = d->renderer;
    const render_frame *frame = d->frame;
    render_camera camera;
    if (!render_camera_set(d->view.scene, frame, index, &camera, error))
        return false;
    const double start = timing_now();
    find_surfaces(d, &camera);
    const double found = timing_now();
    shade_job *job = shade_begin(frame, &r->surfaces);
    const shade_sample before = { &r->first, r->first_rgba };
    const bool ok =
        job && shade_tiles(job, &r->surfaces, keep && index > 0 ? &before : NULL, r->rgba);
    shade_end(job);
    if (!ok)
        return cli_fail(error, NULL, "out of memory");
    if (keep && index == 0) {
        set_planes(d, &camera, &r->first);
        render_surfaces_copy(&r->surfaces, &r->first);
        memcpy(r->first_rgba, r->rgba,
               4 * (size_t)frame->width * (size_t)frame->height * sizeof *r->rgba);
    }
    const double shaded = timing_now();
    if (frame->shadow.run &&
        !frame->shadow.run(frame->shadow.user, frame, &r->surfaces, r->rgba, error))
        return false;
    if (times) {
        times->surfaces += 1e3 * (found - start);
        times->shade += 1e3 * (shaded - found);
        times->shadow += 1e3 * (timing_now() - shaded);
    }
    return true;
}

/* Where something needs all surfaces of a sample at once, or samples come one at a time. */
static bool draw_whole(drawing *d, int first, int last, bool show, render_times *times,
                       cli_error *error) {
    const int samples = d->frame->samples;
    if (!size_planes(d, samples > 1, error))
        return false;
    for (int i = first; i <= last; i++) {
        if (!draw_sample(d, i, samples > 1, times, error))
            return false;
        resolve(d, i, show || i == samples - 1);
    }
    return true;
}

/* --- a frame ---------------------------------------------------------------------------------- */

static bool size_image(cpu_renderer *r, const render_frame *frame, cli_error *error) {
    if (r->image.rgb && r->image.width == frame->width && r->image.height == frame->height)
        return true;
    image_free(&r->image);
    return image_create(&r->image, frame->width, frame->height, error);
}

bool cpu_render(cpu_renderer *r, const render_frame *frame, int first, int last, bool show,
                render_times *times, cli_error *error) {
    const unsigned reads = method_table[frame->method].reads;
    drawing d = { .renderer = r,
                  .frame = frame,
                  .view = { r->world->scene, r->world->bvh, r->world->textures, NULL } };
    trace_spheres *lights;
    if (times)
        *times = (render_times) { .shade = 0 };
    const double start = timing_now();
    render_materials_note_sheen(&r->materials, r->materials.fibers);
    if (!size_image(r, frame, error))
        return false;
    if (!cpu_lights_create(frame, r->world->bvh, &lights))
        return cli_fail(error, NULL, "out of memory");
    d.view.lights = lights;
    const bool all = first == 0 && last >= frame->samples - 1;
    const bool whole = frame->shadow.run || reads & METHOD_READS_FIELD || !all;
    const bool ok =
        whole ? draw_whole(&d, first, last, show, times, error) : draw_streamed(&d, times, error);
    trace_spheres_destroy(lights);
    if (times)
        times->total = 1e3 * (timing_now() - start);
    return ok;
}
