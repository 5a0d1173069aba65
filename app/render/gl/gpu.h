/* SPDX-License-Identifier: MIT */
/* gpu.h - drawing a scene with OpenGL 4.5: a small G-buffer, then one compute pass that shades
 * every pixel through spherical harmonics.
 *
 * The context knows the device; the renderer knows a scene and lives in whatever context is
 * current, be it gpu_context's own or a window's. Images have row 0 at the top. */
#ifndef LAMPION_GPU_H
#define LAMPION_GPU_H

#include "app/file/embedded.h"
#include "app/image/image.h"
#include "app/render/frame/surfaces.h"

#include <lampion/field.h>

#define GPU_SIZE_MAX 16384 /* pixels a side */

/* Lights of a frame that shaders sum on llvmpipe, which ends the loops of a shader after 65535
 * turns in all: one for each light and again for each of a coat, and some for the surroundings. */
#define GPU_SOFTWARE_LIGHTS_MAX 32000

/* --- the device ------------------------------------------------------------------------------- */

typedef struct gpu_context {
    void *display, *context; /* EGL's; NULL when adopted */
    char device[128], driver[128];
    bool software;        /* no hardware behind it: timer queries mean nothing */
    int size_max;         /* of a texture's side */
    size_t storage_max;   /* bytes that shaders read of one buffer */
    bool computes_fields; /* where it is faster than the library: not on software */
} gpu_context;

/* A context without a window, current on return. device: NULL takes the first hardware device, else
 * software; "software"; a number in EGL's list of devices, from 0; or a part of a device's name.
 *
 * Errors name what was found and the Debian package that is missing. The environment variable
 * LAMPION_GL_DEBUG=fatal makes OpenGL check every call and abort on the first complaint. */
bool gpu_context_create(const char *device, gpu_context *context, cli_error *error);
void gpu_context_destroy(gpu_context *context);

/* Fills *context for the context that is current (a window's). */
bool gpu_context_adopt(gpu_context *context, cli_error *error);

/* --- a scene on the device -------------------------------------------------------------------- */

/* Bytes of the table of METHOD_READS_TABULATED_Z. */
size_t gpu_zonal_bytes(int bands);

/* How many lights a frame may have: where shaders sum them on software, fewer. */
size_t gpu_lights_max(const gpu_context *context, const render_frame *frame);

typedef struct gpu_renderer gpu_renderer;

/* Uploads the scene, which may be freed afterwards. NULL on failure. */
gpu_renderer *gpu_renderer_create(const gpu_context *context, const scene *scene, cli_error *error);
void gpu_renderer_destroy(gpu_renderer *renderer);

/* As render_materials_set_tables. They are shaded by the method of coefficients whatever the
 * frame's is, unless gpu_set_preintegrated_brdfs says more. */
bool gpu_set_tables(gpu_renderer *renderer, const lmp_brdf_table *const *tables, int count,
                    const int *uses, cli_error *error);

/* Whether tables of which so much is known fit a frame of the method, before they are made: if not,
 * they will not fit once they are. */
bool gpu_tables_fit(const gpu_renderer *renderer, method_kind method,
                    const lmp_brdf_table_info *tables, int count, cli_error *error);

/* After gpu_set_tables: brdfs[i] of table i, or NULL, for methods that read them.
 * They must outlive the renderer. */
void gpu_set_preintegrated_brdfs(gpu_renderer *renderer,
                                 const lmp_preintegrated_brdf *const *brdfs);

/* The tables of white fibers (lmp_fibers) by which the sheen of materials is drawn, or NULL: none
 * is. They must outlive the renderer. */
void gpu_set_fibers(gpu_renderer *renderer, const lmp_brdf_table *const *white);

/* Ambient light from far away, whose coefficients environment_project has made, or NULL. It must
 * outlive the renderer. Tabulated materials reflect it on the host alone. */
void gpu_set_environment(gpu_renderer *renderer, const environment *environment);

/* Renders into the renderer's HDR target; compiles shaders on the first use of a method, a number
 * of bands and a window. times may be NULL, and then nothing waits for the device. */
bool gpu_render(gpu_renderer *renderer, const render_frame *frame, render_times *times,
                cli_error *error);

/* Sample `index` alone of frame->samples: after it the HDR target holds the mean of all so far.
 * With index 0, 1, … of the same frame, the last leaves what gpu_render does. */
bool gpu_refine(gpu_renderer *renderer, const render_frame *frame, int index, render_times *times,
                cli_error *error);

/* Draws the HDR target, tone-mapped, into framebuffer 0's window or another of the same size. */
void gpu_present(gpu_renderer *renderer, unsigned framebuffer, const image_display *display,
                 bool rows_from_top);

/* The same into 8-bit RGB of 3 * width * height bytes, rows from the top. */
bool gpu_read_rgb8(gpu_renderer *renderer, const image_display *display, unsigned char *rgb8,
                   render_times *times, cli_error *error);

/* The HDR target, linear; *image is created. */
bool gpu_read_image(gpu_renderer *renderer, image *image, cli_error *error);

/* --- a window's image ------------------------------------------------------------------------- */

/* One image, two side by side with a divider between them, or how they differ; drawings over it.
 */
typedef struct gpu_screen gpu_screen;
gpu_screen *gpu_screen_create(cli_error *error);
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
    float divider; /* its position: a part of the width */
    float line;    /* its width in pixels; 0: not drawn */
} gpu_layout;

/* Into framebuffer 0's window, or into 8-bit RGB of 3 * width * height bytes, rows from the top. */
void gpu_screen_show(gpu_screen *screen, const gpu_layout *layout);
bool gpu_screen_read(gpu_screen *screen, const gpu_layout *layout, unsigned char *rgb8,
                     cli_error *error);

/* Uploads a drawing: rows from the top, premultiplied BGRA as Cairo's ARGB32 is on this machine. */
#define GPU_DRAWINGS_MAX 8
void gpu_screen_upload(gpu_screen *screen, int drawing, int width, int height, const void *pixels);

/* Draws it over framebuffer 0's window of layout's size, its upper left corner at x, y. */
void gpu_screen_draw(gpu_screen *screen, const gpu_layout *layout, int drawing, int x, int y);

/* Whether the device has lost the current context: everything in it is gone then. */
bool gpu_context_lost(void);

/* --- what the shaders see --------------------------------------------------------------------- */

/* A pixel: radiance = emission + what lmp_shade gives for surface and material (kind SURFACE), or
 * emission alone. */
typedef struct render_pixel {
    render_kind kind;
    lmp_surface surface;
    lmp_material material;
    lmp_rgb emission;
    float ambient; /* how much of the environment's light comes: the occlusion map */
} render_pixel;

/* The pixels of the last frame (of its last sample), positions and materials just as the shaders
 * evaluate them.
 *
 * *pixels receives width * height entries, rows from the top; free() it. */
bool gpu_read_pixels(gpu_renderer *renderer, render_pixel **pixels, cli_error *error);

/* --- sources ---------------------------------------------------------------------------------- */

extern const embedded_file gpu_sources[]; /* the files of shaders/, ended by a NULL name */

#endif
