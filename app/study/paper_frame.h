/* SPDX-License-Identifier: MIT */
/* paper_frame.h - frames drawn and timed on the devices of this machine, and claims about their
 * times. */
#ifndef LAMPION_STUDY_PAPER_FRAME_H
#define LAMPION_STUDY_PAPER_FRAME_H

#include "app/study/paper.h"

/* A scene on the CPU and, if `has_gl`, in OpenGL, which may be software. */
typedef struct paper_devices {
    const paper_scene *from;
    scene world;
    render_device cpu, gl;
    bool has_gl;
    char note[1200]; /* why OpenGL is missing */
} paper_devices;

/* Opens the devices; returns false if the scene cannot be loaded, but not if OpenGL fails. A quick
 * page does not use software OpenGL. */
bool paper_devices_open(const paper *p, const paper_scene *from, paper_devices *devices,
                        base_error *error);
void paper_devices_close(paper_devices *devices);

/* Writes a paragraph that names the devices. */
void paper_name_devices(paper *p, const paper_devices *devices, const int size[2]);

/* A method on a device, with its name in tables. */
typedef struct paper_method {
    device_kind device;
    method_kind method;
    const char *name;
    bool hardware; /* skip where OpenGL is software */
} paper_method;

/* Milliseconds of a frame's shading and of the whole frame: medians. */
typedef struct paper_times {
    double shade, total;
} paper_times;

/* Returns a frame with the paper's windowing filter; camera and lights are the scene's. */
render_frame paper_frame(const int size[2], method_kind method, int bands);

/* Draws a frame. `assignment` is NAME=MATERIAL, as in `render --material`; NULL: none. `pixels` is
 * created. */
bool paper_draw(const paper_devices *devices, device_kind device, const render_frame *frame,
                const char *assignment, image *pixels, base_error *error);
bool paper_time(const paper_devices *devices, device_kind device, const render_frame *frame,
                const char *assignment, paper_times *times, base_error *error);

/* Find the exposure, as `render` does: of the devices' scene, with an optional material replaced,
 * and of a scene alone. */
bool paper_expose(const paper_devices *devices, const int size[2], const char *assignment,
                  float *exposure, base_error *error);
bool paper_expose_scene(const paper_scene *from, const int size[2], float *exposure,
                        base_error *error);

/* The fastest frame of a claim. */
typedef struct paper_fastest {
    paper_times ms;
    double ns; /* of the whole frame, per pixel, light and band */
    const paper_method *by;
    int size[2];
} paper_fastest;

/* Keeps the faster of two frames. */
void paper_keep_fastest(paper_fastest *kept, const paper_fastest *other);

/* Adds a claim about time: it holds if the whole frame takes no more nanoseconds than the paper's;
 * it can only fail on a GPU. `claim` needs text and number; `on` names what was drawn. */
void paper_claim_time(paper *p, const paper_devices *devices, const paper_fastest *fastest,
                      double theirs, const char *on, paper_claim claim);

#endif
