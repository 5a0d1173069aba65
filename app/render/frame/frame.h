/* SPDX-License-Identifier: MIT */
/* frame.h - what to draw: a frame is a camera, the surfaces that it sees, their light, and an
 * image; who finds the surfaces and who lights them do not know each other. */
#ifndef LAMPION_RENDER_FRAME_H
#define LAMPION_RENDER_FRAME_H

#include "app/cli/cli.h"
#include "app/image/image.h"
#include "app/method/method.h"
#include "app/scene/scene.h"

struct render_frame;
typedef struct render_surfaces render_surfaces; /* surfaces.h */
typedef struct shade_field shade_field;         /* app/render/shade/field.h */

/* Shades surfaces: rgba receives the radiance of their pixels, rows from the top; the fourth value
 * is not used. */
typedef bool (*render_shader)(const struct render_frame *frame, const render_surfaces *surfaces,
                              float *rgba, cli_error *error);

/* Changes rgba, whichever device has shaded it. */
typedef struct render_pass {
    bool (*run)(void *user, const struct render_frame *frame, const render_surfaces *surfaces,
                float *rgba, cli_error *error);
    void *user;
} render_pass;

/* Looks at the light that surfaces reflect (renderer_meter), and tells the frame's samples_exposure
 * by it. */
typedef struct render_meter {
    float (*run)(void *user, const image *pixels);
    void *user;
} render_meter;

/* A frame's field for shaders: its lists and, if `nodes`, all its nodes are those of the frame's
 * lights. *stamp: above 0, and another one whenever it has changed. NULL on failure. */
typedef const lmp_field *(*render_whole_field)(const struct render_frame *frame, bool nodes,
                                               uint64_t *stamp);

typedef struct render_frame {
    int width, height;
    scene_camera camera;
    method_kind method;
    int bands; /* 1 … those of the method on its device */
    lmp_window window;
    const scene_light *lights;
    size_t light_count;                  /* <= render_lights_max */
    float background[3];                 /* its radiance, where there is no backdrop */
    bool hide_backdrop;                  /* of the environment, which shines all the same */
    int samples;                         /* a pixel, spread over it; 0 means 1, in its middle */
    const lmp_preintegrated_lobe *lobes; /* of these bands and window, if the method reads them */
    shade_field *field;                  /* of these bands, if the method reads one */
    render_whole_field whole_field;      /* of it, where a shader does */
    render_shader host;     /* on the GPU: shades its surfaces instead of the shaders, or NULL */
    render_pass shadow;     /* after shading; zero: none */
    bool keep_geometry;     /* and draw lights alone where the frame before had the same view */
    float samples_exposure; /* the mean suits an image of this exposure; 0: the plain mean */
    render_meter meter;     /* of renderer_draw, before the mean; zero: none */
} render_frame;

/* Whether the frame has what its method reads. */
bool render_frame_check(const render_frame *frame, cli_error *error);

/* Milliseconds of one frame's passes: timer queries on hardware, a wall clock on the CPU. */
typedef struct render_times {
    double surfaces; /* finding them: rays, or a G-buffer */
    double shade, tone, total;
    double transfer; /* pixels to the host and back, part of the total */
    double shadow;   /* render_frame.shadow */
} render_times;

#endif
