/* SPDX-License-Identifier: MIT */
/* view.h - the viewer (docs/viewer.md), and the rendering of its images without a window. */
#ifndef LAMPION_VIEW_VIEW_H
#define LAMPION_VIEW_VIEW_H

#include "app/view/settings.h"

typedef struct view_options {
    view_settings settings; /* its lights are replaced by the scene's, unless keep_lights */
    bool expose;            /* determine the exposure, and multiply it by settings.exposure */
    bool keep_lights;       /* use the lights of settings instead of the scene's */
    bool shadows_chosen;    /* settings.shadows was chosen; else it depends on scene and device */
    scene_lights_options lights;
    environment_options environment; /* with keep_lights, that of settings is used instead */
    scene_options load;
    scene_camera_options camera; /* used if camera_wanted; else settings.camera */
    bool camera_wanted;
    const char *animate, *script, *record, *state; /* files or names, or NULL */
    float fps;                                     /* of a script and of recordings */
    int frames;                                    /* to show before quitting; 0: no limit */
} view_options;

/* Opens the window and returns when it is closed. */
bool view_run(const view_options *options, base_error *error);

/* Renders these settings without a window, to a .png file that also stores the settings. `device`
 * is that of gpu_context_create. */
bool view_render(view_settings *settings, const char *device, const char *path, base_error *error);

#endif
