/* SPDX-License-Identifier: MIT */
#include "web/splats.h"

#include "app/scene/vector.h"

#include <math.h>

/* The knot: a curve that goes twice around a ring while it winds around it thrice. */
#define MIDDLE    vec(0.0f, 1.18f, 0.0f) /* of the ball */
#define RING      1.42f
#define WINDING   0.26f
#define TUBE      0.11f
#define TILT      0.4f   /* of the ring's plane, in radians */
#define DEVIATION 0.024f /* of a splat, on average */

static lmp_vec3 on_knot(float t) {
    const float out = RING + WINDING * cosf(3.0f * t), up = WINDING * sinf(3.0f * t);
    const float x = out * cosf(2.0f * t), c = cosf(TILT), s = sinf(TILT);
    return vec(c * x - s * up, s * x + c * up, out * sinf(2.0f * t));
}

/* Returns number i of a sequence that fills 0 … 1 evenly, by a step that is no fraction. */
static float spread(size_t i, double step) {
    return (float)fmod(((double)i + 0.5) * step, 1.0);
}

static splats_splat splat_at(float t, float turn, float part) {
    const float ahead = 1e-3f;
    const lmp_vec3 up = vec(0.0f, 1.0f, 0.0f), at = on_knot(t);
    const lmp_vec3 tangent = vec_normalize(vec_sub(on_knot(t + ahead), at), up);
    const lmp_vec3 side = vec_across(tangent), other = vec_cross(tangent, side);
    const lmp_vec3 normal =
        vec_add(vec_scale(side, cosf(2.0f * PI * turn)), vec_scale(other, sinf(2.0f * PI * turn)));
    const lmp_vec3 around = vec_cross(normal, tangent);
    const float c = cosf(PI * part), s = sinf(PI * part), size = DEVIATION * (0.7f + 0.6f * part);
    splats_splat splat = { .albedo = { 0.55f + 0.3f * cosf(2.0f * t),
                                       0.50f + 0.3f * cosf(2.0f * t + 2.1f),
                                       0.45f + 0.3f * cosf(2.0f * t + 4.2f) } };
    vec_store(vec_add(MIDDLE, vec_add(at, vec_scale(normal, TUBE))), splat.center);
    vec_store(normal, splat.normal);
    vec_store(vec_scale(vec_add(vec_scale(tangent, c), vec_scale(around, s)), 1.3f * size),
              splat.along);
    vec_store(vec_scale(vec_add(vec_scale(around, c), vec_scale(tangent, -s)), size), splat.across);
    return splat;
}

void splats_place(splats_splat *splats) {
    for (size_t i = 0; i < SPLATS_COUNT; i++)
        splats[i] = splat_at(2.0f * PI * (float)i / SPLATS_COUNT, spread(i, 0.6180339887),
                             spread(i, 0.7548776662));
}

void splats_light(splats_splat *splats, const lmp_shade_settings *settings, const lmp_light *lights,
                  size_t light_count) {
    const lmp_material matte = { .diffuse = { 1, 1, 1 } };
    const size_t stride = sizeof *splats;
    const lmp_vec3_array normals = { &splats->normal[0], &splats->normal[1], &splats->normal[2],
                                     stride };
    const lmp_surfaces surfaces = { .position = { &splats->center[0], &splats->center[1],
                                                  &splats->center[2], stride },
                                    .normal = normals,
                                    .view = normals,
                                    .material = &matte };
    lmp_shade_n(settings, &surfaces, SPLATS_COUNT, lights, light_count,
                (lmp_rgb_array) { splats->color, stride });
    for (size_t i = 0; i < SPLATS_COUNT; i++)
        for (int k = 0; k < 3; k++)
            splats[i].color[k] *= splats[i].albedo[k];
}
