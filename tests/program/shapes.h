/* SPDX-License-Identifier: MIT */
/* shapes.h - bodies and buildings made of a few triangles, for tests that judge shapes. */
#ifndef LAMPION_PROGRAM_SHAPES_H
#define LAMPION_PROGRAM_SHAPES_H

#include "app/scene/instance.h"
#include "app/scene/vector.h"

#include <stdbool.h>
#include <string.h>

enum { SHAPE_CORNERS = 1 << 17 };

/* A scene of one mesh, with the arrays that it is made of. */
typedef struct shape {
    scene_vertex vertices[SHAPE_CORNERS];
    uint32_t indices[SHAPE_CORNERS];
    scene_mesh mesh;
    scene_instance instance;
    uint32_t count;
} shape;

static inline void shape_clear(shape *s) {
    s->count = 0;
}

static inline void shape_triangle(shape *s, lmp_vec3 a, lmp_vec3 b, lmp_vec3 c) {
    const lmp_vec3 corners[3] = { a, b, c };
    for (int i = 0; i < 3 && s->count < SHAPE_CORNERS; i++) {
        s->vertices[s->count] = (scene_vertex) { .normal = { 0, 1, 0 } };
        vec_store(corners[i], s->vertices[s->count].position);
        s->indices[s->count] = s->count;
        s->count++;
    }
}

/* Adds a quadrilateral, counter-clockwise as seen from its front; `flip` shows it to the other
 * side. */
static inline void shape_quad(shape *s, const lmp_vec3 p[4], bool flip) {
    shape_triangle(s, p[0], p[flip ? 2 : 1], p[flip ? 1 : 2]);
    shape_triangle(s, p[0], p[flip ? 3 : 2], p[flip ? 2 : 3]);
}

/* Adds a box without the sides in the mask: bit 2 k + (1: the far side of axis k). */
static inline void shape_box(shape *s, lmp_vec3 low, lmp_vec3 high, bool inwards, int without) {
    const float p[2][3] = { { low.x, low.y, low.z }, { high.x, high.y, high.z } };
    for (int side = 0; side < 6; side++) {
        const int k = side / 2, far = side % 2, i = (k + 1) % 3, j = (k + 2) % 3;
        lmp_vec3 quad[4];
        for (int corner = 0; corner < 4; corner++) {
            float at[3];
            at[k] = p[far][k];
            at[i] = p[corner == 1 || corner == 2][i];
            at[j] = p[corner >= 2][j];
            quad[corner] = vec_load(at);
        }
        if (!(without >> side & 1))
            shape_quad(s, quad, inwards == (bool)far);
    }
}

/* Revolves a profile around an axis y through `at`: its points (radius, height) in order have the
 * outside on their right, seen with y up and the axis at the left; it covers `from` to `to` of 64
 * parts of a circle. */
static inline void shape_revolve(shape *s, lmp_vec3 at, const float (*profile)[2], int count,
                                 int from, int to) {
    enum { PARTS = 64 };
    for (int part = from; part < to; part++) {
        const double a = 2 * 3.14159265358979 * part / PARTS,
                     b = 2 * 3.14159265358979 * (part + 1) / PARTS;
        for (int i = 0; i + 1 < count; i++) {
            lmp_vec3 quad[4];
            for (int corner = 0; corner < 4; corner++) {
                const double angle = corner == 1 || corner == 2 ? b : a;
                const float *point = profile[i + (corner >= 2)];
                quad[corner] = vec(at.x + point[0] * (float)cos(angle), at.y + point[1],
                                   at.z - point[0] * (float)sin(angle));
            }
            shape_quad(s, quad, false);
        }
    }
}

/* Adds ground with a height at x, z, each -1 … 1, times `size`. */
static inline void shape_ground(shape *s, float size, float height(float x, float z)) {
    enum { STEPS = 48 };
    for (int i = 0; i < STEPS * STEPS; i++) {
        lmp_vec3 quad[4];
        for (int corner = 0; corner < 4; corner++) {
            const float x = 2.0f * (float)(i % STEPS + (corner >= 2)) / STEPS - 1,
                        z = 2.0f * (float)(i / STEPS + (corner == 1 || corner == 2)) / STEPS - 1;
            quad[corner] = vec(size * x, size * height(x, z), size * z);
        }
        shape_quad(s, quad, false);
    }
}

/* Lays the shape down: what was up is then in front. */
static inline void shape_lie(shape *s) {
    for (uint32_t i = 0; i < s->count; i++) {
        float *p = s->vertices[i].position;
        const float y = p[1];
        p[1] = -p[2];
        p[2] = y;
    }
}

/* Turns the shape inside out: what showed its front shows its back. */
static inline void shape_invert(shape *s) {
    for (uint32_t i = 0; i + 2 < s->count; i += 3) {
        const uint32_t second = s->indices[i + 1];
        s->indices[i + 1] = s->indices[i + 2];
        s->indices[i + 2] = second;
    }
}

/* Returns a scene that uses the shape's arrays, which the shape keeps. */
static inline scene shape_scene(shape *s) {
    s->mesh = (scene_mesh) { .index_count = s->count };
    s->instance = scene_instance_identity(0);
    scene world = { .vertices = s->vertices,
                    .indices = s->indices,
                    .meshes = &s->mesh,
                    .instances = &s->instance,
                    .vertex_count = s->count,
                    .index_count = s->count,
                    .mesh_count = 1,
                    .instance_count = 1,
                    .name = "shape" };
    for (int k = 0; k < 3; k++) {
        s->mesh.minimum[k] = INFINITY;
        s->mesh.maximum[k] = -INFINITY;
        for (uint32_t i = 0; i < s->count; i++) {
            s->mesh.minimum[k] = fminf(s->mesh.minimum[k], s->vertices[i].position[k]);
            s->mesh.maximum[k] = fmaxf(s->mesh.maximum[k], s->vertices[i].position[k]);
        }
    }
    scene_bounds(&world, world.minimum, world.maximum);
    return world;
}

#endif
