/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_glow.h"

#include "app/scene/instance.h"
#include "app/truth/reference_vector.h"

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

/* Adds an instance's triangles. A double-sided body shines outward. */
static size_t add_triangles(const scene *world, const scene_light *glow, scene_light *to) {
    const size_t instance = glow->glow - 1;
    const scene_material *material = &world->materials[scene_instance_material(world, instance)];
    const bool body = material->flags & SCENE_DOUBLE_SIDED &&
                      !(material->flags & SCENE_SIDES_UNSAID) && !glow->glows_both;
    const bool turned = body && volume_of(world, instance) < 0;
    size_t added = 0;
    for (uint32_t t = 0; t < scene_instance_triangles(world, instance); t++) {
        float p[3][3];
        scene_triangle_positions(world, instance, t, p);
        if (!has_area(p))
            continue;
        scene_light *light = &to[added++];
        *light = (scene_light) { .hidden = 1 };
        lmp_vec3 corner[3];
        for (int i = 0; i < 3; i++) {
            const float *at = p[turned ? 2 - i : i];
            corner[i] = (lmp_vec3) { at[0] - p[0][0], at[1] - p[0][1], at[2] - p[0][2] };
        }
        light->emitter = scene_light_polygon((lmp_vec3) { p[0][0], p[0][1], p[0][2] }, corner, 3);
        light->emitter.radiance =
            (lmp_rgb) { material->emission[0], material->emission[1], material->emission[2] };
        light->emitter.two_sided = glow->glows_both;
    }
    return added;
}

/* Whether a light is the first of those that stand for an instance: they follow each other. */
static bool is_first(const scene *world, size_t light) {
    return light == 0 || world->lights[light - 1].glow != world->lights[light].glow;
}

bool reference_glow_lights(const scene *world, scene_light **lights, size_t *count) {
    size_t triangles = 0, used = 0;
    *count = 0;
    *lights = malloc((world->light_count + REFERENCE_GLOW_MAX + 1) * sizeof **lights);
    if (!*lights)
        return false;
    for (size_t i = 0; i < world->light_count; i++) {
        const scene_light *light = &world->lights[i];
        const size_t more = light->glow ? scene_instance_triangles(world, light->glow - 1) : 0;
        const bool first = is_first(world, i);
        if (first)
            used = triangles + more <= REFERENCE_GLOW_MAX ? more : 0;
        if (light->glow && used > 0) {
            if (first) {
                *count += add_triangles(world, light, *lights + *count);
                triangles += more;
            }
        } else
            (*lights)[(*count)++] = *light;
    }
    return true;
}
