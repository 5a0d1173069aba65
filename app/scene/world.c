/* SPDX-License-Identifier: MIT */
#include "app/scene/world.h"

#include "app/file/file.h"

#include <lampion/light.h>

#include <cjson/cJSON.h>
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
    enum { EXACT = 17 }; /* of a double */
    const double world = scene_to_world(origin, coordinate);
    snprintf(text, sizeof(scene_world_text), "%.*g", digits, world);
    while (origin != 0.0 && digits < EXACT &&
           scene_from_world(origin, strtod(text, NULL)) != coordinate)
        snprintf(text, sizeof(scene_world_text), "%.*g", ++digits, world);
}

void scene_add_world(struct cJSON *object, const char *name, const double origin[3],
                     const float point[3]) {
    cJSON *array = cJSON_AddArrayToObject(object, name);
    for (int k = 0; k < 3; k++) {
        scene_world_text text;
        scene_print_world(origin[k], point[k], 9, text);
        cJSON_AddItemToArray(array, cJSON_CreateRaw(text));
    }
}

bool scene_read_world(const struct cJSON *item, const double origin[3], float point[3]) {
    double world[3];
    if (!file_json_numbers(item, 3, -DBL_MAX, DBL_MAX, world))
        return false;
    scene_point_from_world(origin, world, point);
    for (int k = 0; k < 3; k++)
        if (!(fabsf(point[k]) <= LMP_LENGTH_MAX))
            return false;
    return true;
}
