/* SPDX-License-Identifier: MIT */
/* rays.h - finding the surfaces that a camera's rays meet. */
#ifndef LAMPION_RENDER_CPU_RAYS_H
#define LAMPION_RENDER_CPU_RAYS_H

#include "app/render/cpu/texture.h"
#include "app/render/surfaces.h"
#include "app/scene/trace/lamps.h"

/* What the samples of a frame share: the scene's tree, and the visible lights. */
typedef struct cpu_view {
    const scene *scene;
    const trace_bvh *bvh;
    const cpu_textures *textures;
    const trace_lamps *lights; /* by their numbers; NULL if none is visible */
} cpu_view;

/* Collects the lights of a frame that are drawn; *lights becomes NULL if there are none. Returns
 * false if memory ran out. */
bool cpu_lights_create(const render_frame *frame, const trace_bvh *bvh, trace_lamps **lights);

/* Fills the planes of a rectangle with a sample of each pixel, by surfaces->camera; may be called
 * from any thread. first: NULL, or the first sample's planes of the same pixels
 * (app/render/cpu/shared.h). */
void cpu_rays_fill(const cpu_view *view, const render_rectangle *pixels,
                   const render_surfaces *first, const render_surfaces *surfaces);

/* Do so in two steps, in a scene without blended surfaces: cpu_rays_find keeps the hits in
 * surfaces->hits, and returns the number of surfaces, whose positions the tile receives one after
 * another, lights aside; cpu_rays_fill_found fills the planes from the hits. */
size_t cpu_rays_find(const cpu_view *view, const render_rectangle *pixels,
                     const render_surfaces *surfaces, render_tile *tile);
void cpu_rays_fill_found(const cpu_view *view, const render_rectangle *pixels,
                         const render_surfaces *surfaces);

/* Finds the lights again in planes that were filled for the same camera and keep their hits. */
void cpu_rays_light(const cpu_view *view, const render_rectangle *pixels,
                    const render_surfaces *surfaces);

#endif
