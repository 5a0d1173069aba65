/* SPDX-License-Identifier: MIT */
/* Animation files: lights stay finite wherever they are moved. */
#include "app/scene/animation.h"
#include "fuzz/file.h"

#include <math.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static scene world;
    static scene_light moved[SCENE_LIGHTS_MAX];
    base_error error;
    char path[64];
    animation *read = NULL;
    if (!world.block && !scene_load("builtin:ball", NULL, &world, &error))
        abort();
    if (!fuzz_file_write(data, size, ".json", path))
        abort();
    if (animation_open(path, &world, &read, &error) != (read != NULL))
        abort();
    unlink(path);
    for (double seconds = 0; read && seconds < 20; seconds += 1.7) {
        animation_move_all(read, &world, seconds, moved);
        for (size_t i = 0; i < world.light_count; i++)
            for (int k = 0; k < 3; k++)
                if (!isfinite((&moved[i].emitter.position.x)[k]))
                    abort();
    }
    animation_close(read);
    return 0;
}
