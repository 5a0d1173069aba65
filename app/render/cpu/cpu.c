/* SPDX-License-Identifier: MIT */
#include "app/render/cpu/cpu.h"

#include "app/memory/memory.h"
#include "app/render/cpu/rays.h"
#include "app/render/cpu/shared.h"
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
    const render_surfaces *kept;     /* those that `view` sees, also behind lights; NULL: none */
    render_camera view;
    float *sums; /* weighted radiances of the samples so far, and weights */
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
    cli_fail(error, world->name, "out of memory");
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
    cli_fail(error, world->scene->name, "out of memory");
    return NULL;
}

static void free_planes(cpu_renderer *r) {
    render_surfaces_free(&r->surfaces);
    render_surfaces_free(&r->first);
    free(r->rgba);
    free(r->first_rgba);
    free(r->sums);
    r->rgba = r->first_rgba = r->sums = NULL;
    r->kept = NULL;
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
    r->kept = NULL; /* whoever asks may change them */
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
    int samples;            /* of which the image is the mean, when all are there */
    float exposure;         /* that the mean suits */
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
static void add_sample(float exposure, const float *rgba, float sum[4]) {
    const float brightest = fmaxf(rgba[0], fmaxf(rgba[1], rgba[2]));
    const float weight = 1 / (1 + exposure * brightest);
    for (int c = 0; c < 3; c++)
        sum[c] += rgba[c] * weight;
    sum[3] += weight;
}

/* What the image shows of a pixel: its only sample, or the mean of all. */
static void set_pixel(int samples, const float *rgba, const float sum[4], float *rgb) {
    for (int c = 0; c < 3; c++)
        rgb[c] = samples > 1 ? sum[c] / sum[3] : rgba[c];
}

/* --- a tile after another, all samples of each ------------------------------------------------ */

/* What a thread draws a tile with. */
typedef struct tile_work {
    render_surfaces surfaces, first;
    render_tile tile;
    float rgba[4 * RENDER_TILE_PIXELS], first_rgba[4 * RENDER_TILE_PIXELS];
    float sums[4 * RENDER_TILE_PIXELS];
    double surfaces_seconds, shade_seconds;
} tile_work;

static void close_work(tile_work *w) {
    if (!w)
        return;
    render_surfaces_free(&w->surfaces);
    render_surfaces_free(&w->first);
    render_tile_free(&w->tile);
    free(w);
}

static tile_work *open_work(const drawing *d) {
    const bool layered = d->renderer->materials.layered;
    tile_work *w = calloc(1, sizeof *w);
    if (w && render_surfaces_create(RENDER_TILE, RENDER_TILE, layered, &w->surfaces) &&
        render_surfaces_create(RENDER_TILE, RENDER_TILE, layered, &w->first) &&
        render_surfaces_keep_smooth(&w->first) && render_tile_create(RENDER_TILE_PIXELS, &w->tile))
        return w;
    close_work(w);
    return NULL;
}

/* The index of a pixel in a tile's planes. */
static size_t tile_index(int row, int column) {
    return (size_t)row * RENDER_TILE + (size_t)column;
}

static void draw_tile(const drawing *d, const shade_job *job, const render_camera *cameras,
                      const render_rectangle *pixels, tile_work *w) {
    const render_frame *frame = d->frame;
    memset(w->sums, 0, sizeof w->sums);
    for (int i = 0; i < d->samples; i++) {
        render_surfaces *s = i > 0 ? &w->surfaces : &w->first;
        float *rgba = i > 0 ? w->rgba : w->first_rgba;
        const shade_sample before = { &w->first, w->first_rgba };
        const double start = timing_now();
        s->x = pixels->x;
        s->y = pixels->y;
        set_planes(d, &cameras[i], s);
        cpu_rays_fill(&d->view, pixels, i > 0 ? &w->first : NULL, s);
        const double found = timing_now();
        shade_tile(job, s, i > 0 ? &before : NULL, pixels, &w->tile, rgba);
        if (i == 0 && d->samples > 1)
            cpu_shared_mark(s, rgba, pixels);
        for (int row = 0; row < pixels->height; row++)
            for (int column = 0; column < pixels->width; column++) {
                const size_t at = 4 * tile_index(row, column);
                add_sample(d->exposure, rgba + at, w->sums + at);
            }
        w->surfaces_seconds += found - start;
        w->shade_seconds += timing_now() - found;
    }
    for (int row = 0; row < pixels->height; row++) {
        const size_t first = (size_t)(pixels->y + row) * (size_t)frame->width + (size_t)pixels->x;
        for (int column = 0; column < pixels->width; column++) {
            const size_t at = 4 * tile_index(row, column);
            set_pixel(d->samples, w->first_rgba + at, w->sums + at,
                      d->renderer->image.rgb + 3 * (first + (size_t)column));
        }
    }
}

static bool draw_tiles(drawing *d, const shade_job *job, const render_camera *cameras) {
    const render_frame *frame = d->frame;
    const int count = render_tile_count(frame->width, frame->height);
    double surfaces = 0, shade = 0;
    bool ok = true;
#pragma omp parallel reduction(&& : ok) reduction(+ : surfaces, shade)
    {
        tile_work *work = open_work(d);
        ok = work != NULL;
#pragma omp for schedule(dynamic)
        for (int i = 0; i < count; i++)
            if (work) {
                const render_rectangle pixels = render_tile_at(frame->width, frame->height, i);
                draw_tile(d, job, cameras, &pixels, work);
            }
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
    render_camera *cameras = malloc((size_t)d->samples * sizeof *cameras);
    shade_job *job = cameras ? shade_begin(frame, NULL) : NULL;
    const double start = timing_now();
    bool ok = job || cli_fail(error, NULL, "out of memory");
    for (int i = 0; ok && i < d->samples; i++)
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
        (r->rgba || (r->rgba = memory_large(bytes))) &&
        (r->sums || (r->sums = memory_large(bytes))) &&
        (!keep || r->first.memory || render_surfaces_create(width, height, layered, &r->first)) &&
        (!keep || r->first_rgba || (r->first_rgba = memory_large(bytes))) &&
        ((!d->frame->shadow.run && !d->frame->keep_geometry) ||
         (render_surfaces_keep_hits(&r->surfaces) &&
          (!keep || render_surfaces_keep_hits(&r->first)))) &&
        (!keep || render_surfaces_keep_smooth(&r->first));
    if (!ok)
        free_planes(r);
    return ok || cli_fail(error, NULL, "out of memory for an image of %d x %d", width, height);
}

/* Where the camera is that of the planes, lights alone may have moved. first: NULL, or the planes
 * of the first sample. */
static void find_surfaces(const drawing *d, const render_camera *camera,
                          const render_surfaces *first, render_surfaces *s) {
    cpu_renderer *r = d->renderer;
    const int count = render_tile_count(s->width, s->height);
    const bool again = r->kept == s && memcmp(&r->view, camera, sizeof *camera) == 0;
    set_planes(d, camera, s);
#pragma omp parallel for schedule(dynamic)
    for (int i = 0; i < count; i++) {
        const render_rectangle pixels = render_tile_at(s->width, s->height, i);
        if (again)
            cpu_rays_light(&d->view, &pixels, s);
        else
            cpu_rays_fill(&d->view, &pixels, first, s);
    }
    if (d->frame->keep_geometry && s->hits) {
        r->kept = s;
        r->view = *camera;
    } else if (r->kept == s)
        r->kept = NULL;
}

static void mark_shared(const render_surfaces *first, const float *rgba) {
    const int count = render_tile_count(first->width, first->height);
#pragma omp parallel for schedule(dynamic)
    for (int i = 0; i < count; i++) {
        const render_rectangle pixels = render_tile_at(first->width, first->height, i);
        cpu_shared_mark(first, rgba, &pixels);
    }
}

/* Adds rgba to the sums; with `show` the image is what there is so far. */
static void resolve(const drawing *d, int index, bool show) {
    cpu_renderer *r = d->renderer;
    const ptrdiff_t count = (ptrdiff_t)d->frame->width * d->frame->height;
#pragma omp parallel for schedule(static)
    for (ptrdiff_t i = 0; i < count; i++) {
        const float *rgba = r->rgba + 4 * i;
        float *sum = r->sums + 4 * i;
        if (index == 0)
            memset(sum, 0, 4 * sizeof *sum);
        add_sample(d->exposure, rgba, sum);
        if (show)
            set_pixel(d->samples, rgba, sum, r->image.rgb + 3 * i);
    }
}

/* With `keep` the first sample's surfaces and radiance stay, for the others to be compared with. */
static bool draw_sample(drawing *d, int index, bool keep, render_times *times, cli_error *error) {
    cpu_renderer *r = d->renderer;
    const render_frame *frame = d->frame;
    const bool kept = keep && index == 0;
    render_surfaces *s = kept ? &r->first : &r->surfaces;
    float *rgba = kept ? r->first_rgba : r->rgba;
    render_camera camera;
    if (!render_camera_set(d->view.scene, frame, index, &camera, error))
        return false;
    const double start = timing_now();
    find_surfaces(d, &camera, keep && !kept ? &r->first : NULL, s);
    const double found = timing_now();
    shade_job *job = shade_begin(frame, s);
    const shade_sample before = { &r->first, r->first_rgba };
    const bool ok = job && shade_tiles(job, s, keep && !kept ? &before : NULL, rgba);
    shade_end(job);
    if (!ok)
        return cli_fail(error, NULL, "out of memory");
    if (kept) { /* shadows change what they are given */
        mark_shared(&r->first, rgba);
        memcpy(r->rgba, rgba, 4 * (size_t)frame->width * (size_t)frame->height * sizeof *r->rgba);
    }
    const double shaded = timing_now();
    if (frame->shadow.run && !frame->shadow.run(frame->shadow.user, frame, s, r->rgba, error))
        return false;
    if (times) {
        times->surfaces += 1e3 * (found - start);
        times->shade += 1e3 * (shaded - found);
        times->shadow += 1e3 * (timing_now() - shaded);
    }
    return true;
}

/* Where something needs all surfaces of a sample at once, or samples come one at a time: then
 * `show` has the image be the mean so far. */
static bool draw_whole(drawing *d, int first, int end, bool show, render_times *times,
                       cli_error *error) {
    const bool keep = d->samples > 1;
    if (!size_planes(d, keep, error))
        return false;
    for (int i = first; i < end; i++) {
        if (!draw_sample(d, i, keep, times, error))
            return false;
        resolve(d, i, show || i == end - 1);
    }
    return true;
}

/* --- a frame ---------------------------------------------------------------------------------- */

/* Whether something needs all surfaces of a sample at once. */
static bool has_planes(const render_frame *frame) {
    return frame->shadow.run || frame->keep_geometry ||
           method_table[frame->method].reads & METHOD_READS_FIELD;
}

static bool size_image(cpu_renderer *r, const render_frame *frame, cli_error *error) {
    if (r->image.rgb && r->image.width == frame->width && r->image.height == frame->height)
        return true;
    image_free(&r->image);
    return image_create(&r->image, frame->width, frame->height, error);
}

static bool draw(cpu_renderer *r, const render_frame *frame, int first, int end, bool refine,
                 render_times *times, cli_error *error) {
    drawing d = { .renderer = r,
                  .frame = frame,
                  .samples = refine ? frame->samples : end,
                  .exposure = frame->samples_exposure,
                  .view = { r->world->scene, r->world->bvh, r->world->textures, NULL } };
    trace_spheres *lights;
    if (times)
        *times = (render_times) { .shade = 0 };
    const double start = timing_now();
    render_materials_note_sheen(&r->materials, r->materials.fibers);
    if (!render_frame_check(frame, error) || !size_image(r, frame, error))
        return false;
    if (!cpu_lights_create(frame, r->world->bvh, &lights))
        return cli_fail(error, NULL, "out of memory");
    d.view.lights = lights;
    const bool ok = refine || has_planes(frame) ? draw_whole(&d, first, end, refine, times, error)
                                                : draw_streamed(&d, times, error);
    trace_spheres_destroy(lights);
    if (times)
        times->total = 1e3 * (timing_now() - start);
    return ok;
}

bool cpu_render(cpu_renderer *r, const render_frame *frame, int count, render_times *times,
                cli_error *error) {
    return draw(r, frame, 0, count, false, times, error);
}

bool cpu_refine(cpu_renderer *r, const render_frame *frame, int index, render_times *times,
                cli_error *error) {
    return draw(r, frame, index, index + 1, true, times, error);
}
