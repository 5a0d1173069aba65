/* SPDX-License-Identifier: MIT */
#include "app/scene/light.h"

#include "app/scene/outline.h"
#include "app/scene/vector.h"

#include "src/light/packed.h"

#include <stdio.h>
#include <string.h>

#define POSITION                                                                                   \
    { "position", SCENE_LIGHT_POSITION, offsetof(lmp_light, position), false, NULL }
#define DIRECTION                                                                                  \
    { "direction", SCENE_LIGHT_DIRECTION, offsetof(lmp_light, direction), false, NULL }
#define RADIUS                                                                                     \
    { "radius", SCENE_LIGHT_RADIUS, offsetof(lmp_light, radius), false, NULL }
#define EXTENT(name, number)                                                                       \
    { name, SCENE_LIGHT_EXTENT, offsetof(lmp_light, half[number]), false, NULL }
#define TWO_SIDED                                                                                  \
    { "two_sided", SCENE_LIGHT_FLAG, offsetof(lmp_light, two_sided), true, NULL }
#define ANGLE(name, optional)                                                                      \
    { #name, SCENE_LIGHT_ANGLE, offsetof(lmp_light, name), optional, NULL }
#define COLOR(name, optional)                                                                      \
    { #name, SCENE_LIGHT_COLOR, offsetof(lmp_light, name), optional, NULL }

/* The color of a light with an area: its radiance, or what gives it. */
#define RADIANCE(from_power, from_intensity)                                                       \
    COLOR(radiance, false),                                                                        \
        { "power", SCENE_LIGHT_COLOR, offsetof(lmp_light, radiance), false, from_power }, {        \
        "intensity", SCENE_LIGHT_COLOR, offsetof(lmp_light, radiance), false, from_intensity       \
    }

static float from_sphere_power(const lmp_light *sphere, float power) {
    return lmp_sphere_radiance_from_power(power, sphere->radius);
}

static float from_sphere_intensity(const lmp_light *sphere, float intensity) {
    return lmp_sphere_radiance_from_intensity(intensity, sphere->radius);
}

static const char *wrong_spot(const lmp_light *light) {
    return light->inner <= light->outer ? NULL : ".inner is above the outer angle";
}

static const char *wrong_rectangle(const lmp_light *light) {
    const float *a = &light->half[0].x, *b = &light->half[1].x;
    double aa = 0, ab = 0, bb = 0; /* in double: products of lengths overflow float32 */
    for (int k = 0; k < 3; k++) {
        aa += (double)a[k] * (double)a[k];
        ab += (double)a[k] * (double)b[k];
        bb += (double)b[k] * (double)b[k];
    }
    return aa * bb - ab * ab > 1e-12 * aa * bb ? NULL : ".half_height is parallel to .half_width";
}

static const char *wrong_polygon(const lmp_light *light) {
    return scene_outline_wrong(light->corner, light->corner_count);
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

/* Areas shine downward. A square whose sides are half as long as this and a disk of this radius
 * have about the surface of a model sphere. */
#define MODEL_SIZE (2 * MODEL_RADIUS)

static void shine(lmp_light *area, float irradiance, float diagonal) {
    area->radiance =
        rgb_scale(warm, lmp_light_radiance_from_power(area, power_of(irradiance, diagonal)));
}

static void model_rectangle(lmp_light *light, float irradiance, float diagonal) {
    light->half[0] = vec(MODEL_SIZE * diagonal, 0, 0);
    light->half[1] = vec(0, 0, MODEL_SIZE * diagonal);
    shine(light, irradiance, diagonal);
}

static void model_disk(lmp_light *light, float irradiance, float diagonal) {
    light->direction = vec(0, -1, 0);
    light->radius = MODEL_SIZE * diagonal;
    shine(light, irradiance, diagonal);
}

static void model_tube(lmp_light *light, float irradiance, float diagonal) {
    light->half[0] = vec(4 * MODEL_RADIUS * diagonal, 0, 0);
    light->radius = 0.25f * MODEL_RADIUS * diagonal;
    shine(light, irradiance, diagonal);
}

static void model_polygon(lmp_light *light, float irradiance, float diagonal) {
    static const lmp_vec3 hexagon[] = { { 1, 0, 0 },  { 0.5f, 0, 0.866f },   { -0.5f, 0, 0.866f },
                                        { -1, 0, 0 }, { -0.5f, 0, -0.866f }, { 0.5f, 0, -0.866f } };
    light->corner_count = sizeof hexagon / sizeof *hexagon;
    for (int i = 0; i < light->corner_count; i++)
        light->corner[i] = vec_scale(hexagon[i], MODEL_SIZE * diagonal);
    shine(light, irradiance, diagonal);
}

const lmp_light_kind scene_light_kind_default = LMP_LIGHT_SPHERE;

const scene_light_kind scene_light_kinds[SCENE_LIGHT_KIND_COUNT] = {
    [LMP_LIGHT_SPHERE] = { .name = "sphere",
                           .members = { POSITION, RADIUS,
                                        RADIANCE(from_sphere_power, from_sphere_intensity) },
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
    [LMP_LIGHT_RECTANGLE] = { .name = "rectangle",
                              .members = { POSITION, EXTENT("half_width", 0),
                                           EXTENT("half_height", 1), TWO_SIDED,
                                           RADIANCE(lmp_light_radiance_from_power,
                                                    lmp_light_radiance_from_intensity) },
                              .wrong = wrong_rectangle,
                              .model = model_rectangle },
    [LMP_LIGHT_DISK] = { .name = "disk",
                         .members = { POSITION, DIRECTION, RADIUS, TWO_SIDED,
                                      RADIANCE(lmp_light_radiance_from_power,
                                               lmp_light_radiance_from_intensity) },
                         .model = model_disk },
    [LMP_LIGHT_TUBE] = { .name = "tube",
                         .members = { POSITION, EXTENT("half_axis", 0), RADIUS,
                                      RADIANCE(lmp_light_radiance_from_power,
                                               lmp_light_radiance_from_intensity) },
                         .model = model_tube },
    [LMP_LIGHT_POLYGON] = { .name = "polygon",
                            .members = { POSITION,
                                         { "corners", SCENE_LIGHT_CORNERS,
                                           offsetof(lmp_light, corner), false, NULL },
                                         TWO_SIDED,
                                         RADIANCE(lmp_light_radiance_from_power,
                                                  lmp_light_radiance_from_intensity) },
                            .wrong = wrong_polygon,
                            .model = model_polygon },
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

int scene_light_members_of(const lmp_light *light, scene_light_type type) {
    int count = 0;
    for (const scene_light_member *m = scene_light_kinds[light->kind].members; m->name; m++)
        count += m->type == type;
    return count;
}

bool scene_light_has(const scene_light *light, scene_light_type type) {
    return scene_light_members_of(&light->emitter, type) > 0;
}

bool scene_light_is_area(const lmp_light *light) {
    return lmpi_light_is_area(light);
}

bool scene_light_is_sun(const lmp_light *light) {
    return light->kind == LMP_LIGHT_DIRECTIONAL || light->kind == LMP_LIGHT_CAP;
}

const scene_light *scene_find_area(const scene_light *lights, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (scene_light_is_area(&lights[i].emitter))
            return &lights[i];
    return NULL;
}

size_t scene_count_areas(const scene_light *lights, size_t count) {
    size_t areas = 0;
    for (size_t i = 0; i < count; i++)
        areas += scene_light_is_area(&lights[i].emitter);
    return areas;
}

bool scene_light_is_drawn(const scene_light *light) {
    const lmp_light *emitter = &light->emitter;
    return (emitter->kind == LMP_LIGHT_SPHERE || scene_light_is_area(emitter)) && !light->hidden;
}

int scene_light_count(const lmp_light *light, const scene_light_member *member) {
    switch (member->type) {
    case SCENE_LIGHT_FLAG:
        return 0;
    case SCENE_LIGHT_RADIUS:
    case SCENE_LIGHT_ANGLE:
        return 1;
    case SCENE_LIGHT_CORNERS:
        return 3 * light->corner_count;
    case SCENE_LIGHT_POSITION:
    case SCENE_LIGHT_DIRECTION:
    case SCENE_LIGHT_EXTENT:
    case SCENE_LIGHT_COLOR:
        break;
    }
    return 3;
}

float *scene_light_value(lmp_light *light, const scene_light_member *member) {
    void *value = (char *)light + member->offset;
    return value;
}

bool *scene_light_flag(lmp_light *light, const scene_light_member *member) {
    return (bool *)light + member->offset;
}

lmp_light scene_light_rectangle(lmp_vec3 center, lmp_vec3 x, lmp_vec3 y) {
    return (lmp_light) { .kind = LMP_LIGHT_RECTANGLE, .position = center, .half = { x, y } };
}

lmp_light scene_light_disk(lmp_vec3 center, lmp_vec3 normal, float radius) {
    return (lmp_light) {
        .kind = LMP_LIGHT_DISK, .position = center, .direction = normal, .radius = radius
    };
}

lmp_light scene_light_tube(lmp_vec3 center, lmp_vec3 half, float radius) {
    return (lmp_light) {
        .kind = LMP_LIGHT_TUBE, .position = center, .half = { half }, .radius = radius
    };
}

lmp_light scene_light_polygon(lmp_vec3 position, const lmp_vec3 *corner, int count) {
    lmp_light light = { .kind = LMP_LIGHT_POLYGON, .position = position, .corner_count = count };
    memcpy(light.corner, corner, (size_t)count * sizeof *corner);
    return light;
}

/* --- size and orientation --------------------------------------------------------------------- */

float scene_light_extent(const lmp_light *light) {
    float farthest = 0;
    switch (light->kind) {
    case LMP_LIGHT_SPHERE:
    case LMP_LIGHT_DISK:
        return light->radius;
    case LMP_LIGHT_TUBE:
        return vec_length(light->half[0]) + light->radius;
    case LMP_LIGHT_RECTANGLE:
        return fmaxf(vec_length(vec_add(light->half[0], light->half[1])),
                     vec_length(vec_sub(light->half[0], light->half[1])));
    case LMP_LIGHT_POLYGON:
        for (int i = 0; i < light->corner_count; i++)
            farthest = fmaxf(farthest, vec_length(light->corner[i]));
        break;
    case LMP_LIGHT_POINT:
    case LMP_LIGHT_SPOT:
    case LMP_LIGHT_DIRECTIONAL:
    case LMP_LIGHT_CAP:
    case LMP_LIGHT_HEMISPHERE:
        break;
    }
    return farthest;
}

static bool is_vector(scene_light_type type) {
    return type == SCENE_LIGHT_DIRECTION || type == SCENE_LIGHT_EXTENT ||
           type == SCENE_LIGHT_CORNERS;
}

void scene_light_resize(lmp_light *light, float by) {
    for (const scene_light_member *m = scene_light_kinds[light->kind].members; m->name; m++) {
        float *value = scene_light_value(light, m);
        const bool is_length = m->type == SCENE_LIGHT_RADIUS || m->type == SCENE_LIGHT_EXTENT ||
                               m->type == SCENE_LIGHT_CORNERS;
        for (int k = 0; is_length && k < scene_light_count(light, m); k++)
            value[k] *= by;
    }
    light->radiance = rgb_scale(light->radiance, 1 / (by * by));
}

void scene_light_rotate(lmp_light *light, lmp_vec3 (*rotate)(lmp_vec3 v, const void *user),
                        const void *user) {
    for (const scene_light_member *m = scene_light_kinds[light->kind].members; m->name; m++) {
        float *value = scene_light_value(light, m);
        for (int k = 0; is_vector(m->type) && k < scene_light_count(light, m); k += 3)
            vec_store(rotate(vec_load(value + k), user), value + k);
    }
}

/* The smallest rotation from one unit direction to another. */
typedef struct rotation {
    lmp_vec3 from, to;
} rotation;

static lmp_vec3 rotate(lmp_vec3 v, const void *user) {
    const rotation *r = user;
    const lmp_vec3 sum = vec_add(r->from, r->to);
    const float one_plus_cos = 0.5f * vec_dot(sum, sum); /* exact however small */
    if (one_plus_cos < 1e-6f) {                          /* half a turn, around any axis across */
        const lmp_vec3 axis = vec_across(r->from);
        return vec_sub(vec_scale(axis, 2 * vec_dot(axis, v)), v);
    }
    const lmp_vec3 axis = vec_cross(r->from, r->to); /* its length is the sine */
    return vec_add(vec_add(vec_scale(v, one_plus_cos - 1), vec_cross(axis, v)),
                   vec_scale(axis, vec_dot(axis, v) / one_plus_cos));
}

void scene_light_rotate_between(lmp_light *light, lmp_vec3 from, lmp_vec3 to) {
    scene_light_rotate(light, rotate, &(rotation) { from, to });
    light->direction =
        vec_normalize(light->direction, light->direction); /* which may have lost digits */
}

lmp_vec3 scene_light_axis(const lmp_light *light) {
    const lmp_vec3 none = { 0, 0, 0 };
    lmp_vec3 normal = none;
    switch (light->kind) {
    case LMP_LIGHT_SPHERE:
    case LMP_LIGHT_POINT:
        break;
    case LMP_LIGHT_SPOT:
    case LMP_LIGHT_DISK:
    case LMP_LIGHT_DIRECTIONAL:
    case LMP_LIGHT_CAP:
    case LMP_LIGHT_HEMISPHERE:
        return light->direction;
    case LMP_LIGHT_TUBE:
        return vec_normalize(light->half[0], none);
    case LMP_LIGHT_RECTANGLE:
        return vec_normalize(vec_cross(light->half[0], light->half[1]), none);
    case LMP_LIGHT_POLYGON: /* by Newell's method */
        for (int i = 0; i < light->corner_count; i++)
            normal = vec_add(
                normal, vec_cross(light->corner[i], light->corner[(i + 1) % light->corner_count]));
        return vec_normalize(normal, none);
    }
    return none;
}

void scene_light_face(lmp_light *light, lmp_vec3 direction) {
    const lmp_vec3 axis = scene_light_axis(light);
    lmp_vec3 to = direction;
    if (light->kind == LMP_LIGHT_TUBE)
        to = vec_reject(axis, direction);
    else if (light->two_sided && vec_dot(axis, direction) < 0)
        to = vec_scale(direction, -1);
    if (vec_dot(axis, axis) > 0)
        scene_light_rotate_between(light, axis, to);
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

static bool is_extent(const float *v) {
    return is_position(v) && (v[0] != 0.0f || v[1] != 0.0f || v[2] != 0.0f);
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
    [SCENE_LIGHT_EXTENT] = { is_extent, "is 0, not finite, or beyond 1e17" },
    [SCENE_LIGHT_CORNERS] = { is_position, "is not finite, or beyond 1e17" },
    [SCENE_LIGHT_ANGLE] = { is_angle, "is not in 0 to pi" },
    [SCENE_LIGHT_FLAG] = { NULL, "is neither true nor false" },
    [SCENE_LIGHT_COLOR] = { scene_color_fits, "is negative, not finite or above 1e19" },
};

/* Whether a flag's byte, which may come from a damaged file, is that of true or false. */
static bool is_flag(const lmp_light *light, const scene_light_member *member) {
    return *((const unsigned char *)light + member->offset) <= 1;
}

static bool fits(const lmp_light *emitter, const scene_light_member *member) {
    lmp_light copy = *emitter;
    const float *value = scene_light_value(&copy, member);
    if (member->type == SCENE_LIGHT_FLAG)
        return is_flag(emitter, member);
    if (member->type != SCENE_LIGHT_CORNERS)
        return ranges[member->type].fits(value);
    bool valid = emitter->corner_count >= 3 && emitter->corner_count <= LMP_LIGHT_CORNERS_MAX;
    for (int i = 0; valid && i < emitter->corner_count; i++)
        valid = ranges[member->type].fits(value + 3 * i);
    return valid;
}

bool scene_light_check_member(const lmp_light *emitter, const scene_light_member *member,
                              scene_light_error *error) {
    if (fits(emitter, member))
        return true;
    snprintf(error->text, sizeof error->text, ".%s %s", member->name, ranges[member->type].wrong);
    return false;
}

bool scene_light_check(const scene_light *light, scene_light_error *error) {
    const lmp_light *emitter = &light->emitter;
    if ((unsigned)emitter->kind >= SCENE_LIGHT_KIND_COUNT) {
        snprintf(error->text, sizeof error->text, " is of no known kind");
        return false;
    }
    const scene_light_kind *traits = &scene_light_kinds[emitter->kind];
    for (const scene_light_member *m = traits->members; m->name; m++)
        if (!scene_light_check_member(emitter, m, error))
            return false;
    const char *wrong = traits->wrong ? traits->wrong(emitter) : NULL;
    snprintf(error->text, sizeof error->text, "%s", wrong ? wrong : "");
    return !wrong;
}
