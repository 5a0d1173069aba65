/* SPDX-License-Identifier: MIT */
#include "app/scene/builtin/shape.h"

#include "app/scene/vector.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#define CREASE_COS  0.64f /* 50° */
#define PROFILE_MAX 128

void shaper_finish(scene_shaper *shaper) {
    const size_t first_mesh = builder_count(shaper->builder, BLOB_MESHES);
    for (uint32_t material = 0; material < SHAPE_MATERIALS_MAX; material++) {
        const builder_array *triangles = &shaper->triangles[material];
        const size_t first = builder_count(shaper->builder, BLOB_INDICES);
        uint32_t *indices = builder_append(shaper->builder, BLOB_INDICES, triangles->count);
        if (indices && triangles->count) {
            memcpy(indices, triangles->items, triangles->count * sizeof *indices);
            const scene_material *materials = builder_items(shaper->builder, BLOB_MATERIALS);
            builder_mesh(shaper->builder, materials[material].name, material, first);
        }
        free(triangles->items);
    }
    builder_instances(shaper->builder, first_mesh);
    memset(shaper->triangles, 0, sizeof shaper->triangles);
}

int shaper_steps(const scene_shaper *shaper, int steps) {
    enum { LEAST = 4 };
    if (shaper->detail == 0 || steps <= LEAST)
        return steps;
    const int fewer = steps * shaper->detail / 100;
    return fewer < LEAST ? LEAST : fewer;
}

/* Returns room for `count` more indices of the shaper's material, or NULL. */
static uint32_t *grow_triangles(scene_shaper *shaper, size_t count) {
    assert(shaper->material < SHAPE_MATERIALS_MAX);
    builder_array *array = &shaper->triangles[shaper->material];
    if (array->count + count > array->capacity) {
        const size_t capacity = 2 * (array->count + count);
        void *items = realloc(array->items, capacity * sizeof(uint32_t));
        if (!items) {
            shaper->builder->out_of_memory = true;
            return NULL;
        }
        array->items = items;
        array->capacity = capacity;
    }
    uint32_t *first = (uint32_t *)array->items + array->count;
    array->count += count;
    return first;
}

static lmp_vec3 rotate_quarters(lmp_vec3 a, int quarters) {
    switch (quarters & 3) {
    case 1:
        return vec(a.z, a.y, -a.x);
    case 2:
        return vec(-a.x, a.y, -a.z);
    case 3:
        return vec(-a.z, a.y, a.x);
    default:
        return a;
    }
}

static void put_vertex(const scene_shaper *shaper, scene_vertex *vertex, lmp_vec3 position,
                       lmp_vec3 normal, float u, float v) {
    const lmp_vec3 p = vec_add(rotate_quarters(position, shaper->quarters), shaper->origin);
    const lmp_vec3 n =
        rotate_quarters(vec_normalize(normal, vec(0.0f, 1.0f, 0.0f)), shaper->quarters);
    vec_store(p, vertex->position);
    vec_store(n, vertex->normal);
    vec_store(vec_across(n), vertex->tangent);
    vertex->tangent[3] = 1.0f;
    vertex->uv[0][0] = u;
    vertex->uv[0][1] = v;
}

static void put_quad_indices(uint32_t *indices, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    const uint32_t corners[6] = { a, b, c, a, c, d };
    memcpy(indices, corners, sizeof corners);
}

void shape_quad_smooth(scene_shaper *shaper, const lmp_vec3 corners[4], const lmp_vec3 normals[4]) {
    const uint32_t first = (uint32_t)builder_count(shaper->builder, BLOB_VERTICES);
    scene_vertex *vertices = builder_append(shaper->builder, BLOB_VERTICES, 4);
    uint32_t *indices = grow_triangles(shaper, 6);
    if (!vertices || !indices)
        return;
    const float width = vec_length(vec_sub(corners[1], corners[0]));
    const float height = vec_length(vec_sub(corners[3], corners[0]));
    put_vertex(shaper, &vertices[0], corners[0], normals[0], 0.0f, 0.0f);
    put_vertex(shaper, &vertices[1], corners[1], normals[1], width, 0.0f);
    put_vertex(shaper, &vertices[2], corners[2], normals[2], width, height);
    put_vertex(shaper, &vertices[3], corners[3], normals[3], 0.0f, height);
    put_quad_indices(indices, first, first + 1, first + 2, first + 3);
}

void shape_quad(scene_shaper *shaper, lmp_vec3 a, lmp_vec3 b, lmp_vec3 c, lmp_vec3 d) {
    const lmp_vec3 n = vec_cross(vec_sub(c, a), vec_sub(d, b));
    const lmp_vec3 corners[4] = { a, b, c, d }, normals[4] = { n, n, n, n };
    shape_quad_smooth(shaper, corners, normals);
}

void shape_box(scene_shaper *shaper, lmp_vec3 lo, lmp_vec3 hi) {
    const lmp_vec3 corner[8] = {
        vec(lo.x, lo.y, lo.z), vec(hi.x, lo.y, lo.z), vec(lo.x, hi.y, lo.z), vec(hi.x, hi.y, lo.z),
        vec(lo.x, lo.y, hi.z), vec(hi.x, lo.y, hi.z), vec(lo.x, hi.y, hi.z), vec(hi.x, hi.y, hi.z),
    };
    static const int faces[6][4] = { { 4, 5, 7, 6 }, { 1, 0, 2, 3 }, { 5, 1, 3, 7 },
                                     { 0, 4, 6, 2 }, { 6, 7, 3, 2 }, { 0, 1, 5, 4 } };
    for (int i = 0; i < 6; i++)
        shape_quad(shaper, corner[faces[i][0]], corner[faces[i][1]], corner[faces[i][2]],
                   corner[faces[i][3]]);
}

/* --- profiles --------------------------------------------------------------------------------- */

/* Normals at both ends of a profile's segment, averaged with the neighbor's where smooth. */
typedef struct segment_normals {
    shape_point start, end;
} segment_normals;

static shape_point segment_normal(const shape_point *profile, int i) {
    const float dr = profile[i + 1].r - profile[i].r, da = profile[i + 1].a - profile[i].a;
    const float length = sqrtf(dr * dr + da * da);
    return length > 0.0f ? (shape_point) { da / length, -dr / length }
                         : (shape_point) { 1.0f, 0.0f };
}

static shape_point blend_normals(shape_point n, shape_point neighbor) {
    if (n.r * neighbor.r + n.a * neighbor.a < CREASE_COS)
        return n;
    const float r = n.r + neighbor.r, a = n.a + neighbor.a, length = sqrtf(r * r + a * a);
    return (shape_point) { r / length, a / length };
}

static segment_normals normals_of_segment(const shape_point *profile, int point_count, int i) {
    const shape_point n = segment_normal(profile, i);
    segment_normals ends = { n, n };
    if (i > 0)
        ends.start = blend_normals(n, segment_normal(profile, i - 1));
    if (i + 2 < point_count)
        ends.end = blend_normals(n, segment_normal(profile, i + 1));
    return ends;
}

/* --- revolving -------------------------------------------------------------------------------- */

typedef struct revolution_frame {
    lmp_vec3 first, second, axis;
} revolution_frame;

static revolution_frame frame_of_axis(char axis) {
    const lmp_vec3 x = vec(1.0f, 0.0f, 0.0f), y = vec(0.0f, 1.0f, 0.0f), z = vec(0.0f, 0.0f, 1.0f);
    return axis == 'x'   ? (revolution_frame) { y, z, x }
           : axis == 'y' ? (revolution_frame) { z, x, y }
                         : (revolution_frame) { x, y, z };
}

static void put_revolved(const scene_shaper *shaper, const shape_revolution *solid,
                         const revolution_frame *frame, shape_point point, shape_point normal,
                         float angle, scene_vertex *vertex) {
    const float c = cosf(angle), s = sinf(angle);
    float scale = 1.0f, slope = 0.0f;
    if (solid->flutes > 0) {
        /* round hollows with arrises between them: |sin| */
        const float half_flutes = 0.5f * (float)solid->flutes;
        const float wave = sinf(half_flutes * angle);
        scale = 1.0f - solid->depth * fabsf(wave);
        slope = -solid->depth * half_flutes * cosf(half_flutes * angle) *
                (wave < 0.0f ? -1.0f : 1.0f) / scale;
    }
    const lmp_vec3 radial = vec_add(vec_scale(frame->first, c), vec_scale(frame->second, s));
    const lmp_vec3 around = vec_add(vec_scale(frame->first, -s), vec_scale(frame->second, c));
    lmp_vec3 position = vec_add(solid->origin, vec_scale(radial, scale * point.r));
    position = vec_add(position, vec_scale(frame->axis, point.a));
    lmp_vec3 n = vec_add(vec_scale(radial, normal.r), vec_scale(around, -slope * normal.r));
    n = vec_add(n, vec_scale(frame->axis, normal.a));
    put_vertex(shaper, vertex, position, n, angle * point.r, point.a);
}

/* Returns the solid with as much detail as the shaper gives. */
static shape_revolution simplify(const scene_shaper *shaper, const shape_revolution *solid) {
    shape_revolution simple = *solid;
    simple.segments = shaper_steps(shaper, solid->segments);
    simple.flutes = simple.segments < solid->segments ? 0 : solid->flutes;
    return simple;
}

void shape_revolve(scene_shaper *shaper, const shape_revolution *revolution) {
    const shape_revolution simple = simplify(shaper, revolution), *const solid = &simple;
    const revolution_frame frame = frame_of_axis(solid->axis);
    const bool whole = solid->from == solid->to;
    const float from = solid->from, to = whole ? solid->from + 2.0f * PI : solid->to;
    const uint32_t across = (uint32_t)solid->segments + 1;
    for (int i = 0; i + 1 < solid->point_count; i++) {
        const segment_normals normals = normals_of_segment(solid->profile, solid->point_count, i);
        const uint32_t first = (uint32_t)builder_count(shaper->builder, BLOB_VERTICES);
        scene_vertex *vertices = builder_append(shaper->builder, BLOB_VERTICES, 2 * (size_t)across);
        uint32_t *indices = grow_triangles(shaper, 6 * (size_t)solid->segments);
        if (!vertices || !indices)
            return;
        for (uint32_t k = 0; k < across; k++) {
            const float angle = from + (to - from) * (float)k / (float)solid->segments;
            put_revolved(shaper, solid, &frame, solid->profile[i], normals.start, angle,
                         &vertices[2 * k]);
            put_revolved(shaper, solid, &frame, solid->profile[i + 1], normals.end, angle,
                         &vertices[2 * k + 1]);
        }
        for (uint32_t k = 0; k + 1 < across; k++)
            put_quad_indices(indices + 6 * k, first + 2 * k, first + 2 * k + 2, first + 2 * k + 3,
                             first + 2 * k + 1);
    }
}

void shape_sweep(scene_shaper *shaper, const shape_point *profile, int point_count, lmp_vec3 origin,
                 float from_x, float to_x) {
    for (int i = 0; i + 1 < point_count; i++) {
        const segment_normals normals = normals_of_segment(profile, point_count, i);
        const uint32_t first = (uint32_t)builder_count(shaper->builder, BLOB_VERTICES);
        scene_vertex *vertices = builder_append(shaper->builder, BLOB_VERTICES, 4);
        uint32_t *indices = grow_triangles(shaper, 6);
        if (!vertices || !indices)
            return;
        for (uint32_t k = 0; k < 4; k++) {
            const shape_point p = profile[i + (int)(k >> 1)];
            const shape_point n = k >> 1 ? normals.end : normals.start;
            const float x = k & 1 ? to_x : from_x;
            put_vertex(shaper, &vertices[k], vec_add(origin, vec(x, p.a, p.r)), vec(0.0f, n.a, n.r),
                       x, p.a);
        }
        put_quad_indices(indices, first, first + 1, first + 3, first + 2);
    }
}
