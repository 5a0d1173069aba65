/* SPDX-License-Identifier: MIT */
#include "app/render/cpu/whole.h"

#include "app/base/memory.h"
#include "app/base/timing.h"
#include "app/render/cpu/shared.h"
#include "app/render/shade.h"

#include <stdlib.h>
#include <string.h>

void cpu_whole_free(cpu_whole *w) {
    render_surfaces_free(&w->surfaces);
    render_surfaces_free(&w->first);
    free(w->rgba);
    free(w->first_rgba);
    free(w->sums);
    w->rgba = w->first_rgba = w->sums = NULL;
    w->kept = NULL;
}

/* Allocates planes of the frame's size, replacing those of another size. */
static bool size_planes(cpu_whole *w, const cpu_drawing *d, bool keep, base_error *error) {
    const int width = d->frame->width, height = d->frame->height;
    const size_t bytes = 4 * (size_t)width * (size_t)height * sizeof(float);
    const render_materials *const materials = d->materials;
    if (w->surfaces.width != width || w->surfaces.height != height)
        cpu_whole_free(w);
    const bool ok =
        (w->surfaces.memory || render_surfaces_create(width, height, materials, &w->surfaces)) &&
        (w->rgba || (w->rgba = memory_large(bytes))) &&
        (w->sums || (w->sums = memory_large(bytes))) &&
        (!keep || w->first.memory || render_surfaces_create(width, height, materials, &w->first)) &&
        (!keep || w->first_rgba || (w->first_rgba = memory_large(bytes))) &&
        ((!d->frame->shadow.run && !d->frame->keep_geometry) ||
         (render_surfaces_keep_hits(&w->surfaces) &&
          (!keep || render_surfaces_keep_hits(&w->first)))) &&
        render_surfaces_fit_bounced(d->frame, &w->surfaces) &&
        (!keep || render_surfaces_fit_bounced(d->frame, &w->first)) &&
        (!keep || !d->frame->bounces.fill || render_surfaces_note_taken(&w->surfaces)) &&
        (!keep || render_surfaces_keep_smooth(&w->first));
    if (!ok)
        cpu_whole_free(w);
    return ok || base_fail(error, NULL, "out of memory for an image of %d x %d", width, height);
}

/* Finds the surfaces. If the camera is that of the kept planes, only lights may have moved. first:
 * NULL, or the planes of the first sample. */
static void find_surfaces(cpu_whole *w, const cpu_drawing *d, const render_camera *camera,
                          const render_surfaces *first, render_surfaces *s) {
    const int count = render_tile_count(s->width, s->height);
    const bool again = w->kept == s && memcmp(&w->view, camera, sizeof *camera) == 0;
    cpu_set_planes(d, camera, s);
    s->first = first;
#pragma omp parallel for schedule(dynamic)
    for (int i = 0; i < count; i++) {
        const render_rectangle pixels = render_tile_at(s->width, s->height, i);
        if (!render_next_tile(d->frame))
            continue;
        if (again)
            cpu_rays_light(&d->view, &pixels, s);
        else
            cpu_rays_fill(&d->view, &pixels, first, s);
    }
    if (d->frame->keep_geometry && s->hits) {
        w->kept = s;
        w->view = *camera;
    } else if (w->kept == s)
        w->kept = NULL;
}

static void mark_shared(const render_surfaces *first, const float *rgba) {
    const int count = render_tile_count(first->width, first->height);
#pragma omp parallel for schedule(dynamic)
    for (int i = 0; i < count; i++) {
        const render_rectangle pixels = render_tile_at(first->width, first->height, i);
        cpu_shared_mark(first, rgba, &pixels);
    }
}

/* Adds rgba to the sums, unless it is the only sample; if `show`, also sets the image to the mean
 * so far. */
static void resolve(cpu_whole *w, const cpu_drawing *d, int index, bool keep, bool show) {
    const render_surfaces *s = keep && index == 0 ? &w->first : &w->surfaces;
    const ptrdiff_t count = (ptrdiff_t)d->frame->width * d->frame->height;
#pragma omp parallel for schedule(static)
    for (ptrdiff_t i = 0; i < count; i++) {
        const float *rgba = w->rgba + 4 * i;
        float *sum = w->sums + 4 * i;
        if (keep) {
            if (index == 0)
                memset(sum, 0, 4 * sizeof *sum);
            cpu_add_sample(d->exposure, rgba, cpu_blended(s, (size_t)i), sum);
        }
        if (show)
            cpu_set_pixel(d->samples, rgba, sum, d->image->rgb + 3 * i);
    }
}

/* Draws a sample; if `keep`, the first sample's surfaces and radiance are kept for later samples to
 * reuse. */
static bool draw_sample(cpu_whole *w, const cpu_drawing *d, int index, bool keep,
                        render_times *times, base_error *error) {
    const render_frame *frame = d->frame;
    const bool kept = keep && index == 0;
    render_surfaces *s = kept ? &w->first : &w->surfaces;
    float *rgba = kept ? w->first_rgba : w->rgba;
    render_camera camera;
    if (!render_camera_set(d->view.scene, frame, index, &camera, error))
        return false;
    const double start = timing_now();
    find_surfaces(w, d, &camera, keep && !kept ? &w->first : NULL, s);
    const double found = timing_now();
    if (!render_goes_on(frame, error))
        return false;
    if (!render_surfaces_fill_bounced(s))
        return base_fail(error, NULL, "out of memory");
    const double bounced = timing_now();
    shade_job *job = shade_begin(frame, shade_want_surfaces, s);
    const double begun = timing_now();
    const shade_sample before = { &w->first, w->first_rgba };
    const bool ok = job && shade_tiles(job, s, keep && !kept ? &before : NULL, rgba);
    if (ok)
        shade_note(job, 1e3 * (timing_now() - begun));
    shade_end(job);
    if (!ok)
        return base_fail(error, NULL, "out of memory");
    if (!render_goes_on(frame, error))
        return false;
    if (kept) { /* keep a copy before shadows change the radiance */
        mark_shared(&w->first, rgba);
        memcpy(w->rgba, rgba, 4 * (size_t)frame->width * (size_t)frame->height * sizeof *w->rgba);
    }
    const double shaded = timing_now();
    if (frame->shadow.run && !frame->shadow.run(frame->shadow.user, frame, s, w->rgba, error))
        return false;
    if (times) {
        times->surfaces += 1e3 * (found - start);
        times->bounces += 1e3 * (bounced - found);
        times->shade += 1e3 * (shaded - bounced);
        times->shadow += 1e3 * (timing_now() - shaded);
    }
    return true;
}

bool cpu_whole_draw(cpu_whole *w, const cpu_drawing *d, int first, int end, bool show,
                    render_times *times, base_error *error) {
    const bool keep = d->samples > 1;
    /* surfaces, shades, and shadows seldom or never in two steps */
    const int steps = (end - first) * (d->frame->shadow.run ? 4 : 2);
    if (!size_planes(w, d, keep, error))
        return false;
    render_progress_reset(d->frame->progress,
                          steps * render_tile_count(d->frame->width, d->frame->height));
    for (int i = first; i < end; i++) {
        if (!draw_sample(w, d, i, keep, times, error))
            return false;
        resolve(w, d, i, keep, show || i == end - 1);
    }
    return true;
}
