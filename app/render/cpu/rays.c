/* SPDX-License-Identifier: MIT */
#include "app/render/cpu/rays.h"

#include "app/render/cpu/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool cpu_lights_create(const render_frame *frame, const trace_bvh *bvh, trace_spheres **lights) {
    trace_sphere *drawn = malloc((frame->light_count + 1) * sizeof *drawn);
    size_t count = 0;
    *lights = NULL;
    if (!drawn)
        return false;
    for (size_t i = 0; i < frame->light_count; i++) {
        const lmp_light *e = &frame->lights[i].emitter;
        if (!scene_light_is_drawn(&frame->lights[i]))
            continue;
        drawn[count++] = (trace_sphere) { .center = { e->position.x, e->position.y, e->position.z },
                                          .radius = e->radius,
                                          .number = (uint32_t)i };
    }
    if (count > 0)
        *lights = trace_spheres_create(bvh, drawn, count);
    free(drawn);
    return count == 0 || *lights;
}

/* Rays side by side are a square of pixels: two halves of 4 by 2, the packets of half the width. */
enum { SIDE = 4 };

/* Of the pixels of a square as far as it lies in the rectangle that ends after so many. */
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
    /* those past the edge are none, but have a direction like their neighbors' */
    render_camera_rays(c, columns, rows, TRACE_LANES, origin, direction);
    rays->sample = (uint32_t)c->sample;
    rays->samples = (uint32_t)c->samples;
    for (int i = 0; i < TRACE_LANES; i++) {
        const bool inside = i % SIDE < width && i / SIDE < height;
        rays->start[i] = c->parallel ? 0 : c->near;
        rays->length[i] = inside ? c->far : -1;
        rays->pixel[i] = (uint32_t)columns[i] * 1664525u + (uint32_t)rows[i] * 1013904223u;
    }
}

/* Lights are seen where they are before what the rays have hit. */
static void see_lights(const cpu_view *view, int x, int y, const trace_rays *rays,
                       trace_hit hits[TRACE_LANES], const render_surfaces *s) {
    bool found[TRACE_LANES] = { false };
    if (view->lights)
        trace_spheres_nearest_n(view->lights, rays, found, hits);
    for (int i = 0; i < TRACE_LANES; i++)
        if (found[i])
            s->seen[render_surfaces_at(s, x + i % SIDE, y + i / SIDE)] =
                RENDER_SEES_LIGHT + hits[i].instance;
}

static void fill_square(const cpu_view *view, int x, int y, int width, int height,
                        const cpu_first *first, cpu_triangle *triangle, const render_surfaces *s) {
    trace_rays rays;
    trace_hit hits[TRACE_LANES];
    set_rays(s, x, y, width, height, &rays);
    trace_nearest_n(view->bvh, TRACE_IMAGE, &rays, hits);
    for (int i = 0; i < TRACE_LANES; i++) {
        if (rays.length[i] < 0)
            continue;
        const size_t at = render_surfaces_at(s, x + i % SIDE, y + i / SIDE);
        if (s->hits)
            s->hits[at] = hits[i];
        if (s->smooth)
            s->smooth[at] = 0;
        if (hits[i].instance == TRACE_NOTHING)
            s->seen[at] = RENDER_SEES_NOTHING;
        else {
            cpu_triangle_find(view->scene, &hits[i], triangle);
            const float direction[3] = { rays.direction[0][i], rays.direction[1][i],
                                         rays.direction[2][i] };
            cpu_surface_fill(view->textures, triangle, direction, &hits[i], first, at, s);
        }
    }
    see_lights(view, x, y, &rays, hits, s);
}

/* What the triangles of a square show, and the lights before them, by the hits that were kept. */
static void light_square(const cpu_view *view, int x, int y, int width, int height,
                         const render_surfaces *s) {
    trace_rays rays;
    trace_hit hits[TRACE_LANES];
    set_rays(s, x, y, width, height, &rays);
    for (int i = 0; i < TRACE_LANES; i++) {
        hits[i] = trace_miss();
        if (rays.length[i] < 0)
            continue;
        const size_t at = render_surfaces_at(s, x + i % SIDE, y + i / SIDE);
        hits[i] = s->hits[at];
        s->seen[at] = hits[i].instance == TRACE_NOTHING
                          ? RENDER_SEES_NOTHING
                          : scene_instance_material(view->scene, hits[i].instance);
    }
    see_lights(view, x, y, &rays, hits, s);
}

void cpu_rays_fill(const cpu_view *view, const render_rectangle *pixels,
                   const render_surfaces *first, const render_surfaces *s) {
    const cpu_first before = { first, render_nearness_of(&s->camera) };
    cpu_triangle triangle = { .material = NULL };
    for (int j = 0; j < pixels->height; j += SIDE)
        for (int i = 0; i < pixels->width; i += SIDE)
            fill_square(view, pixels->x + i, pixels->y + j, pixels->width - i, pixels->height - j,
                        first ? &before : NULL, &triangle, s);
}

void cpu_rays_light(const cpu_view *view, const render_rectangle *pixels,
                    const render_surfaces *s) {
    for (int j = 0; j < pixels->height; j += SIDE)
        for (int i = 0; i < pixels->width; i += SIDE)
            light_square(view, pixels->x + i, pixels->y + j, pixels->width - i, pixels->height - j,
                         s);
}
