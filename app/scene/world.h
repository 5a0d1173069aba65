/* SPDX-License-Identifier: MIT */
/* world.h - conversion between coordinates that a person sees and those of a scene. The world's are
 * in double; a scene's are float32, relative to its origin. */
#ifndef LAMPION_SCENE_WORLD_H
#define LAMPION_SCENE_WORLD_H

#include <stdbool.h>

/* Whether the origin is 0, as in ordinary scenes. */
static inline bool scene_origin_is_0(const double origin[3]) {
    return origin[0] == 0.0 && origin[1] == 0.0 && origin[2] == 0.0;
}

/* Convert a coordinate, or a point, between world and scene. */
float scene_from_world(double origin, double world);
double scene_to_world(double origin, float coordinate);
void scene_point_from_world(const double origin[3], const double world[3], float point[3]);
void scene_point_to_world(const double origin[3], const float point[3], double world[3]);

/* Converts a point of a scene to a scene with another origin, clamped to LMP_LENGTH_MAX. */
void scene_point_rebase(const double from[3], const double to[3], float point[3]);

/* Prints a world coordinate with that many digits; where the origin is not 0, with as many more as
 * restore the scene's coordinate to the bit, as 9 digits do where it is 0. */
typedef char scene_world_text[32];
void scene_print_world(double origin, float coordinate, int digits, scene_world_text text);

struct json_t;

/* Writes the world coordinates of a point as JSON [x, y, z] that reads back to the bit; returns
 * NULL if memory ran out. */
struct json_t *scene_world_to_json(const double origin[3], const float point[3]);

/* Reads [x, y, z] in the world; returns false unless the point is in reach of a scene. */
bool scene_read_world(const struct json_t *item, const double origin[3], float point[3]);

#endif
