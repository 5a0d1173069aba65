/* SPDX-License-Identifier: MIT */
/* internal.h - what the files of this folder share. */
#ifndef LAMPION_ANIMATION_INTERNAL_H
#define LAMPION_ANIMATION_INTERNAL_H

#include "app/animation/animation.h"

typedef enum path_kind { PATH_REST, PATH_ORBIT, PATH_BOUNCE, PATH_CIRCLE, PATH_KEYS } path_kind;

typedef struct path_key {
    double time;
    double offset[3]; /* from where the light rests */
} path_key;

/* How one light moves. */
typedef struct path {
    path_kind kind;
    double period;             /* seconds, > 0 */
    double center[3], axis[3]; /* of a circle; axis unit */
    double bottom;             /* of a bounce: the lowest height of the sphere's lower end */
    path_key *keys;            /* at least 2, times ascending from 0, the last one is the period */
    size_t key_count;
    bool smooth; /* Catmull-Rom between keys, else straight */
} path;

struct animation {
    float minimum[3], maximum[3]; /* the scene's bounds */
    path rest;                    /* of lights without a path of their own */
    path *paths;
    size_t path_count;
};

/* Reads a JSON file into paths that are all PATH_REST. */
bool animation_read(const char *file, const scene *world, animation *all, cli_error *error);

#endif
