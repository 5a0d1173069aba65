/* SPDX-License-Identifier: MIT */
/* camera.h - the rays of a frame's camera; shaders/camera.glsl has the same. */
#ifndef LAMPION_RENDER_CAMERA_H
#define LAMPION_RENDER_CAMERA_H

#include "app/render/frame/frame.h"

/* The rays of one sample of every pixel. Positions of the view are -1 … 1, x to the right and y
 * down; directions are 1 long along `forward`, so that a distance along them is a depth. */
typedef struct render_camera {
    int width, height;
    bool parallel; /* the rays are parallel */
    float eye[3];
    float forward[3];        /* unit */
    float right[3];          /* to the right edge of the view at distance 1, or at any */
    float down[3];           /* to its bottom edge */
    float jitter[2];         /* where in its pixel the sample is, in positions of the view */
    float first[2], step[2]; /* of the samples of pixels: the first position, and to the next */
    float near, far;         /* depths of what is seen; far: INFINITY */
    int sample, samples;
} render_camera;

/* Rays of sample `sample` of a frame. False if the camera looks nowhere. */
bool render_camera_set(const scene *scene, const render_frame *frame, int sample,
                       render_camera *camera, cli_error *error);

/* The rays of `count` pixels: where they begin, and their directions. */
void render_camera_rays(const render_camera *camera, const int *x, const int *y, int count,
                        float *const origin[3], float *const direction[3]);

/* Unit directions to the camera from what `count` pixels of a row see, from x on. */
void render_camera_views(const render_camera *camera, int x, int y, int count,
                         float *const view[3]);

#endif
