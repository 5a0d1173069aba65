/* SPDX-License-Identifier: MIT */
#include "app/scene/emission.h"

#include "app/scene/instance.h"
#include "app/scene/vector.h"

static double triangle_area(float corners[3][3]) {
    const lmp_vec3 a = vec_load(corners[0]), b = vec_load(corners[1]), c = vec_load(corners[2]);
    return 0.5 * (double)vec_length(vec_cross(vec_sub(b, a), vec_sub(c, a)));
}

static lmp_vec3 middle_of(const scene *s, size_t instance) {
    lmp_vec3 low = vec(INFINITY, INFINITY, INFINITY), high = vec_scale(low, -1.0f);
    for (uint32_t t = 0; t < scene_instance_triangles(s, instance); t++) {
        float corners[3][3];
        scene_triangle_positions(s, instance, t, corners);
        for (int i = 0; i < 3; i++) {
            const float *p = corners[i];
            low = vec(fminf(low.x, p[0]), fminf(low.y, p[1]), fminf(low.z, p[2]));
            high = vec(fmaxf(high.x, p[0]), fmaxf(high.y, p[1]), fmaxf(high.z, p[2]));
        }
    }
    return vec_scale(vec_add(low, high), 0.5f);
}

/* The sphere around the instance's box, shrunk to its farthest vertex, and its area. */
static float bounding_radius(const scene *s, size_t instance, lmp_vec3 center, double *area) {
    float radius = 0.0f;
    *area = 0.0;
    for (uint32_t t = 0; t < scene_instance_triangles(s, instance); t++) {
        float corners[3][3];
        scene_triangle_positions(s, instance, t, corners);
        for (int i = 0; i < 3; i++)
            radius = fmaxf(radius, vec_length(vec_sub(vec_load(corners[i]), center)));
        *area += triangle_area(corners);
    }
    return radius;
}

/* What glows too much is refused by the words of lights, whether a light stands for it or, with a
 * texture, none does. */
static bool check_emission(const scene_builder *builder, const char *subject, cli_error *error) {
    const scene_material *materials = builder_items(builder, BLOB_MATERIALS);
    for (size_t i = 0; i < builder_count(builder, BLOB_MATERIALS); i++)
        if (!scene_color_fits(materials[i].emission))
            return cli_fail(error, subject,
                            "material %zu (\"%s\"): its emission is negative, not finite or above "
                            "1e19",
                            i, materials[i].name);
    return true;
}

bool emission_add_lights(scene_builder *builder, const char *subject, cli_error *error) {
    const scene_material *materials = builder_items(builder, BLOB_MATERIALS);
    scene world;
    if (!check_emission(builder, subject, error))
        return false;
    builder_geometry(builder, &world);
    for (size_t i = 0; i < world.instance_count; i++) {
        const scene_material *material = &materials[world.meshes[world.instances[i].mesh].material];
        const float *emission = material->emission;
        if (material->emission_map.texture >= 0 ||
            material->flags & (SCENE_UNLIT | SCENE_GLOWS_ALONE) ||
            !(emission[0] + emission[1] + emission[2] > 0.0f))
            continue;
        double area;
        const lmp_vec3 center = middle_of(&world, i);
        const float radius = bounding_radius(&world, i, center, &area);
        if (!(radius > 0.0f))
            continue;
        scene_light *light = builder_append(builder, BLOB_LIGHTS, 1);
        if (!light)
            return cli_fail(error, subject, "does not fit into memory");
        const bool both =
            (material->flags & (SCENE_DOUBLE_SIDED | SCENE_SIDES_UNSAID)) == SCENE_DOUBLE_SIDED;
        const double sides = both ? 2.0 : 1.0;
        float radiance[3];
        for (int k = 0; k < 3; k++)
            radiance[k] = (float)(sides * area * M_PI * (double)emission[k] /
                                  (4.0 * M_PI * M_PI * (double)radius * (double)radius));
        light->hidden = 1;
        light->emitter =
            (lmp_light) { .position = center, .radius = radius, .radiance = rgb_load(radiance) };
        scene_light_error wrong;
        if (!scene_light_check(light, &wrong))
            return cli_fail(error, subject, "instance %zu of a mesh makes a light: %s", i,
                            wrong.text);
    }
    return true;
}
