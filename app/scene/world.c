/* SPDX-License-Identifier: MIT */
#include "app/scene/world.h"
#include "app/base/file_json.h"

#include <lampion/light.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

float scene_from_world(double origin, double world) {
    return (float)(world - origin);
}

double scene_to_world(double origin, float coordinate) {
    return origin + (double)coordinate;
}

void scene_point_from_world(const double origin[3], const double world[3], float point[3]) {
    for (int k = 0; k < 3; k++)
        point[k] = scene_from_world(origin[k], world[k]);
}

void scene_point_to_world(const double origin[3], const float point[3], double world[3]) {
    for (int k = 0; k < 3; k++)
        world[k] = scene_to_world(origin[k], point[k]);
}

void scene_point_rebase(const double from[3], const double to[3], float point[3]) {
    for (int k = 0; k < 3; k++)
        point[k] = fminf(fmaxf((float)((double)point[k] + (from[k] - to[k])), -LMP_LENGTH_MAX),
                         LMP_LENGTH_MAX);
}

void scene_print_world(double origin, float coordinate, int digits, scene_world_text text) {
    enum { EXACT = 17 }; /* digits of a double */
    const double world = scene_to_world(origin, coordinate);
    snprintf(text, sizeof(scene_world_text), "%.*g", digits, world);
    while (origin != 0.0 && digits < EXACT &&
           scene_from_world(origin, strtod(text, NULL)) != coordinate)
        snprintf(text, sizeof(scene_world_text), "%.*g", ++digits, world);
}

static json_t *coordinate_to_json(double origin, float coordinate) {
    scene_world_text text;
    if (origin == 0.0)
        return file_json_float(coordinate);
    scene_print_world(origin, coordinate, 9, text);
    return file_json_real(strtod(text, NULL));
}

json_t *scene_world_to_json(const double origin[3], const float point[3]) {
    return json_pack("[o, o, o]", coordinate_to_json(origin[0], point[0]),
                     coordinate_to_json(origin[1], point[1]),
                     coordinate_to_json(origin[2], point[2]));
}

bool scene_read_world(const json_t *item, const double origin[3], float point[3]) {
    double world[3];
    if (!file_json_numbers(item, 3, -DBL_MAX, DBL_MAX, world))
        return false;
    scene_point_from_world(origin, world, point);
    for (int k = 0; k < 3; k++)
        if (!(fabsf(point[k]) <= LMP_LENGTH_MAX))
            return false;
    return true;
}
