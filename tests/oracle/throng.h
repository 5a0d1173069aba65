/* SPDX-License-Identifier: MIT */
/* throng.h - a scene that consists mostly of instances, and the same scene without instances. */
#ifndef LAMPION_TESTS_THRONG_H
#define LAMPION_TESTS_THRONG_H

#include "app/scene/builtin/builtin.h"
#include "app/scene/flatten.h"
#include "app/scene/instance.h"
#include "tests/oracle/check.h"

#include <math.h>

/* Places an instance by any rotation, with scales from 0.2 to 1.2, every third one mirrored, every
 * fourth stretched. */
static inline void throng_place(int number, uint32_t mesh, scene_instance *instance) {
    double m[16] = { [15] = 1.0 }, q[4], length = 0.0;
    for (int i = 0; i < 4; i++) {
        q[i] = check_random_between(-1.0, 1.0);
        length += q[i] * q[i];
    }
    for (int i = 0; i < 4; i++)
        q[i] /= sqrt(length);
    for (int column = 0; column < 3; column++) {
        const int next = (column + 1) % 3, last = (column + 2) % 3;
        double scale = 0.2 + (number % 5) / 4.0;
        if (number % 4 == 1 && column == 1)
            scale *= 0.6;
        if (number % 3 == 2 && column == 2)
            scale = -scale;
        m[4 * column + column] = scale * (1.0 - 2.0 * (q[next] * q[next] + q[last] * q[last]));
        m[4 * column + next] = scale * 2.0 * (q[column] * q[next] + q[last] * q[3]);
        m[4 * column + last] = scale * 2.0 * (q[column] * q[last] - q[next] * q[3]);
        m[12 + column] = check_random_between(-4.0, 4.0);
    }
    assert_true(scene_instance_set(instance, m));
    instance->mesh = mesh;
}

/* Opens builtin:balls with `count` more instances of its meshes; flattened, every mesh stands in
 * the world. The random numbers continue: seed them alike to get the same throng. */
static inline scene throng_open(int count, bool flattened) {
    scene_builder builder = { 0 };
    void *block;
    size_t size;
    scene world = { .block = NULL };
    base_error error = { "" };
    assert_true(builtin_make("balls", &builder, &error));
    const uint32_t meshes = (uint32_t)builder_count(&builder, BLOB_MESHES);
    scene_instance *instances = builder_append(&builder, BLOB_INSTANCES, (size_t)count);
    assert_non_null(instances);
    for (int i = 0; i < count; i++)
        throng_place(i, (uint32_t)i % meshes, &instances[i]);
    if (flattened)
        builder_flatten(&builder);
    assert_true(builder_pack(&builder, &block, &size));
    builder_free(&builder);
    if (!blob_validate(block, size, false, "throng", &error) ||
        !blob_open(block, size, "throng", &world, &error))
        fail_msg("%s", error.text);
    return world;
}

#endif
