/* SPDX-License-Identifier: MIT */
#include "app/render/shade_lights.h"

#include <stdlib.h>

lmp_light *shade_lights(const render_frame *frame) {
    lmp_light *lights = calloc(frame->light_count + 1, sizeof *lights);
    for (size_t i = 0; lights && i < frame->light_count; i++)
        lights[i] = frame->lights[i].emitter;
    return lights;
}
