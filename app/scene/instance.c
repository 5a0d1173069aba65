/* SPDX-License-Identifier: MIT */
#include "app/scene/instance.h"

#include "app/scene/vector.h"

#include <float.h>
#include <string.h>

scene_instance scene_instance_identity(uint32_t mesh) {
    return (scene_instance) { .world_from_mesh = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } },
                              .mesh = mesh };
}

bool scene_instance_is_identity(const scene_instance *instance) {
    const scene_instance identity = scene_instance_identity(0);
    return memcmp(instance->world_from_mesh, identity.world_from_mesh,
                  sizeof identity.world_from_mesh) == 0;
}

/* --- matrices --------------------------------------------------------------------------------- */

/* The range of scales that fit: cofactors are products of two elements, their squares of four. */
#define SCALE_SMALLEST 1e-8
#define SCALE_LARGEST  1e8
#define VOLUME_LEAST   1e-4 /* of a cube's volume to its edges' product; of shortest to longest */

bool scene_instance_fits(const scene_instance *instance) {
    double m[3][3], length[3];
    for (int column = 0; column < 3; column++) {
        double square = 0.0;
        for (int row = 0; row < 3; row++) {
            m[row][column] = (double)instance->world_from_mesh[row][column];
            square += m[row][column] * m[row][column];
        }
        length[column] = sqrt(square);
        if (!(length[column] >= SCALE_SMALLEST && length[column] <= SCALE_LARGEST) ||
            !isfinite(instance->world_from_mesh[column][3]))
            return false;
    }
    const double volume = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                          m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                          m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    const double least = fmin(length[0], fmin(length[1], length[2]));
    const double largest = fmax(length[0], fmax(length[1], length[2]));
    return least >= VOLUME_LEAST * largest &&
           fabs(volume) >= VOLUME_LEAST * length[0] * length[1] * length[2];
}

void scene_multiply(const double a[16], const double b[16], double product[16]) {
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            double sum = 0.0;
            for (int k = 0; k < 4; k++)
                sum += a[4 * k + row] * b[4 * column + k];
            product[4 * column + row] = sum;
        }
}

bool scene_instance_set(scene_instance *instance, const double m[16]) {
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++)
            instance->world_from_mesh[row][column] = (float)m[4 * column + row];
    return scene_instance_fits(instance);
}

static lmp_vec3 row_of(const scene_instance *instance, int row) {
    return vec_load(instance->world_from_mesh[row]);
}

/* Computes the rows of the matrix that transforms normals, up to scale. */
static void cofactors(const scene_instance *instance, lmp_vec3 rows[3]) {
    for (int i = 0; i < 3; i++)
        rows[i] = vec_cross(row_of(instance, (i + 1) % 3), row_of(instance, (i + 2) % 3));
}

bool scene_instance_mirrors(const scene_instance *instance) {
    return vec_dot(row_of(instance, 0), vec_cross(row_of(instance, 1), row_of(instance, 2))) < 0.0f;
}

void scene_instance_vertices(const scene_instance *instance, scene_vertex *vertices, size_t count) {
    if (scene_instance_is_identity(instance))
        return;
    const float side = scene_instance_mirrors(instance) ? -1.0f : 1.0f;
    const lmp_vec3 x = row_of(instance, 0), y = row_of(instance, 1), z = row_of(instance, 2);
    lmp_vec3 rows[3];
    cofactors(instance, rows);
    for (size_t i = 0; i < count; i++) {
        scene_vertex *vertex = &vertices[i];
        const lmp_vec3 n = vec_load(vertex->normal), t = vec_load(vertex->tangent);
        const lmp_vec3 normal = { vec_dot(rows[0], n), vec_dot(rows[1], n), vec_dot(rows[2], n) };
        const lmp_vec3 tangent = { vec_dot(x, t), vec_dot(y, t), vec_dot(z, t) };
        float at[3];
        scene_instance_point(instance, vertex->position, at);
        memcpy(vertex->position, at, sizeof at);
        vec_store(vec_normalize(vec_scale(normal, side), n), vertex->normal);
        vec_store(vec_normalize(tangent, t), vertex->tangent);
        vertex->tangent[3] *= side;
    }
}

/* Returns the Frobenius norm: no less than the largest scale, and at most the root of 3 times
 * it. */
float scene_instance_scale(const scene_instance *instance) {
    double square = 0.0;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            const double m = (double)instance->world_from_mesh[k][i];
            square += m * m;
        }
    return (float)sqrt(square);
}

/* --- boxes ------------------------------------------------------------------------------------ */

void scene_instance_box(const scene *s, size_t number, float minimum[3], float maximum[3]) {
    const scene_instance *instance = &s->instances[number];
    const scene_mesh *mesh = &s->meshes[instance->mesh];
    const bool exact = scene_instance_is_identity(instance);
    for (int k = 0; k < 3; k++) {
        const float *row = instance->world_from_mesh[k];
        float low = 0.0f, high = 0.0f, size = fabsf(row[3]);
        for (int i = 0; i < 3; i++) {
            const float a = row[i] * mesh->minimum[i], b = row[i] * mesh->maximum[i];
            low += fminf(a, b);
            high += fmaxf(a, b);
            size += fmaxf(fabsf(a), fabsf(b));
        }
        const float rounding = exact ? 0.0f : 8.0f * FLT_EPSILON * size;
        minimum[k] = low + row[3] - rounding;
        maximum[k] = high + row[3] + rounding;
    }
}

/* --- triangles -------------------------------------------------------------------------------- */

uint32_t scene_instance_triangles(const scene *s, size_t instance) {
    return s->meshes[s->instances[instance].mesh].index_count / 3;
}

size_t scene_triangle_count(const scene *s) {
    size_t count = 0;
    for (size_t i = 0; i < s->instance_count; i++)
        count += scene_instance_triangles(s, i);
    return count;
}

void scene_triangle_vertices(const scene *s, size_t number, uint32_t triangle,
                             const scene_vertex *corners[3]) {
    const scene_instance *instance = &s->instances[number];
    const uint32_t *index =
        s->indices + s->meshes[instance->mesh].first_index + 3 * (size_t)triangle;
    const int swapped = scene_instance_mirrors(instance);
    corners[0] = &s->vertices[index[0]];
    corners[1 + swapped] = &s->vertices[index[1]];
    corners[2 - swapped] = &s->vertices[index[2]];
}

void scene_triangle_positions(const scene *s, size_t number, uint32_t triangle,
                              float corners[3][3]) {
    const scene_instance *instance = &s->instances[number];
    const scene_vertex *own[3];
    scene_triangle_vertices(s, number, triangle, own);
    for (int i = 0; i < 3; i++)
        scene_instance_point(instance, own[i]->position, corners[i]);
}

void scene_triangle(const scene *s, size_t number, uint32_t triangle, scene_vertex corners[3]) {
    const scene_vertex *own[3];
    scene_triangle_vertices(s, number, triangle, own);
    for (int i = 0; i < 3; i++)
        corners[i] = *own[i];
    scene_instance_vertices(&s->instances[number], corners, 3);
}
