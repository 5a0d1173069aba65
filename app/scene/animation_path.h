/* SPDX-License-Identifier: MIT */
/* animation_path.h - how one light moves, and how such paths are read from JSON
 * (docs/lights.md). */
#ifndef LAMPION_SCENE_ANIMATION_PATH_H
#define LAMPION_SCENE_ANIMATION_PATH_H

#include "app/scene/scene.h"

typedef enum path_kind { PATH_REST, PATH_ORBIT, PATH_BOUNCE, PATH_CIRCLE, PATH_KEYS } path_kind;

typedef struct path_key {
    double time;
    double offset[3]; /* from the light's resting position */
} path_key;

/* How one light moves; positions are relative to the scene's origin. */
typedef struct path {
    path_kind kind;
    double period;             /* seconds, > 0 */
    double center[3], axis[3]; /* of a circle; axis unit */
    double bottom;             /* of a bounce: the height that the sphere's lower end falls to */
    path_key *keys;            /* at least 2, times ascending from 0; the last time is the period */
    size_t key_count;
    bool smooth; /* Catmull-Rom between keys, else straight lines */
} path;

/* Reads a JSON file, whose positions are in the world, into the paths of all lights of the scene;
 * every path must be PATH_REST before. */
bool animation_read_paths(const char *file, const scene *world, path *paths, base_error *error);

#endif
