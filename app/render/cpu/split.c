/* SPDX-License-Identifier: MIT */
#include "app/render/cpu/split.h"

#include "app/render/shade.h"
#include "app/render/shade_field.h"

/* The surface of a pixel, without emission and bounced light, in a tile of its own. */
typedef struct split_pixel {
    render_rectangle at;
    render_surfaces surfaces;
    render_tile tile;
} split_pixel;

static bool fail_memory(base_error *error) {
    return base_fail(error, NULL, "out of memory");
}

/* --- the surface ------------------------------------------------------------------------------ */

static bool find_surface(const cpu_drawing *d, split_pixel *p, base_error *error) {
    render_surfaces *s = &p->surfaces;
    const render_frame *frame = d->frame;
    render_camera camera;
    if (!render_camera_set(d->view.scene, frame, 0, &camera, error))
        return false;
    if (!render_surfaces_create(1, 1, d->materials, s) || !render_surfaces_keep_hits(s) ||
        !render_surfaces_fit_bounced(frame, s) || !render_tile_create(RENDER_TILE_PIXELS, &p->tile))
        return fail_memory(error);
    cpu_set_planes(d, &camera, s);
    s->x = p->at.x;
    s->y = p->at.y;
    cpu_rays_fill(&d->view, &p->at, NULL, s);
    if (frame->bounces.fill)
        frame->bounces.fill(frame->bounces.user, s, &p->at, &p->tile);
    return true;
}

/* Moves from the surface to the split what the surface does not reflect of lights. */
static void take_emission(split_pixel *p, cpu_split *split) {
    static const lmp_rgb none = { 0, 0, 0 };
    render_surfaces *s = &p->surfaces;
    split->emission = render_color_at(s->emission, 0);
    render_set_color(s->emission, 0, none);
    if (!s->bounced[0])
        return;
    split->bounced = render_color_at(s->bounced, 0);
    render_set_color(s->bounced, 0, none);
}

/* --- lights ----------------------------------------------------------------------------------- */

static bool shade(split_pixel *p, const render_frame *frame, const environment *around,
                  float rgba[4], base_error *error) {
    p->surfaces.frame = frame;
    p->surfaces.environment = around;
    shade_field_forget(frame->field);
    shade_job *job = shade_begin(frame, shade_want_surfaces, &p->surfaces);
    if (!job)
        return fail_memory(error);
    shade_tile(job, &p->surfaces, NULL, &p->at, &p->tile, rgba);
    shade_end(job);
    return true;
}

/* Multiplies a pixel by the fraction of the frame's light that arrives. */
static bool cast(const split_pixel *p, const render_pass *pass, const render_frame *frame,
                 float rgba[4], base_error *error) {
    const render_tiled_pass *tiled = pass->tiled;
    if (!pass->run)
        return true;
    if (!tiled->begin(pass->user, frame, 0, error))
        return false;
    void *work = tiled->open(pass->user);
    if (!work)
        return fail_memory(error);
    tiled->look(pass->user, work, &p->surfaces, &p->at);
    tiled->mix(pass->user);
    tiled->change(pass->user, &p->surfaces, &p->at, rgba);
    tiled->close(pass->user, work);
    return true;
}

static lmp_rgb negative(lmp_rgb color) {
    return (lmp_rgb) { -color.r, -color.g, -color.b };
}

static void keep(const float rgba[4], lmp_rgb *given) {
    *given = (lmp_rgb) { rgba[0], rgba[1], rgba[2] };
}

/* Shading clamps sums at 0, and what is clamped of a light is what its negative gives: the
 * difference is the light's part of the sum, below 0 where its truncated series rings. */
static bool shade_light(split_pixel *p, const render_frame *frame, lmp_rgb *given,
                        base_error *error) {
    scene_light light = *frame->lights;
    render_frame alone = *frame;
    float rgba[4], clamped[4];
    alone.lights = &light;
    if (!shade(p, &alone, NULL, rgba, error))
        return false;
    light.emitter.radiance = negative(light.emitter.radiance);
    light.emitter.ground = negative(light.emitter.ground);
    if (!shade(p, &alone, NULL, clamped, error))
        return false;
    for (int c = 0; c < 3; c++)
        rgba[c] -= clamped[c];
    keep(rgba, given);
    return true;
}

/* Returns the frame with one of its lights. */
static render_frame frame_of(const render_frame *frame, size_t light) {
    render_frame alone = *frame;
    alone.lights = frame->lights + light;
    alone.light_count = 1;
    return alone;
}

/* Where the sum over all lights is clamped, shrinks the parts below 0 until all sum to what is
 * shaded. A difference within rounding stays. */
static void fit(lmp_rgb *lights, size_t count, const float shaded[4]) {
    static const double rounding = 1e-6;
    for (int c = 0; c < 3; c++) {
        double above = 0, below = 0;
        for (size_t i = 0; i < count; i++) {
            const double part = (double)(&lights[i].r)[c];
            above += part > 0 ? part : 0;
            below += part < 0 ? part : 0;
        }
        const double excess = (double)shaded[c] - above;
        if (below + rounding * above >= excess || !(below < 0))
            continue;
        const float scale = excess < 0 ? (float)(excess / below) : 0;
        for (size_t i = 0; i < count; i++)
            if ((&lights[i].r)[c] < 0)
                (&lights[i].r)[c] *= scale;
    }
}

/* The field of the frame, if it has one, follows each light, and in the end all of them again. */
static bool shade_lights_apart(split_pixel *p, const render_frame *frame, lmp_rgb *lights,
                               base_error *error) {
    float shaded[4];
    for (size_t i = 0; i < frame->light_count; i++) {
        const render_frame alone = frame_of(frame, i);
        if (!shade_light(p, &alone, &lights[i], error))
            return false;
    }
    if (!shade(p, frame, NULL, shaded, error))
        return false;
    fit(lights, frame->light_count, shaded);
    return true;
}

static bool cast_lights(const split_pixel *p, const render_frame *frame, lmp_rgb *lights,
                        base_error *error) {
    for (size_t i = 0; i < frame->light_count; i++) {
        const render_frame alone = frame_of(frame, i);
        float rgba[4] = { lights[i].r, lights[i].g, lights[i].b };
        if (!cast(p, &frame->shadow, &alone, rgba, error))
            return false;
        keep(rgba, &lights[i]);
    }
    return true;
}

static bool shade_environment(split_pixel *p, const cpu_drawing *d, const render_pass *around,
                              lmp_rgb *given, base_error *error) {
    render_frame alone = *d->frame;
    float rgba[4];
    alone.light_count = 0;
    if (!environment_shines(d->environment))
        return true;
    if (!shade(p, &alone, d->environment, rgba, error) || !cast(p, around, &alone, rgba, error))
        return false;
    keep(rgba, given);
    return true;
}

static bool split_surface(split_pixel *p, const cpu_drawing *d, const render_pass *around,
                          cpu_split *split, base_error *error) {
    take_emission(p, split);
    return shade_environment(p, d, around, &split->environment, error) &&
           shade_lights_apart(p, d->frame, split->lights, error) &&
           cast_lights(p, d->frame, split->lights, error);
}

bool cpu_split_draw(const cpu_drawing *d, int x, int y, const render_pass *around, cpu_split *split,
                    base_error *error) {
    split_pixel p = { .at = { x, y, 1, 1 } };
    bool ok = find_surface(d, &p, error);
    split->seen = ok ? p.surfaces.seen[0] : RENDER_SEES_NOTHING;
    if (split->seen < RENDER_SEES_LIGHT)
        ok = split_surface(&p, d, around, split, error);
    render_surfaces_free(&p.surfaces);
    render_tile_free(&p.tile);
    return ok;
}
