/* SPDX-License-Identifier: MIT */
#include "app/scene/emission.h"

#include "app/scene/vector.h"

static double triangle_area(const scene_vertex *vertices, const uint32_t *corners) {
    const lmp_vec3 a = vec_load(vertices[corners[0]].position);
    const lmp_vec3 b = vec_load(vertices[corners[1]].position);
    const lmp_vec3 c = vec_load(vertices[corners[2]].position);
    return 0.5 * (double)vec_length(vec_cross(vec_sub(b, a), vec_sub(c, a)));
}

/* The sphere around the mesh's box, shrunk to its farthest vertex, and its area. */
static float bounding_radius(const scene_builder *builder, const scene_mesh *mesh, lmp_vec3 center,
                             double *area) {
    const scene_vertex *vertices = builder_items(builder, BLOB_VERTICES);
    const uint32_t *indices = builder_items(builder, BLOB_INDICES);
    float radius = 0.0f;
    *area = 0.0;
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        const uint32_t *corner = indices + mesh->first_index + i;
        radius = fmaxf(radius, vec_length(vec_sub(vec_load(vertices[*corner].position), center)));
        if (i % 3 == 0)
            *area += triangle_area(vertices, corner);
    }
    return radius;
}

bool emission_add_lights(scene_builder *builder, const char *subject, cli_error *error) {
    const scene_mesh *meshes = builder_items(builder, BLOB_MESHES);
    const scene_material *materials = builder_items(builder, BLOB_MATERIALS);
    for (size_t i = 0; i < builder_count(builder, BLOB_MESHES); i++) {
        const scene_material *material = &materials[meshes[i].material];
        const float *emission = material->emission;
        if (material->emission_map.texture >= 0 || (material->flags & SCENE_UNLIT) ||
            !(emission[0] + emission[1] + emission[2] > 0.0f))
            continue;
        double area;
        const lmp_vec3 center =
            vec_scale(vec_add(vec_load(meshes[i].minimum), vec_load(meshes[i].maximum)), 0.5f);
        const float radius = bounding_radius(builder, &meshes[i], center, &area);
        if (!(radius > 0.0f))
            continue;
        scene_light *light = builder_append(builder, BLOB_LIGHTS, 1);
        if (!light)
            return cli_fail(error, subject, "does not fit into memory");
        const double sides = material->flags & SCENE_DOUBLE_SIDED ? 2.0 : 1.0;
        float radiance[3];
        for (int k = 0; k < 3; k++)
            radiance[k] = (float)(sides * area * M_PI * (double)emission[k] /
                                  (4.0 * M_PI * M_PI * (double)radius * (double)radius));
        light->hidden = 1;
        light->emitter =
            (lmp_light) { .position = center, .radius = radius, .radiance = rgb_load(radiance) };
    }
    return true;
}
