/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/transfer_surfels.h"

#include "app/scene/instance.h"
#include "app/scene/texture_at.h"
#include "app/scene/vector.h"

#include <stdlib.h>

void transfer_sequence(double k, double shift, double xy[2]) {
    xy[0] = 0.7548776662466927 * k + 0.6180339887498949 * shift;
    xy[1] = 0.5698402909980532 * k + 0.4142135623730950 * shift;
}

void transfer_weights(size_t k, float weights[3]) {
    double xy[2];
    transfer_sequence((double)k, 0, xy);
    float u = (float)(xy[0] - floor(xy[0])), v = (float)(xy[1] - floor(xy[1]));
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    weights[0] = 1 - u - v;
    weights[1] = u;
    weights[2] = v;
}

float transfer_face(float corners[3][3], lmp_vec3 *normal) {
    const lmp_vec3 p = vec_load(corners[0]);
    const lmp_vec3 twice =
        vec_cross(vec_sub(vec_load(corners[1]), p), vec_sub(vec_load(corners[2]), p));
    *normal = vec_normalize(twice, vec(0, 1, 0));
    return vec_length(twice) / 2;
}

/* --- what a point reflects -------------------------------------------------------------------- */

static void sample(const scene *world, const scene_texture_use *use, const scene_vertex corners[3],
                   const float weights[3], double rgba[4]) {
    double uv[2] = { 0, 0 };
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++)
            uv[k] += (double)weights[i] * (double)corners[i].uv[use->set][k];
    texture_at(world, use, uv, rgba);
}

static float within_one(double x) {
    return (float)(x < 0 ? 0 : x > 1 ? 1 : x);
}

/* Returns the fraction of light that a point of a triangle reflects, the specular part seen along
 * the normal included. */
static lmp_rgb albedo_at(const scene *world, const scene_material *m, const scene_vertex corners[3],
                         const float weights[3]) {
    double color[4], rough[4], albedo[3];
    sample(world, &m->base_color_map, corners, weights, color);
    sample(world, &m->metallic_roughness_map, corners, weights, rough);
    const double metallic = rough[2] * (double)m->metallic;
    for (int c = 0; c < 3; c++) {
        double vertex = m->flags & SCENE_VERTEX_COLORS ? 0 : 1;
        for (int i = 0; i < 3 && m->flags & SCENE_VERTEX_COLORS; i++)
            vertex += (double)weights[i] * (double)corners[i].color[c] / 65535;
        const double base = color[c] * vertex * (double)m->base_color[c];
        const double f0 = (double)m->f0[c];
        albedo[c] = metallic * base + (1 - metallic) * (f0 + (1 - f0) * base);
    }
    return (lmp_rgb) { within_one(albedo[0]), within_one(albedo[1]), within_one(albedo[2]) };
}

/* --- points ----------------------------------------------------------------------------------- */

static bool is_double_sided(const scene *world, size_t instance) {
    return world->materials[scene_instance_material(world, instance)].flags & SCENE_DOUBLE_SIDED;
}

/* Returns the area of the sides that have surfels. */
static double sided_area(const scene *world) {
    double area = 0;
    for (size_t i = 0; i < world->instance_count; i++) {
        const double sides = is_double_sided(world, i) ? 2 : 1;
        for (uint32_t t = 0; t < scene_instance_triangles(world, i); t++) {
            float corners[3][3];
            lmp_vec3 normal;
            scene_triangle_positions(world, i, t, corners);
            area += sides * (double)transfer_face(corners, &normal);
        }
    }
    return area;
}

/* Adds a surfel, on both sides if the material has two. */
static void add_point(const scene *world, const lmp_rgb *albedos, size_t instance,
                      uint32_t triangle, lmp_vec3 normal, transfer_surfels *s) {
    const uint32_t material = scene_instance_material(world, instance);
    scene_vertex corners[3];
    float weights[3];
    scene_triangle(world, instance, triangle, corners);
    transfer_weights(s->count, weights);
    lmp_vec3 position = { 0, 0, 0 };
    for (int i = 0; i < 3; i++)
        position = vec_add(position, vec_scale(vec_load(corners[i].position), weights[i]));
    const lmp_rgb albedo = albedos && albedos[material].r >= 0
                               ? albedos[material]
                               : albedo_at(world, &world->materials[material], corners, weights);
    const lmp_transfer_surfel front = { position, normal, albedo, TRANSFER_REACH * s->spacing };
    s->at[s->count++] = front;
    if (is_double_sided(world, instance)) {
        s->at[s->count] = front;
        s->at[s->count++].normal = vec_scale(normal, -1);
    }
}

/* Walks over the triangles, and adds a point wherever the area so far passes a multiple of what a
 * surfel stands for. */
static void add_points(const scene *world, const lmp_rgb *albedos, transfer_surfels *s) {
    const double each = (double)s->spacing * (double)s->spacing;
    double left = each / 2;
    for (size_t i = 0; i < world->instance_count; i++)
        for (uint32_t t = 0; t < scene_instance_triangles(world, i); t++) {
            float corners[3][3];
            lmp_vec3 normal;
            scene_triangle_positions(world, i, t, corners);
            left -= (double)transfer_face(corners, &normal);
            for (; left < 0 && s->count + 1 < 2 * TRANSFER_SURFELS_MAX; left += each)
                add_point(world, albedos, i, t, normal, s);
        }
}

bool transfer_surfels_make(const scene *world, const lmp_rgb *albedos, transfer_surfels *s) {
    const double area = sided_area(world);
    const lmp_vec3 extent = vec_sub(vec_load(world->maximum), vec_load(world->minimum));
    *s = (transfer_surfels) { .at = malloc(2 * TRANSFER_SURFELS_MAX * sizeof *s->at) };
    s->spacing =
        fmaxf(vec_length(extent) / TRANSFER_SPACINGS, (float)sqrt(area / TRANSFER_SURFELS_MAX));
    if (s->at && area > 0)
        add_points(world, albedos, s);
    return s->at != NULL;
}
