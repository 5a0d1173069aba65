/* SPDX-License-Identifier: MIT */
/* lights_file.c - sphere lights from JSON (docs/scenes.md). */
#include "app/file/file.h"
#include "app/scene/scene.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <string.h>

#define FILE_LIMIT ((size_t)16 << 20)

typedef struct lights_reader {
    const char *path;
    int number; /* of the light being read, from 0 */
    cli_error *error;
} lights_reader;

static bool fail_light(const lights_reader *reader, const char *wrong) {
    return cli_fail(reader->error, reader->path, "lights[%d] %s", reader->number, wrong);
}

/* Of any size: the floats they become are checked. */
static bool read_three(const cJSON *item, double numbers[3]) {
    return file_json_numbers(item, 3, -HUGE_VAL, HUGE_VAL, numbers);
}

static bool read_color(const cJSON *item, double color[3]) {
    if (!cJSON_IsNumber(item))
        return read_three(item, color);
    color[0] = color[1] = color[2] = item->valuedouble;
    return true;
}

static bool check_keys(const lights_reader *reader, const cJSON *entry) {
    static const char *const known[] = { "name",  "position",  "radius", "radiance",
                                         "power", "intensity", NULL };
    const char *key = file_json_unknown_key(entry, known);
    if (key)
        return cli_fail(reader->error, reader->path,
                        "lights[%d] has an unknown key \"%.64s\" (there are position, radius "
                        "and radiance, power or intensity)",
                        reader->number, key);
    return !file_json_repeated_key(entry) || fail_light(reader, "has a key twice");
}

static bool read_light(const lights_reader *reader, const cJSON *entry, scene_light *light) {
    if (!cJSON_IsObject(entry))
        return fail_light(reader, "is no object");
    if (!check_keys(reader, entry))
        return false;
    double position[3], color[3] = { 0.0, 0.0, 0.0 };
    const cJSON *radius = file_json_member(entry, "radius");
    const cJSON *radiance = file_json_member(entry, "radiance");
    const cJSON *power = file_json_member(entry, "power");
    const cJSON *intensity = file_json_member(entry, "intensity");
    if (!read_three(file_json_member(entry, "position"), position))
        return fail_light(reader, "has no position of three numbers");
    if (!cJSON_IsNumber(radius) || !((float)radius->valuedouble > 0.0f))
        return fail_light(reader, "has no radius above 0");
    if (!((float)radius->valuedouble <= LMP_LENGTH_MAX))
        return fail_light(reader, "has a radius that is not finite, or above 1e17");
    if (!!radiance + !!power + !!intensity != 1)
        return fail_light(reader, "needs one of radiance, power and intensity");
    if (!read_color(radiance ? radiance : power ? power : intensity, color))
        return fail_light(reader, "has a strength that is neither a number nor three");
    *light = (scene_light) { .emitter.radius = (float)radius->valuedouble };
    lmp_light *sphere = &light->emitter;
    for (int k = 0; k < 3; k++) {
        const float strength = (float)color[k];
        float *to = &sphere->radiance.r + k, *at = &sphere->position.x + k;
        *at = (float)position[k];
        *to = radiance ? strength
              : power  ? lmp_sphere_radiance_from_power(strength, sphere->radius)
                       : lmp_sphere_radiance_from_intensity(strength, sphere->radius);
        if (!(fabsf(*at) <= LMP_LENGTH_MAX))
            return fail_light(reader, "has a position that is not finite, or beyond 1e17");
        if (!(*to >= 0.0f) || !isfinite(*to))
            return fail_light(reader, "has a strength that is negative or not finite");
    }
    return true;
}

bool scene_add_lights_file(scene *s, const char *path, cli_error *error) {
    cJSON *root = file_read_json(path, FILE_LIMIT, error);
    if (!root)
        return false;
    const cJSON *list = file_json_list(path, root, "lights", error), *entry;
    lights_reader reader = { path, 0, error };
    bool ok = list;
    if (ok && (size_t)cJSON_GetArraySize(list) > SCENE_LIGHTS_MAX - s->light_count)
        ok = cli_fail(error, path, "makes %zu lights (at most %d)",
                      (size_t)cJSON_GetArraySize(list) + s->light_count, SCENE_LIGHTS_MAX);
    size_t count = s->light_count;
    if (!ok)
        list = NULL;
    cJSON_ArrayForEach(entry, list) {
        ok = ok && read_light(&reader, entry, &s->lights[count]);
        reader.number++;
        count++;
    }
    if (ok)
        s->light_count = count;
    cJSON_Delete(root);
    return ok;
}
