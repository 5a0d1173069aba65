/* SPDX-License-Identifier: MIT */
#include "app/render/renderer/renderer.h"

#include "app/base/timing.h"
#include "app/render/surfaces.h"

#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* --- devices ---------------------------------------------------------------------------------- */

bool render_finds_gpu(void) {
    static const char *const nodes[] = { "/dev/dri/renderD*", "/dev/nvidia[0-9]*", "/dev/dxg" };
    bool found = false;
    for (size_t i = 0; i < sizeof nodes / sizeof *nodes && !found; i++) {
        glob_t matches = { .gl_pathc = 0 };
        found = glob(nodes[i], 0, NULL, &matches) == 0 && access(matches.gl_pathv[0], R_OK) == 0;
        globfree(&matches);
    }
    return found;
}

bool render_device_open(device_kind kind, const char *gl_device, const scene *world,
                        render_device *d, base_error *error) {
    memset(d, 0, sizeof *d);
    if (kind == DEVICE_GPU) {
        gpu_context gl;
        if (!gpu_context_create(gl_device, &gl, error))
            return false;
        render_device_adopt(&gl, world, d);
        d->adopted = false;
        return true;
    }
    return render_device_open_cpu(world, NULL, d, error);
}

bool render_device_open_cpu(const scene *world, const trace_bvh *bvh, render_device *d,
                            base_error *error) {
    memset(d, 0, sizeof *d);
    d->cpu = cpu_scene_create(world, bvh, error);
    if (!d->cpu)
        return false;
    d->kind = DEVICE_CPU;
    d->scene = world;
    timing_cpu_name(d->name, sizeof d->name);
    trace_version(cpu_scene_bvh(d->cpu), d->driver, sizeof d->driver);
    return true;
}

void render_device_adopt(const gpu_context *context, const scene *world, render_device *d) {
    memset(d, 0, sizeof *d);
    d->kind = DEVICE_GPU;
    d->scene = world;
    d->gl = *context;
    d->adopted = true;
    memcpy(d->name, context->device, sizeof d->name);
    memcpy(d->driver, context->driver, sizeof d->driver);
}

void render_device_close(render_device *d) {
    cpu_scene_destroy(d->cpu);
    trace_destroy(d->bvh);
    if (d->kind == DEVICE_GPU && !d->adopted)
        gpu_context_destroy(&d->gl);
    memset(d, 0, sizeof *d);
}

void render_device_lend(render_device *d, const trace_bvh *bvh) {
    d->lent = bvh;
}

const trace_bvh *render_device_bvh(render_device *d) {
    if (d->cpu)
        return cpu_scene_bvh(d->cpu);
    if (d->lent)
        return d->lent;
    if (!d->bvh)
        d->bvh = trace_create(d->scene);
    return d->bvh;
}

size_t render_device_field_bytes(const render_device *d) {
    return d->kind == DEVICE_GPU ? d->gl.storage_max : 0;
}

const char *render_device_clock(const render_device *d) {
    return d->kind == DEVICE_CPU || d->gl.software ? "wall clock" : "timer queries";
}

/* --- the renderer ----------------------------------------------------------------------------- */

any_renderer *renderer_create(const render_device *device, base_error *error) {
    any_renderer *r = calloc(1, sizeof *r);
    if (!r) {
        base_fail(error, NULL, "out of memory");
        return NULL;
    }
    if (device->kind == DEVICE_GPU)
        r->gl = gpu_renderer_create(&device->gl, device->scene, error);
    else
        r->cpu = cpu_renderer_create(device->cpu, error);
    if (r->gl || r->cpu)
        return r;
    free(r);
    return NULL;
}

void renderer_destroy(any_renderer *r) {
    if (!r)
        return;
    gpu_renderer_destroy(r->gl);
    cpu_renderer_destroy(r->cpu);
    free(r);
}

bool renderer_tables_fit(const any_renderer *r, method_kind method,
                         const lmp_brdf_table_info *tables, int count, base_error *error) {
    return !r->gl || gpu_tables_fit(r->gl, method, tables, count, error);
}

bool renderer_set_tables(any_renderer *r, const lmp_brdf_table *const *tables, int count,
                         const int *uses, base_error *error) {
    return r->gl ? gpu_set_tables(r->gl, tables, count, uses, error)
                 : render_materials_set_tables(cpu_renderer_materials(r->cpu), tables, count, uses,
                                               error);
}

void renderer_set_brdfs(any_renderer *r, const lmp_preintegrated_brdf *const *brdfs) {
    if (r->gl)
        gpu_set_preintegrated_brdfs(r->gl, brdfs);
    else
        render_materials_set_brdfs(cpu_renderer_materials(r->cpu), brdfs);
}

void renderer_set_sheen(any_renderer *r, const lmp_brdf_table *const *white) {
    if (r->gl)
        gpu_set_sheen(r->gl, white);
    else
        render_materials_set_sheen(cpu_renderer_materials(r->cpu), white);
}

void renderer_set_environment(any_renderer *r, const environment *around) {
    if (r->gl)
        gpu_set_environment(r->gl, around);
    else
        cpu_set_environment(r->cpu, around);
}

/* Lets the bounces of a frame, if it has any, follow its lights. */
static bool begin_bounces(const render_frame *frame, base_error *error) {
    return !frame->bounces.begin || frame->bounces.begin(frame->bounces.user, frame, error);
}

/* --- exposure --------------------------------------------------------------------------------- */

enum { METER_PIXELS = 192 * 108 };

/* Stores, in place of shadows, the light that surfaces reflect, and black where there is no
 * surface. */
static bool keep_lit(void *user, const render_frame *frame, const render_surfaces *s, float *rgba,
                     base_error *error) {
    image *pixels = user;
    (void)frame, (void)error;
    for (size_t i = 0; i < (size_t)s->width * (size_t)s->height; i++)
        for (size_t c = 0; c < 3; c++) {
            const float reflected = rgba[4 * i + c] - s->emission[c][i];
            pixels->rgb[3 * i + c] =
                s->seen[i] < RENDER_SEES_LIGHT && reflected > 0 ? reflected : 0;
        }
    return true;
}

bool renderer_meter(any_renderer *r, const render_frame *frame, image *pixels, base_error *error) {
    const double all = (double)frame->width * frame->height,
                 scale = all > METER_PIXELS ? sqrt(METER_PIXELS / all) : 1;
    render_frame small = *frame;
    scene_light *hidden = malloc((frame->light_count + 1) * sizeof *hidden);
    small.width = (int)fmax(1, frame->width * scale);
    small.height = (int)fmax(1, frame->height * scale);
    small.samples = 1;
    small.keep_geometry = false;
    if (!hidden)
        return base_fail(error, NULL, "out of memory");
    for (size_t i = 0; i < frame->light_count; i++) {
        hidden[i] = frame->lights[i];
        hidden[i].hidden = 1;
    }
    small.lights = hidden;
    bool ok =
        begin_bounces(&small, error) && image_create(pixels, small.width, small.height, error);
    small.shadow = (render_pass) { .run = keep_lit, .user = pixels };
    if (ok && !(r->gl ? gpu_render(r->gl, &small, NULL, error)
                      : cpu_render(r->cpu, &small, 1, NULL, error))) {
        image_free(pixels);
        ok = false;
    }
    free(hidden);
    return ok;
}

void renderer_set_meter(any_renderer *r, render_meter meter) {
    r->meter = meter;
}

bool renderer_draw(any_renderer *r, const render_frame *frame, render_times *times,
                   base_error *error) {
    render_frame metered = *frame;
    if (r->meter.run) {
        image pixels;
        if (!renderer_meter(r, frame, &pixels, error))
            return false;
        metered.samples_exposure = r->meter.run(r->meter.user, &pixels);
        image_free(&pixels);
    }
    if (!begin_bounces(frame, error))
        return false;
    return r->gl ? gpu_render(r->gl, &metered, times, error)
                 : cpu_render(r->cpu, &metered, frame->samples > 1 ? frame->samples : 1, times,
                              error);
}

bool renderer_refine(any_renderer *r, const render_frame *frame, int index, render_times *times,
                     base_error *error) {
    if (!begin_bounces(frame, error))
        return false;
    return r->gl ? gpu_refine(r->gl, frame, index, times, error)
                 : cpu_refine(r->cpu, frame, index, times, error);
}

bool renderer_split(any_renderer *r, const render_frame *frame, int x, int y,
                    const render_pass *around, cpu_split *split, base_error *error) {
    return begin_bounces(frame, error) &&
           cpu_split_pixel(r->cpu, frame, x, y, around, split, error);
}

bool renderer_read_rgb8(any_renderer *r, const image_display *display, unsigned char *rgb8,
                        render_times *times, base_error *error) {
    if (r->gl)
        return gpu_read_rgb8(r->gl, display, rgb8, times, error);
    const double start = timing_now();
    image_tone_map(cpu_image(r->cpu), display, rgb8);
    if (times) {
        times->tone = 1e3 * (timing_now() - start);
        times->total += times->tone;
    }
    return true;
}

bool renderer_read_image(any_renderer *r, image *pixels, base_error *error) {
    if (r->gl)
        return gpu_read_image(r->gl, pixels, error);
    const image *from = cpu_image(r->cpu);
    if (!image_create(pixels, from->width, from->height, error))
        return false;
    memcpy(pixels->rgb, from->rgb,
           3 * (size_t)from->width * (size_t)from->height * sizeof *pixels->rgb);
    return true;
}
