/* SPDX-License-Identifier: MIT */
/* path.h - how one light moves, and such paths from JSON (docs/lights.md). */
#ifndef LAMPION_ANIMATION_PATH_H
#define LAMPION_ANIMATION_PATH_H

#include "app/scene/scene.h"

typedef enum path_kind { PATH_REST, PATH_ORBIT, PATH_BOUNCE, PATH_CIRCLE, PATH_KEYS } path_kind;

typedef struct path_key {
    double time;
    double offset[3]; /* from where the light rests */
} path_key;

/* How one light moves, relative to the scene's origin. */
typedef struct path {
    path_kind kind;
    double period;             /* seconds, > 0 */
    double center[3], axis[3]; /* of a circle; axis unit */
    double bottom;             /* of a bounce: the lowest height of the sphere's lower end */
    path_key *keys;            /* at least 2, times ascending from 0, the last one is the period */
    size_t key_count;
    bool smooth; /* Catmull-Rom between keys, else straight */
} path;

/* Reads a JSON file, whose positions are in the world, into the paths of all lights of the scene,
 * all PATH_REST before. */
bool animation_read_paths(const char *file, const scene *world, path *paths, cli_error *error);

#endif
