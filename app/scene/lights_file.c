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

static bool read_color(const cJSON *item, double color[3]) {
    int count = 0;
    const cJSON *channel;
    if (cJSON_IsNumber(item)) {
        color[0] = color[1] = color[2] = item->valuedouble;
        return true;
    }
    if (!cJSON_IsArray(item))
        return false;
    cJSON_ArrayForEach(channel, item) {
        if (!cJSON_IsNumber(channel) || count == 3)
            return false;
        color[count++] = channel->valuedouble;
    }
    return count == 3;
}

static bool check_keys(const lights_reader *reader, const cJSON *entry) {
    static const char *const known[] = { "name",     "position", "radius",
                                         "radiance", "power",    "intensity" };
    for (const cJSON *item = entry->child; item; item = item->next) {
        bool found = false;
        for (size_t i = 0; i < sizeof known / sizeof *known; i++)
            found = found || strcmp(item->string, known[i]) == 0;
        if (!found)
            return cli_fail(reader->error, reader->path,
                            "lights[%d] has an unknown key \"%.64s\" (there are position, radius "
                            "and radiance, power or intensity)",
                            reader->number, item->string);
        for (const cJSON *other = item->next; other; other = other->next)
            if (strcmp(item->string, other->string) == 0)
                return fail_light(reader, "has a key twice");
    }
    return true;
}

static bool read_light(const lights_reader *reader, const cJSON *entry, scene_light *light) {
    if (!cJSON_IsObject(entry))
        return fail_light(reader, "is no object");
    if (!check_keys(reader, entry))
        return false;
    double position[3], color[3] = { 0.0, 0.0, 0.0 };
    const cJSON *place = cJSON_GetObjectItemCaseSensitive(entry, "position");
    const cJSON *radius = cJSON_GetObjectItemCaseSensitive(entry, "radius");
    const cJSON *radiance = cJSON_GetObjectItemCaseSensitive(entry, "radiance");
    const cJSON *power = cJSON_GetObjectItemCaseSensitive(entry, "power");
    const cJSON *intensity = cJSON_GetObjectItemCaseSensitive(entry, "intensity");
    if (!cJSON_IsArray(place) || !read_color(place, position))
        return fail_light(reader, "has no position of three numbers");
    if (!cJSON_IsNumber(radius) || !((float)radius->valuedouble > 0.0f))
        return fail_light(reader, "has no radius above 0");
    if (!((float)radius->valuedouble <= LMP_LENGTH_MAX))
        return fail_light(reader, "has a radius that is not finite, or above 1e17");
    if (!!radiance + !!power + !!intensity != 1)
        return fail_light(reader, "needs one of radiance, power and intensity");
    if (!read_color(radiance ? radiance : power ? power : intensity, color))
        return fail_light(reader, "has a strength that is neither a number nor three");
    *light = (scene_light) { .radius = (float)radius->valuedouble };
    for (int k = 0; k < 3; k++) {
        const float strength = (float)color[k];
        light->center[k] = (float)position[k];
        light->radiance[k] = radiance ? strength
                             : power  ? lmp_sphere_radiance_from_power(strength, light->radius)
                                      : lmp_sphere_radiance_from_intensity(strength, light->radius);
        if (!(fabsf(light->center[k]) <= LMP_LENGTH_MAX))
            return fail_light(reader, "has a position that is not finite, or beyond 1e17");
        if (!(light->radiance[k] >= 0.0f) || !isfinite(light->radiance[k]))
            return fail_light(reader, "has a strength that is negative or not finite");
    }
    return true;
}

bool scene_add_lights_file(scene *s, const char *path, cli_error *error) {
    cJSON *root = file_read_json(path, FILE_LIMIT, error);
    if (!root)
        return false;
    const cJSON *list =
        cJSON_IsObject(root) ? cJSON_GetObjectItemCaseSensitive(root, "lights") : NULL;
    lights_reader reader = { path, 0, error };
    bool ok = true;
    if (!cJSON_IsArray(list))
        ok = cli_fail(error, path, "has no array \"lights\"");
    else if (cJSON_GetArraySize(root) != 1)
        ok = cli_fail(error, path, "has keys other than \"lights\"");
    else if ((size_t)cJSON_GetArraySize(list) > SCENE_LIGHTS_MAX - s->light_count)
        ok = cli_fail(error, path, "makes %zu lights (at most %d)",
                      (size_t)cJSON_GetArraySize(list) + s->light_count, SCENE_LIGHTS_MAX);
    size_t count = s->light_count;
    const cJSON *entry;
    if (ok)
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
