/* SPDX-License-Identifier: MIT */
/* lights.c - lights of every kind as the shaders take them: spheres, or caps that are fixed. */
#include "app/render/gl/block.h"

#include <math.h>

/* A Dirac is a sphere so small or a cap so narrow (1 - cos a): too small for any band to see. */
#define POINT_RADIUS         LMP_POINT_DISTANCE_MIN
#define NARROW_ONE_MINUS_COS 5e-11f

static const float pi = 3.14159265f;

static shared_light make(lmp_vec3 at, float size, lmp_rgb color, float factor, int form) {
    return (shared_light) {
        .sphere = { at.x, at.y, at.z, size },
        .radiance = { color.r * factor, color.g * factor, color.b * factor, (float)form },
    };
}

/* A falloff of 0 at the outer angle and 1 at the inner one, linear in the cosine. */
static void set_cone(const lmp_light *spot, float cone[4]) {
    const float outer = cosf(spot->outer), steep = 1 / fmaxf(cosf(spot->inner) - outer, 1e-3f);
    cone[0] = spot->direction.x * steep;
    cone[1] = spot->direction.y * steep;
    cone[2] = spot->direction.z * steep;
    cone[3] = -outer * steep;
}

/* What it adds from every direction goes to `ambient`. */
static shared_light take_light(const scene_light *light, lmp_rgb *ambient) {
    const lmp_light *e = &light->emitter;
    const float half = sinf(0.5f * e->angle), narrow = NARROW_ONE_MINUS_COS;
    switch (e->kind) {
    case LMP_LIGHT_SPHERE:
        return make(e->position, e->radius, e->radiance, 1,
                    scene_light_is_drawn(light) ? SHARED_LIGHT_DRAWN : SHARED_LIGHT_HIDDEN);
    case LMP_LIGHT_POINT:
    case LMP_LIGHT_SPOT: {
        const bool spot = e->kind == LMP_LIGHT_SPOT;
        shared_light to =
            make(e->position, POINT_RADIUS, e->intensity, 1 / (pi * POINT_RADIUS * POINT_RADIUS),
                 spot ? SHARED_LIGHT_SPOT : SHARED_LIGHT_HIDDEN);
        if (spot)
            set_cone(e, to.cone);
        return to;
    }
    case LMP_LIGHT_DIRECTIONAL:
        return make(e->direction, narrow, e->irradiance, 1 / (pi * narrow * (2 - narrow)),
                    SHARED_LIGHT_FIXED);
    case LMP_LIGHT_CAP:
        return make(e->direction, 2 * half * half, e->radiance, 1, SHARED_LIGHT_FIXED);
    case LMP_LIGHT_HEMISPHERE:
        break;
    }
    const lmp_rgb above = { e->radiance.r - e->ground.r, e->radiance.g - e->ground.g,
                            e->radiance.b - e->ground.b };
    *ambient =
        (lmp_rgb) { ambient->r + e->ground.r, ambient->g + e->ground.g, ambient->b + e->ground.b };
    return make(e->direction, 1, above, 1, SHARED_LIGHT_FIXED);
}

size_t gpu_take_lights(const scene_light *lights, size_t count, shared_light *block) {
    lmp_rgb ambient = { 0, 0, 0 };
    for (size_t i = 0; i < count; i++)
        block[i] = take_light(&lights[i], &ambient);
    if (ambient.r > 0 || ambient.g > 0 || ambient.b > 0)
        block[count++] = make((lmp_vec3) { 0, 0, 1 }, 2, ambient, 1, SHARED_LIGHT_FIXED);
    return count;
}
