/* SPDX-License-Identifier: MIT */
#include "app/shadow/source.h"

#include "app/scene/vector.h"
#include "app/shadow/wide.h"

/* --- the sources ------------------------------------------------------------------------------ */

static shadow_source source_of(shadow_kind kind, const lmp_light *light, lmp_rgb color) {
    return (shadow_source) { .kind = kind,
                             .light = light,
                             .color = color,
                             .brightness = (color.r + color.g + color.b) / 3 };
}

static shadow_source far_source(const lmp_light *light, lmp_vec3 axis, float one_minus_cos,
                                lmp_rgb color) {
    shadow_source source = source_of(SHADOW_FAR, light, color);
    source.axis = axis;
    source.one_minus_cos = one_minus_cos;
    return source;
}

static size_t add_light(const lmp_light *light, shadow_source *sources) {
    const float half = sinf(light->angle / 2);
    switch (light->kind) {
    case LMP_LIGHT_SPHERE:
        sources[0] = source_of(SHADOW_SPHERE, light, light->radiance);
        return 1;
    case LMP_LIGHT_POINT:
    case LMP_LIGHT_SPOT:
        sources[0] = source_of(SHADOW_POINT, light, light->intensity);
        return 1;
    case LMP_LIGHT_DIRECTIONAL:
        sources[0] = far_source(light, light->direction, 0, light->irradiance);
        return 1;
    case LMP_LIGHT_CAP:
        sources[0] = far_source(light, light->direction, 2 * half * half, light->radiance);
        return 1;
    case LMP_LIGHT_HEMISPHERE:
        sources[0] = far_source(light, light->direction, 1, light->radiance);
        sources[1] = far_source(light, vec_scale(light->direction, -1), 1, light->ground);
        return 2;
    }
    return 0;
}

size_t shadow_sources_make(const scene_light *lights, size_t count, const shadow_around *around,
                           shadow_source *sources) {
    size_t made = 0;
    for (size_t i = 0; i < count; i++)
        made += add_light(&lights[i].emitter, sources + made);
    if (around) {
        sources[made] = source_of(SHADOW_AROUND, NULL, around->mean);
        sources[made++].around = around;
    }
    return made;
}

/* --- from a point ----------------------------------------------------------------------------- */

/* Of a sphere at a distance; inside it the cap goes on growing, as in <lampion/light.h>. */
static float one_minus_cos_of(float radius, float distance) {
    if (distance < radius) {
        const float s = distance / radius;
        return 1 + sqrtf((1 - s) * (1 + s));
    }
    const float s = distance > 0 ? radius / distance : 1;
    return s * s / (1 + sqrtf((1 - s) * (1 + s)));
}

/* As of KHR_lights_punctual, whose difference of cosines is held to 1e-3. */
static float spot_falloff(const lmp_light *light, lmp_vec3 axis) {
    if (light->kind != LMP_LIGHT_SPOT)
        return 1;
    const float outer = cosf(light->outer), inner = cosf(light->inner);
    const float cosine = -vec_dot(light->direction, axis);
    const float t = fminf(fmaxf((cosine - outer) / fmaxf(inner - outer, 1e-3f), 0), 1);
    return t * t;
}

static float sine_of(float one_minus_cos) {
    return one_minus_cos < 1 ? sqrtf(one_minus_cos * (2 - one_minus_cos)) : 1;
}

/* Without a branch, so that loops become vectors. */
static float larger(float a, float b) {
    return 0.5f * (a + b + fabsf(a - b));
}

/* Caps beside each other, and the irradiance across them over pi. */
typedef struct cap_lanes {
    shadow_vectors axis;
    shadow_lanes sine, power;
} cap_lanes;

static void see_sphere(const shadow_source *source, const shadow_points *p, cap_lanes *caps) {
    const lmp_light *light = source->light;
    const lmp_vec3 center = light->position;
    const float r = light->radius, least = LMP_POINT_DISTANCE_MIN * LMP_POINT_DISTANCE_MIN;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float x = center.x - p->position.of[0][i], y = center.y - p->position.of[1][i];
        const float z = center.z - p->position.of[2][i];
        const float scale = 1 / sqrtf(larger(x * x + y * y + z * z, least));
        const float sine = 1 - larger(1 - r * scale, 0);
        caps->axis.of[0][i] = x * scale;
        caps->axis.of[1][i] = y * scale;
        caps->axis.of[2][i] = z * scale;
        caps->sine[i] = sine;
        caps->power[i] = source->brightness * sine * sine; /* inside up to four times as much */
    }
}

static void see_point(const shadow_source *source, const shadow_points *p, cap_lanes *caps) {
    const lmp_vec3 center = source->light->position;
    const float least = LMP_POINT_DISTANCE_MIN * LMP_POINT_DISTANCE_MIN;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const lmp_vec3 to =
            vec_sub(center, vec(p->position.of[0][i], p->position.of[1][i], p->position.of[2][i]));
        const float d2 = fmaxf(vec_dot(to, to), least);
        const lmp_vec3 axis = vec_scale(to, 1 / sqrtf(d2));
        caps->axis.of[0][i] = axis.x;
        caps->axis.of[1][i] = axis.y;
        caps->axis.of[2][i] = axis.z;
        caps->sine[i] = 0;
        caps->power[i] = source->brightness / (PI * d2) * spot_falloff(source->light, axis);
    }
}

static void see_far(const shadow_source *source, cap_lanes *caps) {
    const float solid_angle = 2 * PI * source->one_minus_cos;
    for (int i = 0; i < SHADOW_LANES; i++) {
        caps->axis.of[0][i] = source->axis.x;
        caps->axis.of[1][i] = source->axis.y;
        caps->axis.of[2][i] = source->axis.z;
        caps->sine[i] = sine_of(source->one_minus_cos);
        caps->power[i] = source->brightness / PI * (solid_angle > 0 ? solid_angle : 1);
    }
}

/* A cap's part above the horizon, about (cos + sine) / (1 + sine), and a lobe that it widens. */
static void weigh_caps(const cap_lanes *caps, const shadow_points *p, float *weights) {
    const shadow_lanes *n = p->normal.of, *m = p->mirror.of, *axis = caps->axis.of;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float along = n[0][i] * axis[0][i] + n[1][i] * axis[1][i] + n[2][i] * axis[2][i];
        const float mirrored = m[0][i] * axis[0][i] + m[1][i] * axis[1][i] + m[2][i] * axis[2][i];
        const float s = caps->sine[i], a2 = p->alpha2[i] + 0.25f * s * s;
        const float off = a2 + larger(0.5f - 0.5f * mirrored, 0);
        const float facing = larger(along + s, 0) * (1 - 0.5f * s);
        const float specular = p->shine[i] * a2 / (4 * off * off);
        const float weight = caps->power[i] * (p->albedo[i] * facing + specular);
        weights[i] = facing > 0 ? weight : 0;
    }
}

/* Adds what coats reflect. */
static void weigh_coats(const cap_lanes *caps, const shadow_points *p, float *weights) {
    const shadow_lanes *n = p->coat_normal.of, *m = p->coat_mirror.of, *axis = caps->axis.of;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float along = n[0][i] * axis[0][i] + n[1][i] * axis[1][i] + n[2][i] * axis[2][i];
        const float mirrored = m[0][i] * axis[0][i] + m[1][i] * axis[1][i] + m[2][i] * axis[2][i];
        const float s = caps->sine[i], a2 = p->coat_alpha2[i] + 0.25f * s * s;
        const float off = a2 + larger(0.5f - 0.5f * mirrored, 0);
        const float weight = caps->power[i] * p->coat[i] * a2 / (4 * off * off);
        weights[i] += p->coat[i] > 0 && along + s > 0 ? weight : 0;
    }
}

static void weigh(const shadow_source *source, const shadow_points *p, float *weights) {
    cap_lanes caps;
    if (source->kind == SHADOW_AROUND) {
        for (int i = 0; i < SHADOW_LANES; i++)
            weights[i] = source->brightness * PI * (p->albedo[i] + p->shine[i] + p->coat[i]);
        return;
    }
    if (source->kind == SHADOW_SPHERE)
        see_sphere(source, p, &caps);
    else if (source->kind == SHADOW_POINT)
        see_point(source, p, &caps);
    else
        see_far(source, &caps);
    weigh_caps(&caps, p, weights);
    if (p->coated)
        weigh_coats(&caps, p, weights);
}

SHADOW_WIDE void shadow_sources_weigh(const shadow_source *sources, size_t count,
                                      const shadow_points *points, shadow_lanes *sums) {
    shadow_lanes sum = { 0 }, weights;
    for (size_t s = 0; s < count; s++) {
        weigh(&sources[s], points, weights);
        for (int i = 0; i < SHADOW_LANES; i++)
            sums[s][i] = sum[i] += weights[i] > 0 ? weights[i] : 0;
    }
}

/* --- a direction ------------------------------------------------------------------------------ */

/* Off the axis by that much, the part v of a turn around it: in an orthonormal basis without
 * branches at the poles (Duff et al. 2017). */
static lmp_vec3 around_axis(lmp_vec3 axis, float one_minus_cos, float v) {
    const float t = one_minus_cos, sine = sqrtf(t * (2 - t)), angle = 2 * PI * v;
    const float sign = copysignf(1, axis.z), a = -1 / (sign + axis.z), b = axis.x * axis.y * a;
    const lmp_vec3 across = vec(1 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x);
    const lmp_vec3 along = vec(b, sign + axis.y * axis.y * a, -axis.y);
    return vec_add(vec_scale(axis, 1 - t), vec_add(vec_scale(across, sine * cosf(angle)),
                                                   vec_scale(along, sine * sinf(angle))));
}

static shadow_sample draw_sphere(const shadow_source *source, lmp_vec3 point, float u, float v) {
    const lmp_vec3 to = vec_sub(source->light->position, point);
    const float r = source->light->radius, distance = vec_length(to);
    const float one_minus_cos = one_minus_cos_of(r, distance);
    const lmp_vec3 axis = distance > 0 ? vec_scale(to, 1 / distance) : vec(0, 0, 1);
    const float t = u * one_minus_cos, along = distance * (1 - t);
    const float off = distance * sqrtf(t * (2 - t));
    const float half = sqrtf(fmaxf((r - off) * (r + off), 0));
    const float length = distance < r ? along + half : along - half;
    return (shadow_sample) { .direction = around_axis(axis, t, v),
                             .length = fmaxf(length, 0),
                             .size = sine_of(one_minus_cos),
                             .arrives = rgb_scale(source->color, 2 * PI * one_minus_cos) };
}

static shadow_sample draw_point(const shadow_source *source, lmp_vec3 point) {
    const lmp_vec3 to = vec_sub(source->light->position, point);
    const float distance = vec_length(to), held = fmaxf(distance, LMP_POINT_DISTANCE_MIN);
    const lmp_vec3 w = vec_normalize(to, vec(0, 0, 1));
    return (shadow_sample) { .direction = w,
                             .length = distance,
                             .arrives = rgb_scale(source->color,
                                                  spot_falloff(source->light, w) / (held * held)) };
}

static shadow_sample draw_far(const shadow_source *source, float u, float v) {
    const float one_minus_cos = source->one_minus_cos;
    const float solid_angle = one_minus_cos > 0 ? 2 * PI * one_minus_cos : 1;
    return (shadow_sample) { .direction = around_axis(source->axis, u * one_minus_cos, v),
                             .length = INFINITY,
                             .size = sine_of(one_minus_cos),
                             .arrives = rgb_scale(source->color, solid_angle) };
}

static shadow_sample draw_around(const shadow_source *source, float u, float v) {
    shadow_sample sample = { .length = INFINITY, .size = 1 };
    sample.direction = shadow_around_draw(source->around, u, v, &sample.arrives);
    return sample;
}

shadow_sample shadow_source_draw(const shadow_source *source, lmp_vec3 point, float u, float v) {
    switch (source->kind) {
    case SHADOW_SPHERE:
        return draw_sphere(source, point, u, v);
    case SHADOW_POINT:
        return draw_point(source, point);
    case SHADOW_FAR:
        return draw_far(source, u, v);
    case SHADOW_AROUND:
        break;
    }
    return draw_around(source, u, v);
}
