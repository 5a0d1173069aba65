/* SPDX-License-Identifier: MIT */
#include "app/scene/phong.h"

#include <math.h>

#define METAL_SPECULAR_MIN        0.25f /* the specular color of a metal, at least, */
#define METAL_SPECULAR_TO_DIFFUSE 2.0f  /* and at least this many times the diffuse one */

static float brightest(const float color[3]) {
    return fmaxf(color[0], fmaxf(color[1], color[2]));
}

static float clamp_unit(float x) {
    return fminf(fmaxf(x, 0.0f), 1.0f);
}

void phong_apply(const phong *from, scene_material *to) {
    const float specular = brightest(from->specular);
    const bool metal = specular >= METAL_SPECULAR_MIN &&
                       specular > METAL_SPECULAR_TO_DIFFUSE * brightest(from->diffuse);
    for (int k = 0; k < 3; k++) {
        to->base_color[k] = clamp_unit(metal ? from->specular[k] : from->diffuse[k]);
        to->emission[k] = fmaxf(from->emission[k], 0.0f);
    }
    to->base_color[3] = clamp_unit(from->opacity);
    to->flags |= SCENE_DOUBLE_SIDED | SCENE_SIDES_UNSAID;
    to->metallic = metal ? 1.0f : 0.0f;
    to->roughness = 1.0f;
    if (specular > 0.0f && from->exponent > 0.0f)
        to->roughness = fminf(1.0f, sqrtf(sqrtf(2.0f / (from->exponent + 2.0f))));
    if (to->base_color[3] < 1.0f)
        to->flags |= SCENE_ALPHA_BLEND;
}
