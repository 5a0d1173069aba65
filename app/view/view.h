/* SPDX-License-Identifier: MIT */
/* view.h - the viewer (docs/viewer.md), and its images without a window. */
#ifndef LAMPION_VIEW_H
#define LAMPION_VIEW_H

#include "app/view/settings.h"

typedef struct view_options {
    view_settings settings; /* lights aside: those are the scene's */
    bool expose;            /* find the exposure; then times settings.exposure */
    bool keep_lights;       /* the lights of settings, not the scene's */
    bool shadows_chosen;    /* settings.shadows counts; else what suits scene and device */
    scene_lights_options lights;
    environment_options environment; /* with keep_lights that of settings */
    scene_options load;
    scene_camera_options camera; /* where camera_wanted; else settings.camera */
    bool camera_wanted;
    const char *animate, *script, *record, *state; /* or NULL */
    float fps;                                     /* of a script and of recordings */
    int frames;                                    /* to show, then quit; 0: no limit */
} view_options;

/* Opens the window and returns when it is closed. */
bool view_run(const view_options *options, cli_error *error);

/* The image of these settings without a window, to a .png with the settings in it.
 * device: as gpu_context_create takes it. */
bool view_render(view_settings *settings, const char *device, const char *path, cli_error *error);

#endif
