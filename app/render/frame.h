/* SPDX-License-Identifier: MIT */
/* frame.h - what to draw: a frame is a camera, the surfaces that it sees, their light, and an
 * image. The code that finds surfaces and the code that shades them do not know each other. */
#ifndef LAMPION_RENDER_FRAME_H
#define LAMPION_RENDER_FRAME_H

#include "app/base/error.h"
#include "app/render/method.h"
#include "app/scene/scene.h"

#include <stdatomic.h>

struct render_frame;
typedef struct render_surfaces render_surfaces; /* surfaces.h */
typedef struct render_rectangle render_rectangle;
typedef struct render_tile render_tile;
typedef struct shade_field shade_field; /* app/render/shade_field.h */

/* Shades surfaces: rgba receives the radiance of their pixels, rows from the top; the fourth value
 * is unused. */
typedef bool (*render_shader)(const struct render_frame *frame, const render_surfaces *surfaces,
                              float *rgba, base_error *error);

/* How a pass works on an image that is drawn tile by tile. For some of the samples it looks at all
 * tiles, combines what it has found, and then changes the tiles of that sample and of those after
 * it, up to the next sample that it looks at. Tiles are rectangles of the planes, and rgba holds
 * their values. */
typedef struct render_tiled_pass {
    bool (*looks)(const void *user, int sample); /* at this sample? true for the first */
    bool (*begin)(void *user, const struct render_frame *frame, int sample, base_error *error);
    void *(*open)(void *user); /* opens a thread's work; NULL if memory ran out */
    void (*close)(void *user, void *work);
    void (*look)(void *user, void *work, const render_surfaces *surfaces,
                 const render_rectangle *pixels);
    void (*mix)(void *user);
    /* Changes a sample that was looked at. Of the surfaces it reads only `seen` and the
     * emission. */
    void (*change)(const void *user, const render_surfaces *surfaces,
                   const render_rectangle *pixels, float *rgba);
    /* Changes a later sample. */
    void (*change_later)(const void *user, void *work, const render_surfaces *surfaces,
                         const render_rectangle *pixels, float *rgba);
} render_tiled_pass;

/* A pass that changes rgba, whichever device has shaded it. */
typedef struct render_pass {
    bool (*run)(void *user, const struct render_frame *frame, const render_surfaces *surfaces,
                float *rgba, base_error *error);
    void *user;
    const render_tiled_pass *tiled; /* how to work tile by tile, or NULL */
} render_pass;

/* The light that surfaces reflect to each other. */
typedef struct render_bounces {
    /* Follows the lights of a frame; called before the first of its samples. */
    bool (*begin)(void *user, const struct render_frame *frame, base_error *error);
    /* Fills the planes of bounced light of a rectangle of at most RENDER_TILE pixels a side, except
     * where a pixel is the same as in the first sample. May be called from any thread, each with a
     * tile of its own for RENDER_TILE_PIXELS. */
    void (*fill)(const void *user, const render_surfaces *surfaces, const render_rectangle *pixels,
                 render_tile *tile);
    void *user;
} render_bounces;

/* Returns a frame's field for shaders: its lists and, if `nodes` is true, all its nodes are up to
 * date with the frame's lights. *stamp receives a number above 0 that changes whenever the field
 * does. Returns NULL on failure. */
typedef const lmp_field *(*render_whole_field)(const struct render_frame *frame, bool nodes,
                                               uint64_t *stamp);

/* How far the CPU has drawn an image, and whether it is to give up; any thread may read and write
 * it. */
typedef struct render_progress {
    atomic_bool cancelled;
    atomic_int done, all; /* tiles, each as often as it is worked on; all is 0 before they begin */
} render_progress;

typedef struct render_frame {
    int width, height;
    scene_camera camera;
    method_kind method;
    int bands; /* 1 to the maximum of the method on its device */
    lmp_window window;
    const scene_light *lights;
    size_t light_count;  /* <= render_lights_max */
    float background[3]; /* radiance where there is no backdrop */
    bool hide_backdrop;  /* whether to hide the environment's backdrop; it still lights the scene */
    int samples;         /* per pixel, spread over it; 0 means 1, at its center */
    const lmp_preintegrated_lobe *lobes; /* of these bands and window, if the method reads them */
    shade_field *field;                  /* of these bands, if the method reads a field */
    render_whole_field whole_field;      /* returns the field for shaders that read it */
    render_shader cpu_shader; /* shades the GPU's surfaces in place of shaders; or NULL */
    render_pass shadow;       /* after shading; zero: none */
    render_bounces bounces;   /* zero: none */
    bool keep_geometry;     /* keep it, and draw only lights if the last frame had the same view */
    float samples_exposure; /* the exposure that the mean is weighted for; 0: the plain mean */
    render_progress *progress; /* or NULL; what is cancelled fails, and is begun again */
} render_frame;

static inline void render_progress_reset(render_progress *progress, int all) {
    if (progress) {
        atomic_store(&progress->done, 0);
        atomic_store(&progress->all, all);
    }
}

/* Counts a tile; returns false if it need not be worked on. */
static inline bool render_next_tile(const render_frame *frame) {
    if (!frame->progress)
        return true;
    atomic_fetch_add(&frame->progress->done, 1);
    return !atomic_load(&frame->progress->cancelled);
}

/* Returns false, with an error, if the frame was cancelled. */
bool render_goes_on(const render_frame *frame, base_error *error);

/* Checks that the frame has everything its method reads. */
bool render_frame_check(const render_frame *frame, base_error *error);

/* Milliseconds of one frame's passes, measured by timer queries on hardware or by a wall clock on
 * the CPU. */
typedef struct render_times {
    double surfaces; /* finding them, by rays or as a G-buffer */
    double shade, tone, total;
    double transfer; /* pixels to the CPU and back, part of the total */
    double shadow;   /* of render_frame.shadow */
    double bounces;  /* reading bounced light; the update is timed by its owner */
} render_times;

#endif
