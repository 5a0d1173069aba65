/* SPDX-License-Identifier: MIT */
/* renderer.h - a scene drawn on a device: by OpenGL, or on all cores without it. */
#ifndef LAMPION_RENDERER_H
#define LAMPION_RENDERER_H

#include "app/render/cpu/cpu.h"
#include "app/render/gl/gpu.h"

/* --- where --------------------------------------------------------------------------------------
 */

/* Whether this machine seems to have a GPU that OpenGL could use; asks no driver. */
bool render_finds_gpu(void);

/* A device that holds a scene: DEVICE_GPU or DEVICE_CPU. */
typedef struct render_device {
    device_kind kind;
    const scene *scene;
    char name[128], driver[128]; /* of the GPU or CPU, and of what draws by it */
    gpu_context gl;              /* of DEVICE_GPU */
    bool adopted;                /* gl belongs to a window */
    cpu_scene *cpu;              /* of DEVICE_CPU */
    trace_bvh *bvh;              /* of DEVICE_GPU, once something asks for it */
} render_device;

/* Opens DEVICE_CPU, or DEVICE_GPU on what `gl_device` names (gpu_context_create). The scene must
 * outlive it. False with one line in *error: the device is zero then. */
bool render_device_open(device_kind kind, const char *gl_device, const scene *scene,
                        render_device *device, cli_error *error);

/* DEVICE_GPU by a window's context. */
void render_device_adopt(const gpu_context *context, const scene *scene, render_device *device);
void render_device_close(render_device *device);

/* The scene's tree for rays, made when it is first asked for. NULL without memory. */
const trace_bvh *render_device_bvh(render_device *device);

/* Bytes that a field's nodes may take on it; 0: any. */
size_t render_device_field_bytes(const render_device *device);

/* By which frames on it are timed: "wall clock" or "timer queries". */
const char *render_device_clock(const render_device *device);

/* --- the renderer ----------------------------------------------------------------------------- */

/* One of both. */
typedef struct any_renderer {
    gpu_renderer *gl;
    cpu_renderer *cpu;
} any_renderer;

/* The device must outlive it. NULL on failure. */
any_renderer *renderer_create(const render_device *device, cli_error *error);
void renderer_destroy(any_renderer *renderer);

/* Whether tables of which so much is known fit a frame of the method, before they are made. */
bool renderer_tables_fit(const any_renderer *renderer, method_kind method,
                         const lmp_brdf_table_info *tables, int count, cli_error *error);

/* Shades materials of the scene by tables instead, as render_materials_set_tables has it, and by
 * preintegrated ones of theirs, or NULL. On the GPU tables are shaded by the method of coefficients
 * whatever the frame's is, unless they are preintegrated. */
bool renderer_set_tables(any_renderer *renderer, const lmp_brdf_table *const *tables, int count,
                         const int *uses, cli_error *error);
void renderer_set_brdfs(any_renderer *renderer, const lmp_preintegrated_brdf *const *brdfs);

/* The tables of white fibers (lmp_fibers) by which the sheen of materials is drawn, or NULL: none
 * is. They must outlive the renderer. */
void renderer_set_fibers(any_renderer *renderer, const lmp_brdf_table *const *white);

/* Ambient light from far away, whose coefficients environment_project has made, or NULL. It must
 * outlive the renderer. */
void renderer_set_environment(any_renderer *renderer, const environment *environment);

/* What a frame's exposure is found by: light that surfaces reflect, without shadows, lamps, what
 * glows and what is past everything, which is black. It is the same whether lights are seen, and
 * small, whatever the frame's size. *pixels is created. */
bool renderer_meter(any_renderer *renderer, const render_frame *frame, image *pixels,
                    cli_error *error);

/* Renders all samples into the renderer's image. times may be NULL. */
bool renderer_draw(any_renderer *renderer, const render_frame *frame, render_times *times,
                   cli_error *error);

/* Sample `index` alone of frame->samples: after it the image is the mean of all so far. With index
 * 0, 1, … of the same frame, the last leaves what renderer_draw does. */
bool renderer_refine(any_renderer *renderer, const render_frame *frame, int index,
                     render_times *times, cli_error *error);

/* The image, tone-mapped, into 8-bit RGB of 3 * width * height bytes, rows from the top; and
 * linear: *image is created. */
bool renderer_read_rgb8(any_renderer *renderer, const image_display *display, unsigned char *rgb8,
                        render_times *times, cli_error *error);
bool renderer_read_image(any_renderer *renderer, image *image, cli_error *error);

/* Copies the image, tone-mapped, as a window's `side`, 0 or 1. False without memory. */
bool renderer_show(any_renderer *renderer, gpu_screen *screen, int side,
                   const image_display *display);

#endif
