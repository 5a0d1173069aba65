/* SPDX-License-Identifier: MIT */
/* shade_lights.h - the lights of a frame in the library's form. */
#ifndef LAMPION_RENDER_SHADE_LIGHTS_H
#define LAMPION_RENDER_SHADE_LIGHTS_H

#include "app/render/surfaces.h"

/* Returns the frame's light_count lights, to be freed by the caller; NULL if memory ran out. */
lmp_light *shade_lights(const render_frame *frame);

#endif
