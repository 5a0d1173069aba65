/* SPDX-License-Identifier: MIT */
/* gpu.h - drawing a scene with OpenGL 4.5: a small G-buffer, then one compute pass that shades
 * every pixel through spherical harmonics.
 *
 * The context knows the device; the renderer knows a scene and lives in whatever context is
 * current, be it gpu_context's own or a window's. Images have row 0 at the top. */
#ifndef LAMPION_RENDER_GL_GPU_H
#define LAMPION_RENDER_GL_GPU_H

#include "app/base/embedded.h"
#include "app/render/surfaces.h"

#include <lampion/field.h>

#define GPU_SIZE_MAX 16384 /* pixels per side */

/* The most lights that shaders sum on llvmpipe, which ends a shader's loops after 65535 iterations
 * in all: there is one for each light, another for each light of a coat, and some for the
 * environment. */
#define GPU_SOFTWARE_LIGHTS_MAX 32000
#define GPU_SOFTWARE_AREA       200 /* lights that an area counts for: its nodes and edges */

/* --- the device ------------------------------------------------------------------------------- */

typedef struct gpu_context {
    void *display, *context; /* EGL's; NULL when adopted */
    char device[128], driver[128];
    bool software; /* whether it is a software implementation, whose timer queries mean nothing */
    int size_max;  /* largest side of a texture */
    size_t storage_max;   /* bytes of a buffer that shaders can read */
    bool computes_fields; /* where that is faster than on the CPU: not on software */
} gpu_context;

/* Creates a context without a window, current on return. device: NULL for the first hardware
 * device, else software; "software"; a number in EGL's list of devices, from 0; or a part of a
 * device's name.
 *
 * Errors name what was found and the Debian package that is missing. The environment variable
 * LAMPION_GL_DEBUG=fatal makes OpenGL check every call and abort on the first complaint. */
bool gpu_context_create(const char *device, gpu_context *context, base_error *error);
void gpu_context_destroy(gpu_context *context);

/* Fills *context for the context that is current (a window's). */
bool gpu_context_adopt(gpu_context *context, base_error *error);

/* --- a scene on the device -------------------------------------------------------------------- */

/* Returns the bytes of the table of METHOD_READS_TABULATED_Z. */
size_t gpu_zonal_bytes(int bands);

/* Returns how many lights a frame may have: fewer where shaders sum them on software. */
size_t gpu_lights_max(const gpu_context *context, const render_frame *frame);

typedef struct gpu_renderer gpu_renderer;

/* Uploads the scene, which may be freed afterwards; returns NULL on failure. */
gpu_renderer *gpu_renderer_create(const gpu_context *context, const scene *scene,
                                  base_error *error);
void gpu_renderer_destroy(gpu_renderer *renderer);

/* Sets tables as render_materials_set_tables does. They are shaded by the method of coefficients,
 * whatever the frame's method, unless gpu_set_preintegrated_brdfs follows. */
bool gpu_set_tables(gpu_renderer *renderer, const lmp_brdf_table *const *tables, int count,
                    const int *uses, base_error *error);

/* Checks before tables are made whether tables with these properties fit a frame of the method. */
bool gpu_tables_fit(const gpu_renderer *renderer, method_kind method,
                    const lmp_brdf_table_info *tables, int count, base_error *error);

/* Sets the preintegrated BRDFs after gpu_set_tables: brdfs[i] of table i, or NULL. They must
 * outlive the renderer. */
void gpu_set_preintegrated_brdfs(gpu_renderer *renderer,
                                 const lmp_preintegrated_brdf *const *brdfs);

/* Sets the tables of white sheen (lmp_sheen_layer) by which sheen is drawn, or NULL to draw none.
 * They must outlive the renderer. */
void gpu_set_sheen(gpu_renderer *renderer, const lmp_brdf_table *const *white);

/* Sets the environment, whose coefficients environment_project has made, or NULL for none. It must
 * outlive the renderer. Tabulated materials reflect it only when the CPU shades. */
void gpu_set_environment(gpu_renderer *renderer, const environment *environment);

/* Renders into the renderer's HDR target; compiles shaders on the first use of a method, a number
 * of bands and a window. If times is NULL, nothing waits for the device. */
bool gpu_render(gpu_renderer *renderer, const render_frame *frame, render_times *times,
                base_error *error);

/* Renders sample `index` alone of frame->samples: the HDR target then holds the mean of all so far.
 * With index 0, 1, … of the same frame, the result is that of gpu_render. */
bool gpu_refine(gpu_renderer *renderer, const render_frame *frame, int index, render_times *times,
                base_error *error);

/* Draws the HDR target, tone-mapped, into framebuffer 0's window or another of the same size. */
void gpu_present(gpu_renderer *renderer, unsigned framebuffer, const image_display *display,
                 bool rows_from_top);

/* Reads the HDR target, tone-mapped, to 8-bit RGB of 3 * width * height bytes, rows from the
 * top. */
bool gpu_read_rgb8(gpu_renderer *renderer, const image_display *display, unsigned char *rgb8,
                   render_times *times, base_error *error);

/* Reads the HDR target, linear; *image is created. */
bool gpu_read_image(gpu_renderer *renderer, image *image, base_error *error);

/* --- a window's image ------------------------------------------------------------------------- */

/* What a window shows: one image, two side by side with a divider between them, or their
 * difference. */
typedef struct gpu_screen gpu_screen;
gpu_screen *gpu_screen_create(base_error *error);
void gpu_screen_destroy(gpu_screen *screen);

/* Copies the renderer's image, tone-mapped, as the screen's `side`, 0 or 1. */
void gpu_screen_take(gpu_screen *screen, gpu_renderer *renderer, int side,
                     const image_display *display);

/* Copies 8-bit RGB, rows from the top, as the screen's `side`. */
void gpu_screen_put(gpu_screen *screen, int side, int width, int height, const unsigned char *rgb8);

typedef enum gpu_split {
    GPU_SPLIT_NONE,
    GPU_SPLIT_DIVIDED,
    GPU_SPLIT_DIFFERENCE,
    GPU_SPLITS
} gpu_split;
#define GPU_DIFFERENCE_GAIN 8 /* of the displayed values, black where they agree */

typedef struct gpu_layout {
    int width, height; /* pixels; sides of another size are scaled */
    gpu_split split;
    float divider; /* its position, as a fraction of the width */
    float line;    /* its width in pixels; 0: not drawn */
    int seen;      /* columns from the left that are shown, the others are dark; 0: all */
} gpu_layout;

/* Draws the screen into framebuffer 0's window, which stays bound to be drawn over, or reads it to
 * 8-bit RGB of 3 * width * height bytes, rows from the top. */
void gpu_screen_show(gpu_screen *screen, const gpu_layout *layout);
bool gpu_screen_read(gpu_screen *screen, const gpu_layout *layout, unsigned char *rgb8,
                     base_error *error);

/* Whether the device has lost the current context, and with it everything in it. */
bool gpu_context_lost(void);

/* --- what the shaders see --------------------------------------------------------------------- */

/* A pixel. Its radiance is emission + what lmp_shade gives for surface and material (kind SURFACE),
 * or emission alone. */
typedef struct render_pixel {
    render_kind kind;
    lmp_surface surface;
    lmp_material material;
    lmp_rgb emission;
    float ambient; /* fraction of the environment's light that arrives: the occlusion map */
} render_pixel;

/* Reads the pixels of the last frame (of its last sample), with positions and materials exactly as
 * the shaders evaluate them.
 *
 * *pixels receives width * height entries, rows from the top, to be freed. */
bool gpu_read_pixels(gpu_renderer *renderer, render_pixel **pixels, base_error *error);

/* --- sources ---------------------------------------------------------------------------------- */

extern const embedded_file gpu_sources[]; /* the files of shaders/, ended by a NULL name */

#endif
