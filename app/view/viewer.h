/* SPDX-License-Identifier: MIT */
/* viewer.h - what the parts of the running viewer share: its state machine, its window, and what is
 * on the screen. */
#ifndef LAMPION_VIEW_VIEWER_H
#define LAMPION_VIEW_VIEWER_H

#include "app/base/progress.h"
#include "app/view/baking.h"
#include "app/view/ball.h"
#include "app/view/compositor.h"
#include "app/view/script.h"
#include "app/view/state.h"
#include "app/view/view.h"
#include "app/view/window.h"
#include "app/view/work.h"

/* The version of a file, as its metadata tells it. */
typedef struct version {
    long long seconds, nanoseconds, size;
} version;

/* The statistics that are shown. */
typedef struct view_told {
    view_statistics statistics;
    double frame_seconds, show_seconds, at; /* at: when they were taken */
    int sample, samples;                    /* 0 samples: nothing was drawn yet */
} view_told;

/* The passes of an image, and the milliseconds that they took. */
enum { VIEW_PASSES = 6 };
typedef struct view_pass {
    const char *name;
    double ms;
} view_pass;

/* What the sidebar remembers. */
enum { VIEW_FRAMES_TOLD = 120 };
typedef struct view_sidebar {
    char find[64], find_node[64]; /* in the lists */
    int material;                 /* of the scene, the chosen one */
    view_ball ball;               /* of it */
    long node;                    /* the ones selected in the last frame: */
    int light;                    /* others were chosen elsewhere */
    float ms[VIEW_FRAMES_TOLD];   /* that the last frames took, oldest first */
} view_sidebar;

/* The scenes of this and earlier runs, the latest first. */
enum { VIEW_RECENT_MAX = 8 };
typedef struct view_recent {
    char scenes[VIEW_RECENT_MAX][VIEW_PATH_SIZE];
    int count;
} view_recent;

typedef struct viewer {
    const view_options *options;
    view_state state;
    view_script script;
    size_t script_next;
    scene *world, *part; /* the scene, and what is not hidden of it */
    view_tree *tree;     /* of that part */
    gpu_context context;
    view_window *window;
    view_work *work;
    view_compositor *compositor;
    view_baking baking;
    view_settings *shown, *drawn, *good; /* current; on the screen; the last that could be drawn */
    bool fresh;                          /* whether `drawn` is not on the screen yet */
    bool held;                           /* whether it is not refined, until it changes */
    bool draws, shoots,
        bakes;  /* whether `drawn` is in work, for the window or a file; its tables */
    bool loads; /* whether a scene is read */
    progress_watch loading;
    double load_began;                /* seconds, of timing_now */
    double began;                     /* seconds: when it was begun */
    int percent;                      /* of what is in work; 0 unless it is slow */
    int cancelled;                    /* images, in all */
    const char *announcement;         /* about it, or NULL */
    int sample;                       /* of the refinement on the screen; -1: a preview */
    int divisor;                      /* of the next preview */
    double changed_at, frame_seconds; /* seconds: of the last change; per moving frame */
    double slow_seconds;              /* of the frame before, if it had the same size; else 0 */
    bool moves;                       /* whether the camera moved between the last two frames */
    double show_seconds; /* part of these: scaling, drawings over the image, and the window */
    view_statistics statistics;
    view_told told;
    uint64_t laid, over; /* hashes of the interface's last frame, and of the one on the screen */
    double laid_at;      /* seconds: when the last frame was described */
    double uncovered;    /* width of the image beside the sidebar, in pixels */
    view_sidebar sidebar;
    view_recent recent;
    scene_camera opened_with; /* the camera that the scene was opened with */
    bool pointed;             /* whether the pointer moved since then */
    version seen, candidate;  /* of the scene file */
    bool another; /* whether the scene is not that of the options: it has its own lights */
    double watched_at, clock, passed_at; /* passed_at: by the window's clock */
    int frame, recorded;
    char record[VIEW_PATH_SIZE];
    bool waiting; /* whether slow work that was announced comes next */
} viewer;

/* Whether a person is in front of it, rather than a script or a recording. */
static inline bool view_is_interactive(const viewer *v) {
    return !v->options->script && !v->options->record;
}

/* --- reload.c: the scene and its file --------------------------------------------------------- */

version view_version_of(const char *path);

/* Loads a scene with the requested lights, beside the window if a person waits for it; returns NULL
 * on failure, or if it was cancelled. */
scene *view_load_scene(viewer *v, const char *name, const scene_options *load,
                       const scene_lights_options *lights, base_error *error);
void view_free_scene(scene *world);

/* Reloads the scene, or loads another one. If that fails, the current scene stays. */
void view_reload(viewer *v);

/* Hides what the settings hide, and nothing else. */
void view_change_part(viewer *v);

/* Sets the window's title from the scene. */
void view_show_title(viewer *v);

/* Chooses the environment by the options and the scene. */
bool view_choose_environment(viewer *v, base_error *error);

/* Requests a reload once the scene's file has changed and is no longer being written. */
void view_watch(viewer *v);

/* --- recent.c: what is remembered ------------------------------------------------------------- */

/* Notes that the scene was opened; the very first time a message says how to begin. */
void view_begin_session(viewer *v);

/* Remembers how the scene is left, if it is not as it was opened. */
void view_keep_session(const viewer *v);

/* Restores camera, lights, surroundings and exposure as they were left in an earlier run. */
void view_resume_session(viewer *v);

/* --- shots.c: files out ----------------------------------------------------------------------- */

/* Takes a screenshot. path: NULL, or the file of a script's shot, whose failure ends the viewer. */
bool view_take_shot(viewer *v, const char *path, base_error *error);

/* Takes a screenshot, and copies to the clipboard the command that makes the image of it. */
bool view_copy_command(viewer *v, base_error *error);

void view_toggle_recording(viewer *v);

/* Writes the lights at rest to a file that --lights reads, .json, or to a copy of the scene's glTF
 * file, .gltf or .glb. */
bool view_export(viewer *v, const char *path, base_error *error);

/* Does so under the next free name, of lights here or of a copy beside the scene. */
void view_export_lights(viewer *v);
void view_export_scene(viewer *v);

/* Records a frame; without --record a failure only ends the recording. */
bool view_record_frame(viewer *v, base_error *error);

/* Writes the state of the viewer, for tests and debugging. */
bool view_write_state(viewer *v, base_error *error);

/* --- labels.c: what is over the image --------------------------------------------------------- */

/* Describes a frame of the interface, whose hash is v->laid. announcement: a message in place of
 * the state's own, or NULL. fresh: whether the image is new. */
void view_lay_out(viewer *v, const char *announcement, bool fresh);

/* --- sidebar.c: the panel at the right, every action as a button under the help's headings ------
 */

#define VIEW_SIDEBAR_TITLE "Lampion"
enum { VIEW_SIDEBAR_WIDTH = 320 }; /* pixels at 96 per inch, or half of a narrower window */

/* Describes the sidebar, within a frame of the interface. Returns where it begins: the width of the
 * image that is not covered. */
double view_draw_sidebar(viewer *v);

/* Finds the passes that are shown, and returns their number. */
int view_passes(const viewer *v, view_pass passes[VIEW_PASSES]);

/* --- input.c ---------------------------------------------------------------------------------- */

/* Gives an event to the interface, if that wants it, or to the image: a view_listener, of a viewer.
 * The interface is laid out before and after, so that each event acts on what the last one left. */
void view_take_event(void *v, const view_event *event);

/* --- frame.c ---------------------------------------------------------------------------------- */

/* Whether every frame advances time by a fixed step, so that a script always gives the same
 * images. */
bool view_steps_time(const viewer *v);

/* Advances all clocks. */
void view_pass_time(viewer *v);

/* Takes events and draws the interface while something else is in work, and cancels that if nobody
 * waits for it any more; for view_work_begin. */
void view_go_on(void *v);

/* Stops refining the image, or making tables: what is shown stays. */
void view_cancel(viewer *v);

/* Draws and shows changed settings, or refines the image. *worked: whether there was anything to
 * show. */
bool view_draw_frame(viewer *v, bool *worked, base_error *error);

/* Determines the exposure that suits the image. */
bool view_expose(viewer *v, base_error *error);

#endif
