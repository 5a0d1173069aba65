/* SPDX-License-Identifier: MIT */
/* Draws an area as light.frag draws spheres. */
#include "shared.h"
#include "texels.glsl"
#include "areas.glsl"
#include "area_hit.glsl"
#define LIGHT_AREAS
#include "light.frag"
