/* SPDX-License-Identifier: MIT */
/* lights.c - packed lights in the form that shaders read. */
#include "app/render/gl/block.h"

#include "src/light/packed.h"

/* Returns a light's size; any size below 0 means a Dirac, because GLSL guarantees nothing about
 * infinities. */
static float size_of(const lmpi_packed_light *light) {
    return light->size < 0 ? -1 : light->size;
}

static shared_light make(lmp_vec3 at, float size, lmp_rgb color, int form) {
    return (shared_light) { .sphere = { at.x, at.y, at.z, size },
                            .radiance = { color.r, color.g, color.b, (float)form } };
}

/* Sets a falloff of 0 at the outer angle and 1 at the inner one, linear in the cosine. */
static void set_cone(const lmpi_packed_light *light, float cone[4]) {
    const float steep = 1 / light->width;
    cone[0] = light->axis.x * steep;
    cone[1] = light->axis.y * steep;
    cone[2] = light->axis.z * steep;
    cone[3] = -light->outer * steep;
}

static_assert(SHARED_AREA_TEXELS == LMP_AREA_TEXELS, "shared.h has the number of light.h");

void gpu_take_areas(const scene_light *lights, size_t count, vec4 *texels) {
    for (size_t i = 0; i < count; i++)
        if (lmpi_light_is_area(&lights[i].emitter)) {
            lmp_light_copy_area_texels(&lights[i].emitter, texels[0]);
            texels[SHARED_AREA_NUMBER][3] = lights[i].hidden ? -1 : (float)i;
            texels += LMP_AREA_TEXELS;
        }
}

/* Converts a light; what it adds in every direction is added to `ambient`. */
static shared_light take_light(const scene_light *light, lmp_rgb *ambient) {
    lmpi_packed_light packed;
    if (lmpi_light_is_area(&light->emitter))
        return make(light->emitter.position, 0, light->emitter.radiance, SHARED_LIGHT_HIDDEN);
    lmpi_light_pack(&light->emitter, &packed);
    const int seen = scene_light_is_drawn(light) ? SHARED_LIGHT_DRAWN : SHARED_LIGHT_HIDDEN;
    const int form = packed.fixed                    ? SHARED_LIGHT_FIXED
                     : packed.form == LMPI_FORM_CONE ? SHARED_LIGHT_CONE
                                                     : seen;
    shared_light to = make(packed.at, size_of(&packed), packed.color, form);
    if (packed.form == LMPI_FORM_CONE)
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
