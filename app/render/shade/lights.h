/* SPDX-License-Identifier: MIT */
/* lights.h - the lights of a frame as the library takes them. */
#ifndef LAMPION_SHADE_LIGHTS_H
#define LAMPION_SHADE_LIGHTS_H

#include "app/render/frame/surfaces.h"

/* frame->light_count of them, for the caller to free; NULL without memory. */
lmp_light *shade_lights(const render_frame *frame);

#endif
