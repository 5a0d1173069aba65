/* SPDX-License-Identifier: MIT */
/* camera.h - moving a camera, and the rays through its pixels. Angles in radians. */
#ifndef LAMPION_VIEW_CAMERA_H
#define LAMPION_VIEW_CAMERA_H

#include "app/scene/scene.h"

/* Rotates the eye around the target, to the right and up, but never over the poles. */
void view_orbit(scene_camera *camera, float right, float up);

/* Rotates the view around the eye. */
void view_look_round(scene_camera *camera, float right, float up);

/* Moves eye and target by fractions of the image's height at the target. */
void view_pan(scene_camera *camera, float right, float up);

/* Whether all lengths of the camera are within the limits of files; events that would exceed them
 * have no effect. */
bool view_camera_is_valid(const scene_camera *camera);

/* Brings the eye nearer to the target by a factor < 1; below `nearest`, the target moves along.
 * Parallel rays change the camera's height instead. */
void view_dolly(scene_camera *camera, float factor, float nearest);

/* Moves eye and target by lengths. */
void view_fly(scene_camera *camera, float right, float up, float forward);

/* Moves the eye back along its view until a sphere fits the image. */
void view_frame(scene_camera *camera, lmp_vec3 center, float radius, float aspect);

/* Returns the ray through a position in the image: x to the right and y down from the upper left
 * corner. */
typedef struct view_ray {
    lmp_vec3 from, direction; /* direction is unit */
    float near, far;          /* distances between which the camera sees; far may be INFINITY */
    float pixel, spread;      /* a pixel's height at the start, and its growth per length */
} view_ray;
view_ray view_ray_through(const scene_camera *camera, int width, int height, double x, double y);

/* Projects a point to the image; returns false behind the eye. *scale receives pixels per length
 * there. */
bool view_project(const scene_camera *camera, int width, int height, lmp_vec3 point, double *x,
                  double *y, double *scale);

/* Returns the nearest light with a position that the ray meets, hidden or not, or -1. pixels: by
 * how much each sphere's radius is enlarged, so that far ones can be hit. */
int view_pick_light(const view_ray *ray, const scene_light *lights, size_t count, float pixels,
                    float *distance);

#endif
