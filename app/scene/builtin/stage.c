/* SPDX-License-Identifier: MIT */
#include "app/scene/builtin/stage.h"

#include "app/scene/vector.h"

uint32_t stage_material(scene_builder *builder, const char *name, lmp_rgb base_color,
                        float roughness, float metallic) {
    const uint32_t index = (uint32_t)builder_count(builder, BLOB_MATERIALS);
    scene_material *material = builder_material(builder, name);
    if (material) {
        material->base_color[0] = base_color.r;
        material->base_color[1] = base_color.g;
        material->base_color[2] = base_color.b;
        material->roughness = roughness;
        material->metallic = metallic;
    }
    return index;
}

void stage_light(scene_builder *builder, lmp_light light) {
    scene_light *const to = builder_append(builder, BLOB_LIGHTS, 1);
    if (to)
        to->emitter = light;
}

void stage_camera(scene_builder *builder, const char *name, lmp_vec3 eye, lmp_vec3 target,
                  float fov, float aspect) {
    scene_camera *camera = builder_append(builder, BLOB_CAMERAS, 1);
    if (!camera)
        return;
    scene_clean_name(camera->name, name);
    vec_store(eye, camera->eye);
    vec_store(target, camera->target);
    camera->up[1] = 1.0f;
    camera->fov = fov;
    camera->aspect = aspect;
}
