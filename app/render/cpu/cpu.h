/* SPDX-License-Identifier: MIT */
/* cpu.h - drawing a scene on all cores, without OpenGL: rays find the surfaces, the library shades
 * them. An image has the same bytes on every machine, for any number of threads. */
#ifndef LAMPION_RENDER_CPU_CPU_H
#define LAMPION_RENDER_CPU_CPU_H

#include "app/image/image.h"
#include "app/render/cpu/split.h"
#include "app/render/surfaces.h"
#include "app/scene/trace/trace.h"

/* The tree of a scene and the levels of its textures, which renderers share. */
typedef struct cpu_scene cpu_scene;

/* Prepares a scene, which must outlive the result, as must its tree, unless this is NULL and is
 * built here; returns NULL on failure. */
cpu_scene *cpu_scene_create(const scene *scene, const trace_bvh *bvh, base_error *error);
void cpu_scene_destroy(cpu_scene *world);
const trace_bvh *cpu_scene_bvh(const cpu_scene *world);

typedef struct cpu_renderer cpu_renderer;

/* Makes a renderer of a scene, which must outlive it; returns NULL on failure. */
cpu_renderer *cpu_renderer_create(const cpu_scene *world, base_error *error);
void cpu_renderer_destroy(cpu_renderer *renderer);

/* Returns the materials that the renderer shades with; materials.h has functions to change them. */
render_materials *cpu_renderer_materials(cpu_renderer *renderer);

/* Sets the environment, whose coefficients environment_project has made, or NULL for none. It must
 * outlive the renderer. */
void cpu_set_environment(cpu_renderer *renderer, const environment *environment);

/* Draws samples 0 to count - 1 of frame->samples; the image is their mean. */
bool cpu_render(cpu_renderer *renderer, const render_frame *frame, int count, render_times *times,
                base_error *error);

/* Draws sample `index` alone, after those before it; the image is the mean of all so far. */
bool cpu_refine(cpu_renderer *renderer, const render_frame *frame, int index, render_times *times,
                base_error *error);

/* Splits the radiance of a pixel of a frame of one sample, by the sums that shade it. The sum of
 * all is the pixel's; lights whose truncated series ring may have parts below 0, which count less
 * where shading clamps. `around` casts the shadows of the environment's light, frame->shadow those
 * of lights; both may be zero, and work tile by tile. */
bool cpu_split_pixel(cpu_renderer *renderer, const render_frame *frame, int x, int y,
                     const render_pass *around, cpu_split *split, base_error *error);

/* Returns the linear image that was drawn; the renderer owns it. */
const image *cpu_image(const cpu_renderer *renderer);

#endif
