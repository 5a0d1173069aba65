/* SPDX-License-Identifier: MIT */
/* frame.h - frames drawn and timed on the devices of this machine, and what is claimed of them. */
#ifndef LAMPION_PAPER_FRAME_H
#define LAMPION_PAPER_FRAME_H

#include "app/paper/paper.h"

/* A scene on the CPU and, if `has_gl`, by OpenGL, which may be software. */
typedef struct paper_devices {
    const paper_scene *from;
    scene world;
    render_device cpu, gl;
    bool has_gl;
    char note[1200]; /* why there is no OpenGL */
} paper_devices;

/* False if the scene cannot be loaded; OpenGL may fail. Software is not asked by a quick page. */
bool paper_devices_open(const paper *p, const paper_scene *from, paper_devices *devices,
                        cli_error *error);
void paper_devices_close(paper_devices *devices);

/* A paragraph that names them. */
void paper_name_devices(paper *p, const paper_devices *devices, const int size[2]);

/* A method on a device, as tables name it. */
typedef struct paper_method {
    device_kind device;
    method_kind method;
    const char *name;
    bool hardware; /* not where OpenGL is software */
} paper_method;

/* Milliseconds of a frame's shading and of all of it: medians. */
typedef struct paper_times {
    double shade, total;
} paper_times;

/* A frame as the paper filters it; camera and lights are the scene's. */
render_frame paper_frame(const int size[2], method_kind method, int bands);

/* `assignment` is NAME=MATERIAL, as `render --material` takes it; NULL: none. `pixels` is created.
 */
bool paper_draw(const paper_devices *devices, device_kind device, const render_frame *frame,
                const char *assignment, image *pixels, cli_error *error);
bool paper_time(const paper_devices *devices, device_kind device, const render_frame *frame,
                const char *assignment, paper_times *times, cli_error *error);

/* The exposure that lit surfaces ask for, as in `render`: of the devices' scene, with a material of
 * it replaced or not, and of a scene alone. */
bool paper_expose(const paper_devices *devices, const int size[2], const char *assignment,
                  float *exposure, cli_error *error);
bool paper_expose_scene(const paper_scene *from, const int size[2], float *exposure,
                        cli_error *error);

/* The frame of a claim that took least, in all. */
typedef struct paper_fastest {
    paper_times ms;
    double ns; /* of the whole frame, a pixel, light and band */
    const paper_method *by;
    int size[2];
} paper_fastest;

/* Keeps the faster. */
void paper_keep_fastest(paper_fastest *kept, const paper_fastest *other);

/* Holds if the whole frame takes no more nanoseconds than the paper's; else it fails on a GPU
 * alone. `claim` needs text and number; `on` is what was shown. */
void paper_claim_time(paper *p, const paper_devices *devices, const paper_fastest *fastest,
                      double theirs, const char *on, paper_claim claim);

#endif
