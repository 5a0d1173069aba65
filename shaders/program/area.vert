/* SPDX-License-Identifier: MIT */
/* Draws a cube around each area as light.vert does around spheres. */
#include "shared.h"
#include "texels.glsl"
#include "areas.glsl"
#define LIGHT_AREAS
#include "light.vert"
