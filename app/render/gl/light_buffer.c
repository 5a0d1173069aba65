/* SPDX-License-Identifier: MIT */
#include "app/render/gl/light_buffer.h"
#include "app/render/gl/block.h"

#include <stdlib.h>

bool gpu_lights_create(gpu_lights *own) {
    const size_t size = SHARED_LIGHTS_MAX * sizeof *own->all;
    own->all = malloc(size);
    glCreateBuffers(1, &own->block);
    glNamedBufferStorage(own->block, (GLsizeiptr)size, NULL, GL_DYNAMIC_STORAGE_BIT);
    return own->all;
}

void gpu_lights_free(gpu_lights *own) {
    glDeleteBuffers(1, &own->block);
    gpu_texels_free(&own->areas);
    free(own->all);
}

static bool upload_areas(gpu_lights *own, const scene_light *lights, size_t count) {
    const size_t size = own->area_count * LMP_AREA_TEXELS * sizeof(vec4);
    vec4 *texels = malloc(size);
    if (!texels)
        return false;
    gpu_take_areas(lights, count, texels);
    gpu_texels_create(&own->areas, size, texels);
    free(texels);
    return true;
}

bool gpu_lights_upload(gpu_lights *own, const scene_light *lights, size_t count) {
    own->shaded = gpu_take_lights(lights, count, own->all);
    if (own->shaded)
        glNamedBufferSubData(own->block, 0, (GLsizeiptr)(own->shaded * sizeof *own->all), own->all);
    own->area_count = scene_count_areas(lights, count);
    return own->area_count == 0 || upload_areas(own, lights, count);
}
