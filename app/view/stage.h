/* SPDX-License-Identifier: MIT */
/* stage.h - draws settings in the context that is current: one side or two, coarse or fine. */
#ifndef LAMPION_VIEW_STAGE_H
#define LAMPION_VIEW_STAGE_H

#include "app/view/settings.h"

typedef struct view_stage view_stage;

/* The scene must outlive the stage. NULL on failure. */
view_stage *view_stage_create(const gpu_context *context, const scene *world, cli_error *error);
void view_stage_destroy(view_stage *stage);

/* Milliseconds of the passes of the image drawn last, both sides together. */
typedef struct view_figures {
    gpu_times times;
    int width, height;
    device_kind device; /* of the first side */
} view_figures;

/* What takes long before these settings can be drawn, for the user to read, or NULL. */
const char *view_stage_pending(view_stage *stage, const view_settings *settings);

/* Draws with all samples. */
bool view_stage_draw(view_stage *stage, const view_settings *settings, view_figures *figures,
                     cli_error *error);

/* Draws a part `divisor` of width and height with one sample and, on software, fewer triangles. */
bool view_stage_draft(view_stage *stage, const view_settings *settings, int divisor,
                      view_figures *figures, cli_error *error);

/* Adds sample `index` of settings->samples to those of the same settings before. */
bool view_stage_refine(view_stage *stage, const view_settings *settings, int index,
                       view_figures *figures, cli_error *error);

/* The exposure that suits the settings, automatically. */
bool view_stage_expose(view_stage *stage, const view_settings *settings, float *exposure,
                       cli_error *error);

/* What was drawn last: into the window, or as a screenshot. */
void view_stage_show(view_stage *stage, const view_settings *settings, float line);
bool view_stage_write(view_stage *stage, const view_settings *settings, const char *path,
                      cli_error *error);

/* For drawings over it. */
gpu_screen *view_stage_screen(view_stage *stage);

#endif
