/* SPDX-License-Identifier: MIT */
/* rays.h - the surfaces that the rays of a camera meet. */
#ifndef LAMPION_CPU_RAYS_H
#define LAMPION_CPU_RAYS_H

#include "app/render/cpu/texture.h"
#include "app/render/frame/surfaces.h"
#include "app/trace/spheres.h"

/* Of a frame's samples: the scene as rays meet it, and lights that are seen. */
typedef struct cpu_view {
    const scene *scene;
    const trace_bvh *bvh;
    const cpu_textures *textures;
    const trace_spheres *lights; /* by their numbers; NULL: none */
} cpu_view;

/* The lights of a frame that are drawn; *lights becomes NULL where there are none. False without
 * memory. */
bool cpu_lights_create(const render_frame *frame, const trace_bvh *bvh, trace_spheres **lights);

/* Fills the planes of a rectangle, from any thread: a sample of each pixel, by surfaces->camera.
 * first: NULL, or the first sample's planes of the same pixels (app/render/cpu/shared.h). */
void cpu_rays_fill(const cpu_view *view, const render_rectangle *pixels,
                   const render_surfaces *first, const render_surfaces *surfaces);

/* Finds the lights again that are seen before triangles: of planes that were filled for the same
 * camera and keep their hits. */
void cpu_rays_light(const cpu_view *view, const render_rectangle *pixels,
                    const render_surfaces *surfaces);

#endif
