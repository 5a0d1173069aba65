/* SPDX-License-Identifier: MIT */
#include "app/render/cpu/cpu.h"

#include "app/base/timing.h"
#include "app/render/cpu/split.h"
#include "app/render/cpu/tiles.h"
#include "app/render/cpu/whole.h"

#include <stdlib.h>

struct cpu_scene {
    const scene *scene;
    const trace_bvh *bvh;
    trace_bvh *own; /* the same tree, or NULL if it is another's */
    cpu_textures *textures;
};

struct cpu_renderer {
    const cpu_scene *world;
    render_materials materials;
    const environment *environment;
    image image;
    cpu_tiles tiles;
    cpu_whole whole;
};

/* --- creation --------------------------------------------------------------------------------- */

cpu_scene *cpu_scene_create(const scene *world, const trace_bvh *bvh, base_error *error) {
    cpu_scene *s = calloc(1, sizeof *s);
    if (s) {
        s->scene = world;
        s->own = bvh ? NULL : trace_create(world);
        s->bvh = bvh ? bvh : s->own;
        s->textures = cpu_textures_create(world);
    }
    if (s && s->bvh && s->textures)
        return s;
    cpu_scene_destroy(s);
    base_fail(error, world->name, "out of memory");
    return NULL;
}

void cpu_scene_destroy(cpu_scene *s) {
    if (!s)
        return;
    trace_destroy(s->own);
    cpu_textures_destroy(s->textures);
    free(s);
}

const trace_bvh *cpu_scene_bvh(const cpu_scene *s) {
    return s->bvh;
}

cpu_renderer *cpu_renderer_create(const cpu_scene *world, base_error *error) {
    cpu_renderer *r = calloc(1, sizeof *r);
    if (r && render_materials_create(world->scene, &r->materials)) {
        r->world = world;
        return r;
    }
    free(r);
    base_fail(error, world->scene->name, "out of memory");
    return NULL;
}

void cpu_renderer_destroy(cpu_renderer *r) {
    if (!r)
        return;
    cpu_tiles_free(&r->tiles);
    cpu_whole_free(&r->whole);
    image_free(&r->image);
    render_materials_free(&r->materials);
    free(r);
}

render_materials *cpu_renderer_materials(cpu_renderer *r) {
    r->whole.kept = NULL; /* the caller may change the materials, so surfaces must be found again */
    return &r->materials;
}

void cpu_set_environment(cpu_renderer *r, const environment *around) {
    r->environment = around;
}

const image *cpu_image(const cpu_renderer *r) {
    return &r->image;
}

/* --- a frame ---------------------------------------------------------------------------------- */

/* Whether something needs all surfaces of a sample at once. A field does, for it computes its nodes
 * before any surface is shaded, unless tiles find the hits of their only sample beforehand. */
static bool has_planes(const cpu_drawing *d) {
    const render_frame *frame = d->frame;
    return (frame->shadow.run && !frame->shadow.tiled) || frame->keep_geometry ||
           (method_table[frame->method].reads & METHOD_READS_FIELD &&
            (d->samples > 1 || d->materials->blends || frame->shadow.run));
}

static bool size_image(cpu_renderer *r, const render_frame *frame, base_error *error) {
    if (r->image.rgb && r->image.width == frame->width && r->image.height == frame->height)
        return true;
    image_free(&r->image);
    return image_create(&r->image, frame->width, frame->height, error);
}

static cpu_drawing drawing_of(cpu_renderer *r, const render_frame *frame) {
    return (cpu_drawing) { .frame = frame,
                           .materials = &r->materials,
                           .environment = r->environment,
                           .exposure = frame->samples_exposure,
                           .image = &r->image,
                           .view = { r->world->scene, r->world->bvh, r->world->textures, NULL } };
}

static bool draw(cpu_renderer *r, const render_frame *frame, int first, int end, bool refine,
                 render_times *times, base_error *error) {
    cpu_drawing d = drawing_of(r, frame);
    trace_lamps *lights;
    d.samples = refine ? frame->samples : end;
    if (times)
        *times = (render_times) { .shade = 0 };
    const double start = timing_now();
    render_materials_note_sheen(&r->materials, r->materials.sheen_tables[0]);
    if (!render_frame_check(frame, error) || !size_image(r, frame, error))
        return false;
    if (!cpu_lights_create(frame, r->world->bvh, &lights))
        return base_fail(error, NULL, "out of memory");
    d.view.lights = lights;
    const bool ok = refine || has_planes(&d)
                        ? cpu_whole_draw(&r->whole, &d, first, end, refine, times, error)
                        : cpu_tiles_draw(&r->tiles, &d, times, error);
    trace_lamps_destroy(lights);
    if (!ok)
        r->whole.kept = NULL; /* its planes may be filled in part */
    if (times)
        times->total = 1e3 * (timing_now() - start);
    return ok;
}

bool cpu_render(cpu_renderer *r, const render_frame *frame, int count, render_times *times,
                base_error *error) {
    return draw(r, frame, 0, count, false, times, error);
}

bool cpu_refine(cpu_renderer *r, const render_frame *frame, int index, render_times *times,
                base_error *error) {
    return draw(r, frame, index, index + 1, true, times, error);
}

bool cpu_split_pixel(cpu_renderer *r, const render_frame *frame, int x, int y,
                     const render_pass *around, cpu_split *split, base_error *error) {
    cpu_drawing d = drawing_of(r, frame);
    trace_lamps *lights;
    if (!render_frame_check(frame, error))
        return false;
    if (!cpu_lights_create(frame, r->world->bvh, &lights))
        return base_fail(error, NULL, "out of memory");
    d.view.lights = lights;
    const bool ok = cpu_split_draw(&d, x, y, around, split, error);
    trace_lamps_destroy(lights);
    return ok;
}
