/* SPDX-License-Identifier: MIT */
/* light_buffer.h - the lights of a frame where shaders read them. */
#ifndef LAMPION_RENDER_GL_LIGHT_BUFFER_H
#define LAMPION_RENDER_GL_LIGHT_BUFFER_H

#include "app/render/gl/texels.h"
#include "app/scene/scene.h"
#include "shaders/program/shared.h"

/* A buffer of SHARED_LIGHTS_MAX lights, and a copy of it in memory; the texels of those that are
 * areas. */
typedef struct gpu_lights {
    GLuint block;
    shared_light *all;
    size_t shaded; /* in use */
    gpu_texels areas;
    size_t area_count;
} gpu_lights;

bool gpu_lights_create(gpu_lights *own);
void gpu_lights_free(gpu_lights *own);
bool gpu_lights_upload(gpu_lights *own, const scene_light *lights, size_t count);

#endif
