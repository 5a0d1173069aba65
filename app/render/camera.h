/* SPDX-License-Identifier: MIT */
/* camera.h - the rays of a frame's camera; shaders/program/camera.glsl computes the same. */
#ifndef LAMPION_RENDER_CAMERA_H
#define LAMPION_RENDER_CAMERA_H

#include "app/render/frame.h"

/* The rays of one sample of every pixel. View coordinates are -1 … 1, x to the right and y down;
 * directions have length 1 along `forward`, so that a distance along them is a depth. */
typedef struct render_camera {
    int width, height;
    bool parallel; /* whether the rays are parallel */
    float eye[3];
    float forward[3];        /* unit */
    float right[3];          /* to the view's right edge: at distance 1, or at any if parallel */
    float down[3];           /* to the view's bottom edge */
    float jitter[2];         /* the sample's offset in its pixel, in view coordinates */
    float first[2], step[2]; /* view coordinates of the first sample, and per pixel */
    float near, far;         /* range of visible depths; far may be INFINITY */
    int sample, samples;
} render_camera;

/* Prepares the rays of sample `sample` of a frame. Returns false if the camera has no direction. */
bool render_camera_set(const scene *scene, const render_frame *frame, int sample,
                       render_camera *camera, base_error *error);

/* Computes the rays of `count` pixels: their origins and directions. */
void render_camera_rays(const render_camera *camera, const int *x, const int *y, int count,
                        float *const origin[3], float *const direction[3]);

/* Computes unit directions to the camera from what `count` pixels of a row see, from x on. */
void render_camera_views(const render_camera *camera, int x, int y, int count,
                         float *const view[3]);

#endif
