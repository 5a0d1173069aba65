/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_glow.h"

#include "app/scene/instance.h"
#include "app/scene/texture_at.h"

#include <stdlib.h>

/* Returns six times the volume that an instance encloses; below 0 if its fronts are inside. */
static double volume_of(const scene *world, size_t instance) {
    double sum = 0;
    float first[3][3];
    scene_triangle_positions(world, instance, 0, first);
    const reference_vec origin = reference_from_floats(first[0]);
    for (uint32_t t = 0; t < scene_instance_triangles(world, instance); t++) {
        float p[3][3];
        scene_triangle_positions(world, instance, t, p);
        const reference_vec a = reference_subtract(reference_from_floats(p[0]), origin),
                            b = reference_subtract(reference_from_floats(p[1]), origin),
                            c = reference_subtract(reference_from_floats(p[2]), origin);
        sum += reference_dot(a, reference_cross(b, c));
    }
    return sum;
}

static bool has_area(float p[3][3]) {
    const reference_vec a = reference_from_floats(p[0]), b = reference_from_floats(p[1]),
                        c = reference_from_floats(p[2]);
    return reference_length(reference_cross(reference_subtract(b, a), reference_subtract(c, a))) >
           0;
}

/* A triangle that lights: where it is, and which coordinates its corners have. */
struct reference_glow_triangle {
    const scene_texture_use *map; /* NULL: the light is uniform */
    const float *emission;
    reference_vec corner[3];
    double uv[3][2];
};

static void find_triangle(const scene *world, size_t instance, uint32_t number, float p[3][3],
                          struct reference_glow_triangle *to) {
    const scene_material *material = &world->materials[scene_instance_material(world, instance)];
    const scene_vertex *corners[3];
    scene_triangle_vertices(world, instance, number, corners);
    to->map = material->emission_map.texture < 0 ? NULL : &material->emission_map;
    to->emission = material->emission;
    for (int i = 0; i < 3; i++) {
        to->corner[i] = reference_from_floats(p[i]);
        for (int k = 0; to->map && k < 2; k++)
            to->uv[i][k] = (double)corners[i]->uv[to->map->set][k];
    }
}

/* Returns the mean radiance of a triangle. */
static lmp_rgb mean_of(const scene *world, struct reference_glow_triangle *triangle) {
    double rgba[4] = { 1, 1, 1, 1 };
    if (triangle->map)
        texture_mean_at(world, triangle->map, triangle->uv, rgba);
    return (lmp_rgb) { (float)(rgba[0] * (double)triangle->emission[0]),
                       (float)(rgba[1] * (double)triangle->emission[1]),
                       (float)(rgba[2] * (double)triangle->emission[2]) };
}

static scene_light light_of(float p[3][3], bool turned, bool both, lmp_rgb radiance) {
    lmp_vec3 corner[3];
    for (int i = 0; i < 3; i++) {
        const float *at = p[turned ? 2 - i : i];
        corner[i] = (lmp_vec3) { at[0] - p[0][0], at[1] - p[0][1], at[2] - p[0][2] };
    }
    scene_light light = { .hidden = 1 };
    light.emitter = scene_light_polygon((lmp_vec3) { p[0][0], p[0][1], p[0][2] }, corner, 3);
    light.emitter.radiance = radiance;
    light.emitter.two_sided = both;
    return light;
}

/* Adds an instance's triangles but those that are black. A double-sided body shines outward. */
static void add_triangles(const scene *world, const scene_light *stands, reference_glow *glow) {
    const size_t instance = stands->glow - 1;
    const scene_material *material = &world->materials[scene_instance_material(world, instance)];
    const bool body = material->flags & SCENE_DOUBLE_SIDED &&
                      !(material->flags & SCENE_SIDES_UNSAID) && !stands->glows_both;
    const bool turned = body && volume_of(world, instance) < 0;
    for (uint32_t t = 0; t < scene_instance_triangles(world, instance); t++) {
        float p[3][3];
        struct reference_glow_triangle *triangle = &glow->triangles[glow->count];
        scene_triangle_positions(world, instance, t, p);
        if (!has_area(p))
            continue;
        find_triangle(world, instance, t, p, triangle);
        const lmp_rgb mean = mean_of(world, triangle);
        if (mean.r > 0 || mean.g > 0 || mean.b > 0)
            glow->lights[glow->count++] = light_of(p, turned, stands->glows_both, mean);
    }
}

/* Whether a light is the first of those that stand for an instance: they follow each other. */
static bool is_first(const scene *world, size_t light) {
    return light == 0 || world->lights[light - 1].glow != world->lights[light].glow;
}

static void add_all(const scene *world, reference_glow *glow) {
    size_t triangles = 0, used = 0;
    for (size_t i = 0; i < world->light_count; i++) {
        const scene_light *light = &world->lights[i];
        const size_t more = light->glow ? scene_instance_triangles(world, light->glow - 1) : 0;
        const bool first = is_first(world, i);
        if (first)
            used = triangles + more <= REFERENCE_GLOW_MAX ? more : 0;
        if (light->glow && used > 0) {
            if (first) {
                add_triangles(world, light, glow);
                triangles += more;
            }
        } else {
            glow->triangles[glow->count].map = NULL;
            glow->lights[glow->count++] = *light;
        }
    }
}

bool reference_glow_create(const scene *world, reference_glow *glow) {
    const size_t most = world->light_count + REFERENCE_GLOW_MAX + 1;
    *glow = (reference_glow) { .world = world,
                               .lights = malloc(most * sizeof *glow->lights),
                               .triangles = malloc(most * sizeof *glow->triangles) };
    if (!glow->lights || !glow->triangles) {
        reference_glow_free(glow);
        return false;
    }
    add_all(world, glow);
    return true;
}

void reference_glow_free(reference_glow *glow) {
    free(glow->lights);
    free(glow->triangles);
    *glow = (reference_glow) { .lights = NULL };
}

/* Finds the weights of a triangle's corners at a point of it: the parts of its area that lie
 * opposite to them. */
static void weigh_corners(const struct reference_glow_triangle *t, reference_vec point,
                          double weight[3]) {
    const reference_vec a = reference_subtract(t->corner[1], t->corner[0]),
                        b = reference_subtract(t->corner[2], t->corner[0]),
                        off = reference_subtract(point, t->corner[0]),
                        normal = reference_cross(a, b);
    const double whole = reference_dot(normal, normal);
    weight[1] = reference_dot(reference_cross(off, b), normal) / whole;
    weight[2] = reference_dot(reference_cross(a, off), normal) / whole;
    weight[0] = 1 - weight[1] - weight[2];
}

void reference_glow_emission(size_t light, reference_vec point, double radiance[3], void *user) {
    const reference_glow *glow = user;
    const struct reference_glow_triangle *t = &glow->triangles[light];
    double weight[3], uv[2] = { 0, 0 }, rgba[4];
    if (!t->map)
        return;
    weigh_corners(t, point, weight);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++)
            uv[k] += weight[i] * t->uv[i][k];
    texture_at(glow->world, t->map, uv, rgba);
    for (int c = 0; c < 3; c++)
        radiance[c] = rgba[c] * (double)t->emission[c];
}
