/* SPDX-License-Identifier: MIT */
/* viewer.h - what the parts of the running viewer share: its state machine, its window, and what is
 * on the screen. */
#ifndef LAMPION_VIEW_VIEWER_H
#define LAMPION_VIEW_VIEWER_H

#include "app/view/baking.h"
#include "app/view/compositor.h"
#include "app/view/script.h"
#include "app/view/state.h"
#include "app/view/view.h"
#include "app/view/window.h"

/* The version of a file. */
typedef struct version {
    long long seconds, nanoseconds, size;
} version;

/* A drawing on the screen, drawn again when what it says changes. */
typedef struct label {
    char text[VIEW_MESSAGE_SIZE];
    double scale;
    int width, height; /* of the drawing */
    int room;          /* it was made to fit */
} label;

/* What the drawings over an image show. */
typedef struct drawn_over {
    bool help, overlay, playing;
    int selected;
    view_panel panel;
    char message[VIEW_MESSAGE_SIZE];
    const char *announcement; /* in place of the message, or NULL */
} drawn_over;

typedef struct viewer {
    const view_options *options;
    view_state state;
    view_script script;
    size_t script_next;
    scene *world;
    gpu_context context;
    view_window *window;
    view_compositor *compositor;
    view_baking baking;
    view_settings *shown, *drawn, *good; /* now; on the screen; last that could be drawn */
    bool fresh;                          /* nothing of `drawn` is on the screen */
    int sample;                          /* of the refinement, on the screen; -1: a draft */
    int divisor;                         /* of the next draft */
    double changed_at, frame_seconds;    /* seconds: of the last change; a moving frame took */
    double slow_seconds; /* the frame before took, if it had the same size; else 0 */
    bool moves;          /* the camera, from the frame before to the one on the screen */
    double show_seconds; /* of these, scaling, drawing over it and the window */
    view_statistics statistics;
    version seen, candidate; /* of the scene file */
    bool another;            /* scene than that of the options: its lights are its own */
    double watched_at, panel_at, clock;
    int frame, recorded;
    char record[VIEW_PATH_SIZE];
    drawn_over over; /* the image on the screen */
    bool waiting;    /* for slow work that the screen has announced */
    label labels[GPU_DRAWINGS_MAX];
} viewer;

/* --- reload.c: the scene and its file --------------------------------------------------------- */

version view_version_of(const char *path);

/* A scene with the lights that are asked for; NULL on failure. */
scene *view_load_scene(const char *name, const scene_options *load,
                       const scene_lights_options *lights, cli_error *error);
void view_free_scene(scene *world);

/* The scene again, or another one. A scene that does not load leaves the one before. */
void view_reload(viewer *v);

/* The window's, by the scene. */
void view_show_title(viewer *v);

/* What surrounds the scene, by the options. */
bool view_choose_environment(viewer *v, cli_error *error);

/* Wishes to read the scene again once its file has changed and rests. */
void view_watch(viewer *v);

/* --- shots.c: files out ----------------------------------------------------------------------- */

/* A screenshot; of a script where path is given: then a failure ends the viewer. */
bool view_take_shot(viewer *v, const char *path, cli_error *error);

void view_toggle_recording(viewer *v);

/* The lights as they rest, into a file that --lights reads. */
void view_save_lights(viewer *v);

/* Without --record a failure only ends the recording. */
bool view_record_frame(viewer *v, cli_error *error);

/* What the program knows of itself, for tests and for the curious. */
bool view_write_state(viewer *v, cli_error *error);

/* --- labels.c: drawings over the image -------------------------------------------------------- */

/* announcement: a message in place of the state's own, or NULL. */
void view_draw_labels(viewer *v, const char *announcement);

/* --- frame.c ---------------------------------------------------------------------------------- */

/* Whether every frame takes a fixed step of time, so that the same script gives the same images. */
bool view_steps_time(const viewer *v);

/* Draws and shows what has changed, or refines what has not. *worked: whether there was anything to
 * show. */
bool view_draw_frame(viewer *v, bool *worked, cli_error *error);

/* Chooses the exposure that suits the image. */
bool view_expose(viewer *v, cli_error *error);

#endif
