/* SPDX-License-Identifier: MIT */
/* Lights files: either all lights of a file are read, finite and in range, or none. */
#include "app/scene/scene.h"
#include "fuzz/file.h"

#include <math.h>
#include <stdlib.h>

static void check(const lmp_light *light) {
    const float *position = &light->position.x, *radiance = &light->radiance.r;
    for (int i = 0; i < 3; i++)
        if (!isfinite(position[i]) || !(radiance[i] >= 0) || !isfinite(radiance[i]))
            abort();
    if (!(light->radius >= 0) || !isfinite(light->radius))
        abort();
    if (scene_light_is_area(light) && !(scene_light_extent(light) > 0))
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static scene world;
    base_error error;
    char path[64];
    if (!world.block && !scene_load("builtin:ball", NULL, &world, &error))
        abort();
    scene_clear_lights(&world);
    if (!fuzz_file_write(data, size, ".json", path))
        abort();
    if (!scene_add_lights_file(&world, path, &error) && world.light_count != 0)
        abort();
    unlink(path);
    for (size_t i = 0; i < world.light_count; i++)
        check(&world.lights[i].emitter);
    return 0;
}
