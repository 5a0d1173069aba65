/* SPDX-License-Identifier: MIT */
/* renderer.h - a scene drawn on a device: by OpenGL, or on all cores without it. */
#ifndef LAMPION_RENDER_RENDERER_RENDERER_H
#define LAMPION_RENDER_RENDERER_RENDERER_H

#include "app/render/cpu/cpu.h"
#include "app/render/gl/gpu.h"

/* --- devices ---------------------------------------------------------------------------------- */

/* Whether this machine seems to have a GPU that OpenGL could use; asks no driver. */
bool render_finds_gpu(void);

/* A device that holds a scene: DEVICE_GPU or DEVICE_CPU. */
typedef struct render_device {
    device_kind kind;
    const scene *scene;
    char name[128], driver[128]; /* of the GPU or CPU, and of the software that draws on it */
    gpu_context gl;              /* of DEVICE_GPU */
    bool adopted;                /* whether gl belongs to a window */
    cpu_scene *cpu;              /* of DEVICE_CPU */
    trace_bvh *bvh;              /* of DEVICE_GPU, once it is requested */
    const trace_bvh *lent;       /* to DEVICE_GPU in its place, or NULL */
} render_device;

/* Opens DEVICE_CPU, or the DEVICE_GPU that `gl_device` names (gpu_context_create). The scene must
 * outlive it; a DEVICE_GPU that is only looked at needs none. On failure returns false with one
 * line in *error; the device is then zero. */
bool render_device_open(device_kind kind, const char *gl_device, const scene *scene,
                        render_device *device, base_error *error);

/* Opens DEVICE_CPU with the scene's tree, which must outlive it, as must the scene; NULL means
 * a tree of its own. */
bool render_device_open_cpu(const scene *scene, const trace_bvh *bvh, render_device *device,
                            base_error *error);

/* Makes a DEVICE_GPU of a window's context. */
void render_device_adopt(const gpu_context *context, const scene *scene, render_device *device);
void render_device_close(render_device *device);

/* Lets a DEVICE_GPU cast rays by the scene's tree, which must outlive it, instead of its own. */
void render_device_lend(render_device *device, const trace_bvh *bvh);

/* Returns the scene's tree for rays, built on the first request; NULL if memory ran out. */
const trace_bvh *render_device_bvh(render_device *device);

/* Returns the bytes that a field's nodes may take on the device; 0: no limit. */
size_t render_device_field_bytes(const render_device *device);

/* Returns how frames are timed on the device: "wall clock" or "timer queries". */
const char *render_device_clock(const render_device *device);

/* --- the renderer ----------------------------------------------------------------------------- */

/* Finds a frame's samples_exposure in the light that its surfaces reflect (renderer_meter). */
typedef struct render_meter {
    float (*run)(void *user, const image *pixels);
    void *user;
} render_meter;

/* A renderer on either device. */
typedef struct any_renderer {
    gpu_renderer *gl;
    cpu_renderer *cpu;
    render_meter meter;
} any_renderer;

/* Makes a renderer on a device, which must outlive it; returns NULL on failure. */
any_renderer *renderer_create(const render_device *device, base_error *error);
void renderer_destroy(any_renderer *renderer);

/* Checks before tables are made whether tables with these properties fit a frame of the method. */
bool renderer_tables_fit(const any_renderer *renderer, method_kind method,
                         const lmp_brdf_table_info *tables, int count, base_error *error);

/* Replaces materials of the scene by tables, as render_materials_set_tables does, and these by
 * their preintegrated BRDFs, or NULL. On the GPU tables are shaded by the method of coefficients,
 * whatever the frame's method, unless they are preintegrated. */
bool renderer_set_tables(any_renderer *renderer, const lmp_brdf_table *const *tables, int count,
                         const int *uses, base_error *error);
void renderer_set_brdfs(any_renderer *renderer, const lmp_preintegrated_brdf *const *brdfs);

/* Sets the tables of white sheen (lmp_sheen_layer) by which sheen is drawn, or NULL to draw none.
 * They must outlive the renderer; their array need not. */
void renderer_set_sheen(any_renderer *renderer, const lmp_brdf_table *const *white);

/* Sets the environment, whose coefficients environment_project has made, or NULL for none. It must
 * outlive the renderer. */
void renderer_set_environment(any_renderer *renderer, const environment *environment);

/* Renders the image from which a frame's exposure is determined: light that surfaces reflect, after
 * bounces as well, without shadows of direct light, lamps and emission; the background is black. It
 * does not depend on whether lights are visible, and is small, whatever the frame's size. *pixels
 * is created. */
bool renderer_meter(any_renderer *renderer, const render_frame *frame, image *pixels,
                    base_error *error);

/* Sets what renderer_draw runs before the samples of a frame, or zero for nothing: the frame's own
 * samples_exposure. */
void renderer_set_meter(any_renderer *renderer, render_meter meter);

/* Renders all samples into the renderer's image. times may be NULL. */
bool renderer_draw(any_renderer *renderer, const render_frame *frame, render_times *times,
                   base_error *error);

/* Renders sample `index` alone of frame->samples: the image is then the mean of all so far. With
 * index 0, 1, … of the same frame, the result is that of renderer_draw. */
bool renderer_refine(any_renderer *renderer, const render_frame *frame, int index,
                     render_times *times, base_error *error);

/* Splits a pixel as cpu_split_pixel does; the renderer must be one on DEVICE_CPU. */
bool renderer_split(any_renderer *renderer, const render_frame *frame, int x, int y,
                    const render_pass *around, cpu_split *split, base_error *error);

/* Read the image, tone-mapped, to 8-bit RGB of 3 * width * height bytes, rows from the top; and
 * linear, in which case *image is created. */
bool renderer_read_rgb8(any_renderer *renderer, const image_display *display, unsigned char *rgb8,
                        render_times *times, base_error *error);
bool renderer_read_image(any_renderer *renderer, image *image, base_error *error);

#endif
