/* SPDX-License-Identifier: MIT */
#include "app/scene/light.h"

#include "app/scene/vector.h"

#include <stdio.h>

#define POSITION                                                                                   \
    { "position", SCENE_LIGHT_POSITION, offsetof(lmp_light, position), false, NULL }
#define DIRECTION                                                                                  \
    { "direction", SCENE_LIGHT_DIRECTION, offsetof(lmp_light, direction), false, NULL }
#define ANGLE(name, optional)                                                                      \
    { #name, SCENE_LIGHT_ANGLE, offsetof(lmp_light, name), optional, NULL }
#define COLOR(name, optional)                                                                      \
    { #name, SCENE_LIGHT_COLOR, offsetof(lmp_light, name), optional, NULL }

static const char *wrong_spot(const lmp_light *light) {
    return light->inner <= light->outer ? NULL : ".inner is above the outer angle";
}

static void widen_point(lmp_light *light, float radius, float angle) {
    (void)angle;
    if (!(radius > 0.0f))
        return;
    light->kind = LMP_LIGHT_SPHERE;
    light->radius = radius;
    light->radiance = rgb_scale(light->intensity, lmp_sphere_radiance_from_intensity(1.0f, radius));
}

static void widen_sun(lmp_light *light, float radius, float angle) {
    const float sine = sinf(angle);
    (void)radius;
    if (!(sine > 0.0f))
        return;
    light->kind = LMP_LIGHT_CAP;
    light->angle = angle;
    light->radiance = rgb_scale(light->irradiance, 1.0f / (PI * sine * sine));
}

#define MODEL_RADIUS 0.012f /* of the diagonal */

static const lmp_rgb warm = { 1, 0.6f, 0.25f };

static float power_of(float irradiance, float diagonal) {
    return irradiance * PI * diagonal * diagonal;
}

static void model_sphere(lmp_light *light, float irradiance, float diagonal) {
    const float power = power_of(irradiance, diagonal);
    light->radius = MODEL_RADIUS * diagonal;
    light->radiance = rgb_scale(warm, lmp_sphere_radiance_from_power(power, light->radius));
}

static void model_point(lmp_light *light, float irradiance, float diagonal) {
    light->intensity = rgb_scale(warm, power_of(irradiance, diagonal) / (4 * PI));
}

static void model_spot(lmp_light *light, float irradiance, float diagonal) {
    model_point(light, irradiance, diagonal);
    light->direction = vec(0, -1, 0);
    light->inner = 0.4f;
    light->outer = 0.6f;
}

static void model_directional(lmp_light *light, float irradiance, float diagonal) {
    (void)diagonal;
    light->irradiance = rgb_scale(warm, irradiance);
}

static void model_cap(lmp_light *light, float irradiance, float diagonal) {
    (void)diagonal;
    light->angle = 0.1f;
    light->radiance = rgb_scale(warm, irradiance / (PI * 0.01f));
}

static void model_sky(lmp_light *light, float irradiance, float diagonal) {
    (void)diagonal;
    light->radiance = rgb_scale((lmp_rgb) { 0.6f, 0.8f, 1 }, irradiance / PI);
    light->ground = rgb_scale(warm, 0.2f * irradiance / PI);
}

const lmp_light_kind scene_light_kind_default = LMP_LIGHT_SPHERE;

const scene_light_kind scene_light_kinds[LMP_LIGHT_KINDS] = {
    [LMP_LIGHT_SPHERE] = { .name = "sphere",
                           .members = { POSITION,
                                        { "radius", SCENE_LIGHT_RADIUS, offsetof(lmp_light, radius),
                                          false, NULL },
                                        COLOR(radiance, false),
                                        { "power", SCENE_LIGHT_COLOR, offsetof(lmp_light, radiance),
                                          false, lmp_sphere_radiance_from_power },
                                        { "intensity", SCENE_LIGHT_COLOR,
                                          offsetof(lmp_light, radiance), false,
                                          lmp_sphere_radiance_from_intensity } },
                           .model = model_sphere },
    [LMP_LIGHT_POINT] = { .name = "point",
                          .members = { POSITION, COLOR(intensity, false) },
                          .widen = widen_point,
                          .widened_by = "--point-radius",
                          .model = model_point },
    [LMP_LIGHT_SPOT] = { .name = "spot",
                         .members = { POSITION, DIRECTION, ANGLE(inner, true), ANGLE(outer, false),
                                      COLOR(intensity, false) },
                         .wrong = wrong_spot,
                         .model = model_spot },
    [LMP_LIGHT_DIRECTIONAL] = { .name = "directional",
                                .members = { DIRECTION, COLOR(irradiance, false) },
                                .widen = widen_sun,
                                .widened_by = "--sun-angle",
                                .model = model_directional },
    [LMP_LIGHT_CAP] = { .name = "cap",
                        .members = { DIRECTION, ANGLE(angle, false), COLOR(radiance, false) },
                        .model = model_cap },
    [LMP_LIGHT_HEMISPHERE] = { .name = "hemisphere",
                               .members = { DIRECTION, COLOR(radiance, false),
                                            COLOR(ground, true) },
                               .model = model_sky },
};

lmp_light scene_light_model(lmp_light_kind kind, float irradiance, float diagonal) {
    lmp_light light = { .kind = kind, .direction = { 0, 1, 0 } };
    scene_light_kinds[kind].model(&light, irradiance, diagonal);
    return light;
}

lmp_light scene_light_from(lmp_vec3 direction) {
    return (lmp_light) { .kind = LMP_LIGHT_DIRECTIONAL,
                         .direction = direction,
                         .irradiance = { 1, 1, 1 } };
}

bool scene_light_has(const scene_light *light, scene_light_type type) {
    const scene_light_member *m = scene_light_kinds[light->emitter.kind].members;
    while (m->name && m->type != type)
        m++;
    return m->name;
}

bool scene_light_is_drawn(const scene_light *light) {
    return scene_light_has(light, SCENE_LIGHT_RADIUS) && !light->hidden;
}

int scene_light_count(const scene_light_member *member) {
    return member->type == SCENE_LIGHT_RADIUS || member->type == SCENE_LIGHT_ANGLE ? 1 : 3;
}

float *scene_light_value(lmp_light *light, const scene_light_member *member) {
    void *value = (char *)light + member->offset;
    return value;
}

/* --- the ranges ------------------------------------------------------------------------------- */

static bool is_position(const float *v) {
    return fabsf(v[0]) <= LMP_LENGTH_MAX && fabsf(v[1]) <= LMP_LENGTH_MAX &&
           fabsf(v[2]) <= LMP_LENGTH_MAX;
}

static bool is_radius(const float *v) {
    return *v > 0.0f && *v <= LMP_LENGTH_MAX;
}

static bool is_direction(const float *v) {
    return fabsf(vec_length(vec_load(v)) - 1.0f) <= 1e-5f;
}

static bool is_angle(const float *v) {
    return *v >= 0.0f && *v <= PI;
}

bool scene_color_fits(const float *rgb) {
    return rgb[0] >= 0.0f && rgb[1] >= 0.0f && rgb[2] >= 0.0f && rgb[0] <= SCENE_COLOR_MAX &&
           rgb[1] <= SCENE_COLOR_MAX && rgb[2] <= SCENE_COLOR_MAX;
}

static const struct {
    bool (*fits)(const float *value);
    const char *wrong;
} ranges[] = {
    [SCENE_LIGHT_POSITION] = { is_position, "is not finite, or beyond 1e17" },
    [SCENE_LIGHT_RADIUS] = { is_radius, "is not above 0, or above 1e17" },
    [SCENE_LIGHT_DIRECTION] = { is_direction, "is not a direction" },
    [SCENE_LIGHT_ANGLE] = { is_angle, "is not in 0 to pi" },
    [SCENE_LIGHT_COLOR] = { scene_color_fits, "is negative, not finite or above 1e19" },
};

bool scene_light_check_member(const lmp_light *emitter, const scene_light_member *member,
                              scene_light_error *error) {
    lmp_light copy = *emitter;
    if (ranges[member->type].fits(scene_light_value(&copy, member)))
        return true;
    snprintf(error->text, sizeof error->text, ".%s %s", member->name, ranges[member->type].wrong);
    return false;
}

bool scene_light_check(const scene_light *light, scene_light_error *error) {
    const lmp_light *emitter = &light->emitter;
    if ((unsigned)emitter->kind >= LMP_LIGHT_KINDS) {
        snprintf(error->text, sizeof error->text, " is of no known kind");
        return false;
    }
    const scene_light_kind *kind = &scene_light_kinds[emitter->kind];
    for (const scene_light_member *m = kind->members; m->name; m++)
        if (!scene_light_check_member(emitter, m, error))
            return false;
    const char *wrong = kind->wrong ? kind->wrong(emitter) : NULL;
    snprintf(error->text, sizeof error->text, "%s", wrong ? wrong : "");
    return !wrong;
}
