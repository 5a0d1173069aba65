/* SPDX-License-Identifier: MIT */
/* lights.c - packed lights as the shaders take them. */
#include "app/render/gl/block.h"

#include "src/light/packed.h"

/* Any size below 0 is a Dirac's: of infinities GLSL promises nothing. */
static float size_of(const lmp_packed_light *light) {
    return light->size < 0 ? -1 : light->size;
}

static shared_light make(lmp_vec3 at, float size, lmp_rgb color, int form) {
    return (shared_light) { .sphere = { at.x, at.y, at.z, size },
                            .radiance = { color.r, color.g, color.b, (float)form } };
}

/* A falloff of 0 at the outer angle and 1 at the inner one, linear in the cosine. */
static void set_cone(const lmp_packed_light *light, float cone[4]) {
    const float steep = 1 / light->width;
    cone[0] = light->axis.x * steep;
    cone[1] = light->axis.y * steep;
    cone[2] = light->axis.z * steep;
    cone[3] = -light->outer * steep;
}

/* What it adds from every direction goes to `ambient`. */
static shared_light take_light(const scene_light *light, lmp_rgb *ambient) {
    lmp_packed_light packed;
    lmp_light_pack(&light->emitter, &packed);
    const int seen = scene_light_is_drawn(light) ? SHARED_LIGHT_DRAWN : SHARED_LIGHT_HIDDEN;
    const int form = packed.fixed                   ? SHARED_LIGHT_FIXED
                     : packed.form == LMP_FORM_CONE ? SHARED_LIGHT_CONE
                                                    : seen;
    shared_light to = make(packed.at, size_of(&packed), packed.color, form);
    if (packed.form == LMP_FORM_CONE)
        set_cone(&packed, to.cone);
    ambient->r += packed.ambient.r;
    ambient->g += packed.ambient.g;
    ambient->b += packed.ambient.b;
    return to;
}

size_t gpu_take_lights(const scene_light *lights, size_t count, shared_light *block) {
    lmp_rgb ambient = { 0, 0, 0 };
    for (size_t i = 0; i < count; i++)
        block[i] = take_light(&lights[i], &ambient);
    if (ambient.r > 0 || ambient.g > 0 || ambient.b > 0)
        block[count++] = make((lmp_vec3) { 0, 0, 1 }, 2, ambient, SHARED_LIGHT_FIXED);
    return count;
}
