/* SPDX-License-Identifier: MIT */
/* cpu.h - drawing a scene on all cores, without OpenGL: rays find the surfaces, the library lights
 * them. An image has the same bytes on every machine, for any number of threads. */
#ifndef LAMPION_RENDER_CPU_H
#define LAMPION_RENDER_CPU_H

#include "app/image/image.h"
#include "app/render/frame/surfaces.h"
#include "app/trace/trace.h"

/* A scene as rays meet it: its tree and the levels of its textures, which renderers share. */
typedef struct cpu_scene cpu_scene;

/* The scene must outlive it. NULL on failure. */
cpu_scene *cpu_scene_create(const scene *scene, cli_error *error);
void cpu_scene_destroy(cpu_scene *world);
const trace_bvh *cpu_scene_bvh(const cpu_scene *world);

typedef struct cpu_renderer cpu_renderer;

/* The scene must outlive it. NULL on failure. */
cpu_renderer *cpu_renderer_create(const cpu_scene *world, cli_error *error);
void cpu_renderer_destroy(cpu_renderer *renderer);

/* What materials are shaded by: materials.h says how to change it. */
render_materials *cpu_renderer_materials(cpu_renderer *renderer);

/* Ambient light, whose coefficients environment_project has made, or NULL. It must outlive the
 * renderer. */
void cpu_set_environment(cpu_renderer *renderer, const environment *environment);

/* Samples 0 to count - 1 of frame->samples, of which the image is the mean. */
bool cpu_render(cpu_renderer *renderer, const render_frame *frame, int count, render_times *times,
                cli_error *error);

/* Sample `index` alone, after those before it: the image is the mean of all so far. */
bool cpu_refine(cpu_renderer *renderer, const render_frame *frame, int index, render_times *times,
                cli_error *error);

/* What was drawn: linear, of the renderer. */
const image *cpu_image(const cpu_renderer *renderer);

#endif
