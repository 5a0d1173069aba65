/* SPDX-License-Identifier: MIT */
/* world.h - where coordinates that a person gives or gets become those of a scene, and back. The
 * world's are in double; a scene's are float32, relative to its origin. */
#ifndef LAMPION_SCENE_WORLD_H
#define LAMPION_SCENE_WORLD_H

#include <stdbool.h>

/* Whether it is that of ordinary scenes. */
static inline bool scene_origin_is_0(const double origin[3]) {
    return origin[0] == 0.0 && origin[1] == 0.0 && origin[2] == 0.0;
}

/* A coordinate, or a point, on its way between the two. */
float scene_from_world(double origin, double world);
double scene_to_world(double origin, float coordinate);
void scene_point_from_world(const double origin[3], const double world[3], float point[3]);
void scene_point_to_world(const double origin[3], const float point[3], double world[3]);

/* A point of a scene as one of a scene with another origin; what that puts out of reach is held at
 * LMP_LENGTH_MAX. */
void scene_point_rebase(const double from[3], const double to[3], float point[3]);

/* The world's coordinate in so many digits; where the origin is not 0 in as many more as bring the
 * scene's back to the bit, as 9 do where it is 0. */
typedef char scene_world_text[32];
void scene_print_world(double origin, float coordinate, int digits, scene_world_text text);

struct cJSON;

/* Adds [x, y, z] of the world to a JSON object. */
void scene_add_world(struct cJSON *object, const char *name, const double origin[3],
                     const float point[3]);

/* Whether *item is [x, y, z], whose point is then in reach of a scene. */
bool scene_read_world(const struct cJSON *item, const double origin[3], float point[3]);

#endif
