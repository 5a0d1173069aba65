/* SPDX-License-Identifier: MIT */
/* compositor.h - draws settings: one side or two, coarse or fine. */
#ifndef LAMPION_VIEW_COMPOSITOR_H
#define LAMPION_VIEW_COMPOSITOR_H

#include "app/view/compose.h"
#include "app/view/tree.h"
#include "app/view/work.h"

typedef struct view_compositor view_compositor;

/* Whether the CPU can draw everything in the settings, so that OpenGL is not needed. */
bool view_compositor_does_without(const view_settings *settings);

/* Makes a compositor in the current context, or without OpenGL if context is NULL: then nothing can
 * be shown, and settings that require OpenGL cannot be drawn. The scene and its tree must outlive
 * the compositor; without a tree, NULL, it builds one when it needs it. What needs no OpenGL is
 * done by `work`, or NULL: while one waits. Returns NULL on failure. */
view_compositor *view_compositor_create(const gpu_context *context, const scene *world,
                                        view_tree *tree, view_work *work, base_error *error);
void view_compositor_destroy(view_compositor *compositor);

/* Shows what another one, in the same context, shows, until something is drawn. */
void view_compositor_inherit(view_compositor *compositor, view_compositor *before);

/* Milliseconds of the passes of the last image, of both sides together. */
typedef struct view_statistics {
    render_times times;
    int width, height;
    device_kind device; /* of the first side */
} view_statistics;

/* Returns a message about slow work that must precede drawing these settings, or NULL. */
const char *view_compositor_pending(view_compositor *compositor, const view_settings *settings);

/* Whether the tables of the settings' materials will fit the devices: otherwise drawing these
 * settings fails at once, so making the tables would be in vain. */
bool view_compositor_fits(view_compositor *compositor, const view_settings *settings);

/* Draws. With a divisor of 1, sample `index` of settings->samples is added to the earlier ones of
 * the same settings; -1: all of them are drawn. With a greater divisor the image is a preview of
 * 1 / `divisor` of width and height, with one sample, index 0, and, on software, fewer triangles.
 */
bool view_compositor_draw(view_compositor *compositor, const view_settings *settings, int divisor,
                          int index, view_statistics *statistics, base_error *error);

/* Determines the exposure that suits the settings. */
bool view_compositor_expose(view_compositor *compositor, const view_settings *settings,
                            float *exposure, base_error *error);

/* Splits the radiance of a pixel of a side, by what shades it there: its method, bands and
 * materials, on the CPU whatever the device. Shadows are those of many rays, without a filter. The
 * lights beyond settings->light_count are the environment's suns; split->lights has room for
 * SCENE_LIGHTS_MAX. *light_count receives how many there are. */
bool view_compositor_split(view_compositor *compositor, const view_settings *settings, int side,
                           int x, int y, cpu_split *split, size_t *light_count, base_error *error);

/* Returns the images of the sides that were drawn last, to be shown or written. */
const view_images *view_compositor_images(const view_compositor *compositor);

#endif
