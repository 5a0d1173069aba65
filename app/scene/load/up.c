/* SPDX-License-Identifier: MIT */
#include "app/scene/load/up.h"
#include "app/scene/vector.h"

const char *const scene_up_names[] = { "auto", "y", "z", NULL };

/* Makes a z-up vector y-up, exactly: z becomes y, and y becomes -z. */
static lmp_vec3 standing(lmp_vec3 v) {
    return vec(v.x, v.z, -v.y);
}

static lmp_vec3 stand_vector(lmp_vec3 v, const void *unused) {
    (void)unused;
    return standing(v);
}

static void stand(float v[3]) {
    vec_store(standing(vec_load(v)), v);
}

static void stand_geometry(scene_builder *builder) {
    scene_instance *instances = builder_items(builder, BLOB_INSTANCES);
    for (size_t i = 0; i < builder_count(builder, BLOB_INSTANCES); i++)
        for (int column = 0; column < 4; column++) {
            float(*m)[4] = instances[i].world_from_mesh;
            const lmp_vec3 v = standing(vec(m[0][column], m[1][column], m[2][column]));
            m[0][column] = v.x;
            m[1][column] = v.y;
            m[2][column] = v.z;
        }
}

void up_stand(scene_builder *builder, int up) {
    if (up != SCENE_UP_AUTO)
        builder->up = up;
    else if (builder->up == SCENE_UP_AUTO)
        builder->up = SCENE_UP_Y;
    if (builder->up == SCENE_UP_Y)
        return;
    const double z = builder->origin[2];
    builder->origin[2] = 0.0 - builder->origin[1]; /* keeps 0 from becoming -0 */
    builder->origin[1] = z;
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
        scene_light_rotate(&lights[i].emitter, stand_vector, NULL);
    }
    lmp_vec3 *offsets = builder_items(builder, BLOB_OFFSETS);
    for (size_t i = 0; i < builder_count(builder, BLOB_OFFSETS); i++)
        offsets[i] = standing(offsets[i]);
}
