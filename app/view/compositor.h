/* SPDX-License-Identifier: MIT */
/* compositor.h - draws settings: one side or two, coarse or fine. */
#ifndef LAMPION_VIEW_COMPOSITOR_H
#define LAMPION_VIEW_COMPOSITOR_H

#include "app/view/settings.h"

typedef struct view_compositor view_compositor;

/* Whether the CPU can draw all of it, and so no OpenGL is needed. */
bool view_compositor_does_without(const view_settings *settings);

/* In the context that is current, or without OpenGL for NULL: then nothing can be shown, and what
 * does not do without it cannot be drawn. The scene must outlive the compositor. NULL on failure.
 */
view_compositor *view_compositor_create(const gpu_context *context, const scene *world,
                                        cli_error *error);
void view_compositor_destroy(view_compositor *compositor);

/* Milliseconds of the passes of the image drawn last, both sides together. */
typedef struct view_statistics {
    render_times times;
    int width, height;
    device_kind device; /* of the first side */
} view_statistics;

/* What takes long before these settings can be drawn, for the user to read, or NULL. */
const char *view_compositor_pending(view_compositor *compositor, const view_settings *settings);

/* Draws with all samples. */
bool view_compositor_draw(view_compositor *compositor, const view_settings *settings,
                          view_statistics *statistics, cli_error *error);

/* Draws a part `divisor` of width and height with one sample and, on software, fewer triangles. */
bool view_compositor_draft(view_compositor *compositor, const view_settings *settings, int divisor,
                           view_statistics *statistics, cli_error *error);

/* Adds sample `index` of settings->samples to those of the same settings before. */
bool view_compositor_refine(view_compositor *compositor, const view_settings *settings, int index,
                            view_statistics *statistics, cli_error *error);

/* The exposure that suits the settings, automatically. */
bool view_compositor_expose(view_compositor *compositor, const view_settings *settings,
                            float *exposure, cli_error *error);

/* What was drawn last: into the window, or as a screenshot. */
void view_compositor_show(view_compositor *compositor, const view_settings *settings, float line);
bool view_compositor_write(view_compositor *compositor, const view_settings *settings,
                           const char *path, cli_error *error);

/* For drawings over it; NULL without OpenGL. */
gpu_screen *view_compositor_screen(view_compositor *compositor);

#endif
