/* SPDX-License-Identifier: MIT */
#include "app/scene/up.h"
#include "app/scene/vector.h"

const char *const scene_up_names[] = { "y", "z", NULL };

/* Exact: z becomes y, and y becomes -z. */
static lmp_vec3 standing(lmp_vec3 v) {
    return vec(v.x, v.z, -v.y);
}

static void stand(float v[3]) {
    vec_store(standing(vec_load(v)), v);
}

static void stand_bounds(float minimum[3], float maximum[3]) {
    stand(minimum);
    stand(maximum);
    const float nearest = maximum[2];
    maximum[2] = minimum[2];
    minimum[2] = nearest;
}

static void stand_geometry(scene_builder *builder) {
    scene_vertex *vertices = builder_items(builder, BLOB_VERTICES);
    for (size_t i = 0; i < builder_count(builder, BLOB_VERTICES); i++) {
        stand(vertices[i].position);
        stand(vertices[i].normal);
        stand(vertices[i].tangent);
    }
    scene_mesh *meshes = builder_items(builder, BLOB_MESHES);
    for (size_t i = 0; i < builder_count(builder, BLOB_MESHES); i++)
        stand_bounds(meshes[i].minimum, meshes[i].maximum);
}

void up_stand(scene_builder *builder, int up) {
    if (up == SCENE_UP_Y)
        return;
    stand_geometry(builder);
    scene_camera *cameras = builder_items(builder, BLOB_CAMERAS);
    for (size_t i = 0; i < builder_count(builder, BLOB_CAMERAS); i++) {
        stand(cameras[i].eye);
        stand(cameras[i].target);
        stand(cameras[i].up);
    }
    scene_light *lights = builder_items(builder, BLOB_LIGHTS);
    for (size_t i = 0; i < builder_count(builder, BLOB_LIGHTS); i++) {
        lights[i].emitter.position = standing(lights[i].emitter.position);
        lights[i].emitter.direction = standing(lights[i].emitter.direction);
    }
    lmp_vec3 *offsets = builder_items(builder, BLOB_OFFSETS);
    for (size_t i = 0; i < builder_count(builder, BLOB_OFFSETS); i++)
        offsets[i] = standing(offsets[i]);
}
