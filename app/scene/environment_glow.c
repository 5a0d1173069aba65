/* SPDX-License-Identifier: MIT */
/* environment_glow.c - whether a scene's emissive meshes, such as headlights or eyes, give enough
 * light to see the scene. */
#include "app/scene/environment.h"
#include "app/scene/instance.h"
#include "app/scene/vector.h"

#include <stdlib.h>

enum { PAIRS_MAX = 1 << 19 }; /* of triangles and lights that are evaluated */
#define LIT_PART  0.4f /* of the area facing the camera: with less lit, lights do not suffice */
#define LIT_STOPS 64   /* times darker than the brightest twentieth counts as black */
#define FAINT     1.0f /* emission, as white paper in the studio: glTF's without a strength */

/* A triangle that faces the camera: its area, and the irradiance at its center. */
typedef struct facing {
    float irradiance, area;
} facing;

static int compare_irradiance(const void *a, const void *b) {
    const float x = ((const facing *)a)->irradiance, y = ((const facing *)b)->irradiance;
    return (x > y) - (x < y);
}

/* Whether all lights are hidden spheres and areas, which stand for emissive meshes. */
static bool glows_alone(const scene *s) {
    for (size_t i = 0; i < s->light_count; i++)
        if (!s->lights[i].hidden || !(scene_light_extent(&s->lights[i].emitter) > 0))
            return false;
    return s->light_count > 0;
}

/* Whether no mesh glows brighter than paper in a studio: such a glow is made to be seen, on eyes
 * and screens, in the light of others. */
static bool glows_faintly(const scene *s) {
    for (size_t i = 0; i < s->light_count; i++) {
        const uint32_t glow = s->lights[i].glow;
        if (glow == 0)
            return false;
        if (!(rgb_brightest(s->materials[scene_instance_material(s, glow - 1)].emission) <= FAINT))
            return false;
    }
    return true;
}

/* Whether all of an instance glows: where there is an emission map, mostly small spots do. */
static bool glows(const scene *s, size_t instance) {
    const scene_material *material = &s->materials[scene_instance_material(s, instance)];
    const float *emission = material->emission;
    return emission[0] + emission[1] + emission[2] > 0 && material->emission_map.texture < 0;
}

static bool look_at(const scene *s, const float corners[3][3], lmp_vec3 eye, facing *found) {
    const lmp_vec3 a = vec_load(corners[0]), b = vec_load(corners[1]), c = vec_load(corners[2]);
    const lmp_vec3 cross = vec_cross(vec_sub(b, a), vec_sub(c, a));
    const lmp_vec3 middle = vec_scale(vec_add(a, vec_add(b, c)), 1 / 3.0f);
    const float length = vec_length(cross);
    if (!(length > 0 && vec_dot(cross, vec_sub(eye, middle)) > 0))
        return false;
    const lmp_vec3 normal = vec_scale(cross, 1 / length);
    *found = (facing) { 0, 0.5f * length };
    for (size_t i = 0; i < s->light_count; i++) {
        const lmp_rgb rgb = lmp_light_irradiance(&s->lights[i].emitter, 1, middle, normal);
        found->irradiance += rgb.r + rgb.g + rgb.b;
    }
    return true;
}

/* Collects every `step`-th triangle of the scene if it faces the camera and does not glow itself;
 * returns how many there are. */
static size_t collect(const scene *s, size_t step, lmp_vec3 eye, facing *found) {
    size_t count = 0, next = 0, first = 0;
    for (size_t i = 0; i < s->instance_count; i++) {
        const size_t triangles = scene_instance_triangles(s, i);
        for (; next < first + triangles; next += step) {
            float corners[3][3];
            if (glows(s, i))
                continue;
            scene_triangle_positions(s, i, (uint32_t)(next - first), corners);
            count += look_at(s, (const float(*)[3])corners, eye, &found[count]);
        }
        first += triangles;
    }
    return count;
}

/* Returns the fraction of the area that is not black compared with the brightest part. */
static float lit_part(facing *found, size_t count) {
    double all = 0, above = 0, lit = 0;
    size_t i = count;
    for (size_t k = 0; k < count; k++)
        all += (double)found[k].area;
    qsort(found, count, sizeof *found, compare_irradiance);
    while (i > 0 && above < 0.05 * all)
        above += (double)found[--i].area;
    const float least = i < count ? found[i].irradiance / LIT_STOPS : 0;
    for (size_t k = 0; k < count; k++)
        lit += found[k].irradiance > least ? (double)found[k].area : 0;
    return all > 0 ? (float)(lit / all) : 1;
}

bool environment_lights_suffice(const scene *s) {
    size_t triangles = 0;
    if (!glows_alone(s))
        return s->light_count > 0;
    if (glows_faintly(s) && !scene_is_inside(s))
        return false; /* a room may be made to be lit by it */
    for (size_t i = 0; i < s->instance_count; i++)
        triangles += scene_instance_triangles(s, i);
    const size_t most = 1 + PAIRS_MAX / s->light_count, step = 1 + triangles / most;
    const scene_camera camera = scene_default_camera(s, 1);
    facing *found = malloc((triangles / step + 1) * sizeof *found);
    if (!found)
        return true;
    const float part = lit_part(found, collect(s, step, vec_load(camera.eye), found));
    free(found);
    return part >= LIT_PART;
}
