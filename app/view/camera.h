/* SPDX-License-Identifier: MIT */
/* camera.h - moving a camera, and the rays through its pixels. Angles in radians. */
#ifndef LAMPION_VIEW_CAMERA_H
#define LAMPION_VIEW_CAMERA_H

#include "app/scene/scene.h"

/* Rotates the eye around the target: to the right and up. Never over the poles. */
void view_orbit(scene_camera *camera, float right, float up);

/* Rotates the view around the eye. */
void view_look_round(scene_camera *camera, float right, float up);

/* Moves eye and target by parts of the image's height at the target. */
void view_pan(scene_camera *camera, float right, float up);

/* Whether no length of it is past what files take: an event that makes it otherwise has no effect.
 */
bool view_camera_is_valid(const scene_camera *camera);

/* Brings the eye nearer to the target by a factor < 1; below `nearest`, the target moves on. Of
 * parallel rays the height is what changes. */
void view_dolly(scene_camera *camera, float factor, float nearest);

/* Moves eye and target by lengths. */
void view_fly(scene_camera *camera, float right, float up, float forward);

/* Steps back, in the direction it looks from, until a sphere fits the image. */
void view_frame(scene_camera *camera, lmp_vec3 center, float radius, float aspect);

/* The ray through a position in the image: x to the right and y down from the upper left corner. */
typedef struct view_ray {
    lmp_vec3 from, direction; /* unit */
    float pixel, spread;      /* a pixel's height at the start, and what a length along it adds */
} view_ray;
view_ray view_ray_through(const scene_camera *camera, int width, int height, double x, double y);

/* Where a point is in the image; false behind the eye. *scale receives pixels a length there. */
bool view_project(const scene_camera *camera, int width, int height, lmp_vec3 point, double *x,
                  double *y, double *scale);

/* Nearest light with a position that the ray meets, or -1. Hidden ones count too. pixels: what
 * each sphere's radius grows by, so that far ones can be hit. */
int view_pick_light(const view_ray *ray, const scene_light *lights, size_t count, float pixels,
                    float *distance);

/* Nearest triangle that the ray meets: its mesh, or -1. */
typedef struct view_hit {
    int mesh;
    float distance;
    lmp_vec3 normal; /* unit, towards where the ray comes from */
} view_hit;
view_hit view_pick_surface(const view_ray *ray, const scene *scene);

#endif
