/* SPDX-License-Identifier: MIT */
/* camera.glsl - the rays of the frame's camera, and the depth along them. */
#ifndef LAMPION_CAMERA_GLSL
#define LAMPION_CAMERA_GLSL
#include "shared.h"

/* The ray through a position of the view, -1 … 1; `along` is 1 in the camera's direction. */
struct camera_ray {
    vec3 from, along;
};

camera_ray camera_ray_through(vec2 at) {
    vec3 aside = right.xyz * at.x + down.xyz * at.y;
    return camera_ray(eye.xyz + aside * forward.w, forward.xyz + aside * (1.0 - forward.w));
}

/* Returns the depth at a distance, reversed; for parallel rays it is linear as far as triangles
 * reach, and past them, where only lights are, as in perspective. */
float camera_depth(float distance) {
    if (forward.w == 0.0)
        return eye.w / distance;
    return distance < eye.w ? 1.0 - 0.5 * distance / eye.w : 0.5 * eye.w / distance;
}

/* Returns the distance of a triangle from its depth. */
float camera_distance(float depth) {
    return forward.w == 0.0 ? eye.w / depth : 2.0 * eye.w * (1.0 - depth);
}

#endif
