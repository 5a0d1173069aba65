/* SPDX-License-Identifier: MIT */
#include "app/render/cpu/rays.h"

#include "app/render/cpu/surface.h"
#include "app/scene/instance.h"
#include "app/scene/trace/blend.h"
#include "app/scene/trace/trace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool cpu_lights_create(const render_frame *frame, const trace_bvh *bvh, trace_lamps **lights) {
    trace_lamp *drawn = malloc((frame->light_count + 1) * sizeof *drawn);
    size_t count = 0;
    *lights = NULL;
    if (!drawn)
        return false;
    for (size_t i = 0; i < frame->light_count; i++) {
        if (scene_light_is_drawn(&frame->lights[i]))
            drawn[count++] = (trace_lamp) { &frame->lights[i].emitter, (uint32_t)i };
    }
    if (count > 0)
        *lights = trace_lamps_create(bvh, drawn, count);
    free(drawn);
    return count == 0 || *lights;
}

/* Rays side by side cover a square of pixels: two halves of 4 by 2, which are the packets of half
 * the width. */
enum { SIDE = 4 };

/* Sets the rays of a square's pixels; those outside the rectangle, which ends after width and
 * height, are inactive. */
static void set_rays(const render_surfaces *s, int x, int y, int width, int height,
                     trace_rays *rays) {
    const render_camera *c = &s->camera;
    float *const origin[3] = { rays->origin[0], rays->origin[1], rays->origin[2] };
    float *const direction[3] = { rays->direction[0], rays->direction[1], rays->direction[2] };
    int columns[TRACE_LANES], rows[TRACE_LANES];
    for (int i = 0; i < TRACE_LANES; i++) {
        columns[i] = x + i % SIDE;
        rows[i] = y + i / SIDE;
    }
    /* inactive rays, too, have a direction similar to their neighbors' */
    render_camera_rays(c, columns, rows, TRACE_LANES, origin, direction);
    for (int i = 0; i < TRACE_LANES; i++) {
        const bool inside = i % SIDE < width && i / SIDE < height;
        rays->start[i] = c->parallel ? 0 : c->near;
        rays->length[i] = inside ? c->far : -1;
    }
}

/* The most surfaces that a ray looks through. */
enum { LAYERS_MAX = 64 };

/* Whether a ray's sample sees the surface that it has hit. */
static bool sees(const cpu_view *view, const trace_hit *hit, blend_part *part) {
    if (hit->instance == TRACE_NOTHING)
        return true;
    const uint32_t material = scene_instance_material(view->scene, hit->instance);
    return !(view->scene->materials[material].flags & SCENE_ALPHA_BLEND) ||
           blend_sees(part, (float)trace_alpha(view->scene, hit));
}

/* Lets the rays continue whose samples see what is behind; returns whether there are any. */
static bool pass(const cpu_view *view, const trace_hit hits[TRACE_LANES],
                 blend_part parts[TRACE_LANES], trace_rays *onward) {
    bool some = false;
    for (int i = 0; i < TRACE_LANES; i++) {
        if (onward->length[i] < 0 || sees(view, &hits[i], &parts[i]))
            onward->length[i] = -1;
        else
            onward->start[i] = hits[i].distance;
        some |= onward->length[i] >= 0;
    }
    return some;
}

/* Replaces each ray's hit by the surface that its sample sees, in a scene with blended surfaces. */
static void look_through(const cpu_view *view, int x, int y, trace_rays onward,
                         trace_hit hits[TRACE_LANES], const render_surfaces *s) {
    blend_part parts[TRACE_LANES];
    trace_hit behind[TRACE_LANES];
    bool inside[TRACE_LANES];
    for (int i = 0; i < TRACE_LANES; i++) {
        const uint32_t column = (uint32_t)(x + i % SIDE), row = (uint32_t)(y + i / SIDE);
        inside[i] = onward.length[i] >= 0;
        parts[i] =
            blend_begin(column, row, (uint32_t)s->camera.sample, (uint32_t)s->camera.samples);
    }
    for (int layer = 0; layer < LAYERS_MAX && pass(view, hits, parts, &onward); layer++) {
        trace_nearest_n(view->bvh, TRACE_CAMERA, &onward, behind);
        for (int i = 0; i < TRACE_LANES; i++)
            if (onward.length[i] >= 0)
                hits[i] = behind[i];
    }
    for (int i = 0; i < TRACE_LANES; i++)
        if (inside[i])
            s->weight[render_surfaces_at(s, x + i % SIDE, y + i / SIDE)] =
                parts[i].blended ? parts[i].weight : 0;
}

/* Marks the pixels that see a light, where one is nearer than what the ray has hit. */
static void see_lights(const cpu_view *view, int x, int y, const trace_rays *rays,
                       trace_hit hits[TRACE_LANES], const render_surfaces *s) {
    bool found[TRACE_LANES] = { false };
    if (view->lights)
        trace_lamps_nearest_n(view->lights, rays, found, hits);
    for (int i = 0; i < TRACE_LANES; i++) {
        if (!found[i])
            continue;
        const size_t at = render_surfaces_at(s, x + i % SIDE, y + i / SIDE);
        s->seen[at] = RENDER_SEES_LIGHT + hits[i].instance;
        if (s->same)
            s->same[at] = 0;
        if (s->taken)
            s->taken[at] = 0;
    }
}

/* Fills a square from what its rays have hit. */
static void fill_square(const cpu_view *view, int x, int y, const trace_rays *rays,
                        trace_hit hits[TRACE_LANES], const cpu_first *first, cpu_triangle *triangle,
                        const render_surfaces *s) {
    for (int i = 0; i < TRACE_LANES; i++) {
        if (rays->length[i] < 0)
            continue;
        const size_t at = render_surfaces_at(s, x + i % SIDE, y + i / SIDE);
        if (s->hits)
            s->hits[at] = hits[i];
        if (s->smooth)
            s->smooth[at] = 0;
        if (s->same)
            s->same[at] = 0;
        if (s->taken)
            s->taken[at] = 0;
        if (hits[i].instance == TRACE_NOTHING)
            s->seen[at] = RENDER_SEES_NOTHING;
        else {
            cpu_triangle_find(view->scene, &hits[i], triangle);
            const float direction[3] = { rays->direction[0][i], rays->direction[1][i],
                                         rays->direction[2][i] };
            cpu_surface_fill(view->textures, triangle, direction, &hits[i], first, at, s);
        }
    }
    see_lights(view, x, y, rays, hits, s);
}

/* Returns the hits that the planes keep of a square's rays. */
static void load_hits(int x, int y, const trace_rays *rays, const render_surfaces *s,
                      trace_hit hits[TRACE_LANES]) {
    for (int i = 0; i < TRACE_LANES; i++)
        hits[i] = rays->length[i] < 0 ? trace_miss()
                                      : s->hits[render_surfaces_at(s, x + i % SIDE, y + i / SIDE)];
}

/* Restores what the pixels of a square see from the kept hits, then finds the lights before
 * them. */
static void light_square(const cpu_view *view, int x, int y, int width, int height,
                         const render_surfaces *s) {
    trace_rays rays;
    trace_hit hits[TRACE_LANES];
    set_rays(s, x, y, width, height, &rays);
    load_hits(x, y, &rays, s, hits);
    for (int i = 0; i < TRACE_LANES; i++) {
        if (rays.length[i] < 0)
            continue;
        const size_t at = render_surfaces_at(s, x + i % SIDE, y + i / SIDE);
        s->seen[at] = hits[i].instance == TRACE_NOTHING
                          ? RENDER_SEES_NOTHING
                          : scene_instance_material(view->scene, hits[i].instance);
    }
    see_lights(view, x, y, &rays, hits, s);
}

/* Fills a rectangle; `found`: from the hits that the planes keep. */
static void fill(const cpu_view *view, const render_rectangle *pixels, const render_surfaces *first,
                 bool found, const render_surfaces *s) {
    const cpu_first before = { first, render_nearness_of(&s->camera) };
    cpu_triangle triangle = { .material = NULL };
    for (int j = 0; j < pixels->height; j += SIDE)
        for (int i = 0; i < pixels->width; i += SIDE) {
            const int x = pixels->x + i, y = pixels->y + j;
            trace_rays rays;
            trace_hit hits[TRACE_LANES];
            set_rays(s, x, y, pixels->width - i, pixels->height - j, &rays);
            if (found)
                load_hits(x, y, &rays, s, hits);
            else
                trace_nearest_n(view->bvh, TRACE_CAMERA, &rays, hits);
            if (s->weight)
                look_through(view, x, y, rays, hits, s);
            fill_square(view, x, y, &rays, hits, first ? &before : NULL, &triangle, s);
        }
}

void cpu_rays_fill(const cpu_view *view, const render_rectangle *pixels,
                   const render_surfaces *first, const render_surfaces *s) {
    fill(view, pixels, first, false, s);
}

void cpu_rays_fill_found(const cpu_view *view, const render_rectangle *pixels,
                         const render_surfaces *s) {
    fill(view, pixels, NULL, true, s);
}

/* Keeps the hits of a square, and appends their positions to those of the tile. */
static void find_square(const cpu_view *view, int x, int y, const trace_rays *rays,
                        cpu_triangle *triangle, const render_surfaces *s, render_tile *tile,
                        size_t *count) {
    trace_hit hits[TRACE_LANES];
    trace_nearest_n(view->bvh, TRACE_CAMERA, rays, hits);
    for (int i = 0; i < TRACE_LANES; i++) {
        if (rays->length[i] < 0)
            continue;
        s->hits[render_surfaces_at(s, x + i % SIDE, y + i / SIDE)] = hits[i];
        if (hits[i].instance == TRACE_NOTHING)
            continue;
        cpu_triangle_find(view->scene, &hits[i], triangle);
        const lmp_vec3 position = cpu_surface_position(triangle, &hits[i]);
        tile->position[0][*count] = position.x;
        tile->position[1][*count] = position.y;
        tile->position[2][(*count)++] = position.z;
    }
}

size_t cpu_rays_find(const cpu_view *view, const render_rectangle *pixels, const render_surfaces *s,
                     render_tile *tile) {
    cpu_triangle triangle = { .material = NULL };
    size_t count = 0;
    for (int j = 0; j < pixels->height; j += SIDE)
        for (int i = 0; i < pixels->width; i += SIDE) {
            trace_rays rays;
            set_rays(s, pixels->x + i, pixels->y + j, pixels->width - i, pixels->height - j, &rays);
            find_square(view, pixels->x + i, pixels->y + j, &rays, &triangle, s, tile, &count);
        }
    return count;
}

void cpu_rays_light(const cpu_view *view, const render_rectangle *pixels,
                    const render_surfaces *s) {
    for (int j = 0; j < pixels->height; j += SIDE)
        for (int i = 0; i < pixels->width; i += SIDE)
            light_square(view, pixels->x + i, pixels->y + j, pixels->width - i, pixels->height - j,
                         s);
}
