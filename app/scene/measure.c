/* SPDX-License-Identifier: MIT */
/* measure.c - bounds and area of all instances of a scene. */
#include "app/scene/instance.h"
#include "app/scene/vector.h"

#include <math.h>
#include <stdlib.h>

/* --- bounds ----------------------------------------------------------------------------------- */

static bool is_inside(const float low[3], const float high[3], const float minimum[3],
                      const float maximum[3]) {
    for (int k = 0; k < 3; k++)
        if (!(low[k] >= minimum[k] && high[k] <= maximum[k]))
            return false;
    return true;
}

static void include_point(const float p[3], float minimum[3], float maximum[3]) {
    for (int k = 0; k < 3; k++) {
        minimum[k] = fminf(minimum[k], p[k]);
        maximum[k] = fmaxf(maximum[k], p[k]);
    }
}

float scene_diagonal(const scene *s) {
    return vec_length(vec_sub(vec_load(s->maximum), vec_load(s->minimum)));
}

bool scene_bounds(const scene *s, float minimum[3], float maximum[3]) {
    float least[3] = { INFINITY, INFINITY, INFINITY };
    float most[3] = { -INFINITY, -INFINITY, -INFINITY };
    for (size_t i = 0; i < s->instance_count; i++) {
        const scene_instance *instance = &s->instances[i];
        const scene_mesh *mesh = &s->meshes[instance->mesh];
        const uint32_t *index = s->indices + mesh->first_index;
        float low[3], high[3], at[3];
        scene_instance_box(s, i, low, high);
        if (is_inside(low, high, least, most))
            continue;
        if (scene_instance_is_identity(instance)) {
            include_point(low, least, most);
            include_point(high, least, most);
            continue;
        }
        for (uint32_t k = 0; k < mesh->index_count; k++) {
            scene_instance_point(instance, s->vertices[index[k]].position, at);
            include_point(at, least, most);
        }
    }
    for (int k = 0; k < 3 && s->instance_count; k++) {
        minimum[k] = least[k];
        maximum[k] = most[k];
    }
    return s->instance_count > 0;
}

/* --- area ------------------------------------------------------------------------------------- */

/* Computes the area of a mesh under a linear map, given by its rows. */
static double area_of(const scene *s, const scene_mesh *mesh, const double map[3][3]) {
    double sum = 0.0;
    for (uint32_t first = 0; first < mesh->index_count; first += 3) {
        const uint32_t *index = s->indices + mesh->first_index + first;
        double edges[2][3], world[2][3];
        for (int k = 0; k < 3; k++)
            for (int e = 0; e < 2; e++)
                edges[e][k] = (double)s->vertices[index[e + 1]].position[k] -
                              (double)s->vertices[index[0]].position[k];
        for (int e = 0; e < 2; e++)
            for (int k = 0; k < 3; k++)
                world[e][k] =
                    map[k][0] * edges[e][0] + map[k][1] * edges[e][1] + map[k][2] * edges[e][2];
        const double *a = world[0], *b = world[1];
        const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2];
        const double z = a[0] * b[1] - a[1] * b[0];
        sum += 0.5 * sqrt(x * x + y * y + z * z);
    }
    return sum;
}

/* Returns the factor by which all lengths grow, or 0 if they grow differently. */
static double scale_of(const double map[3][3]) {
    double square = 0.0, products[3] = { 0.0 }, lengths[3] = { 0.0 };
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            lengths[i] += map[k][i] * map[k][i];
            products[i] += map[k][i] * map[k][(i + 1) % 3];
            square += map[k][i] * map[k][i] / 3.0;
        }
    for (int i = 0; i < 3; i++)
        if (!(fabs(lengths[i] - square) <= 1e-5 * square && fabs(products[i]) <= 1e-5 * square))
            return 0.0;
    return sqrt(square);
}

double scene_area(const scene *s) {
    static const double same[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    double *areas = malloc((s->mesh_count + 1) * sizeof *areas), sum = 0.0;
    for (size_t i = 0; areas && i < s->mesh_count; i++)
        areas[i] = -1.0;
    for (size_t i = 0; i < s->instance_count; i++) {
        const scene_instance *instance = &s->instances[i];
        const scene_mesh *mesh = &s->meshes[instance->mesh];
        double map[3][3];
        for (int k = 0; k < 3; k++)
            for (int c = 0; c < 3; c++)
                map[k][c] = (double)instance->world_from_mesh[k][c];
        const double scale = areas ? scale_of((const double(*)[3])map) : 0.0;
        if (scale > 0.0 && areas[instance->mesh] < 0.0)
            areas[instance->mesh] = area_of(s, mesh, same);
        sum += scale > 0.0 ? scale * scale * areas[instance->mesh]
                           : area_of(s, mesh, (const double(*)[3])map);
    }
    free(areas);
    return sum;
}
