/* SPDX-License-Identifier: MIT */
#include "app/scene/animation_path.h"

#include "app/base/file_json.h"
#include "app/scene/world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FILE_LIMIT  ((size_t)16 << 20)
#define SECONDS_MAX 1e6

typedef struct path_reader {
    const char *file;
    int number;           /* of the path being read, from 0 */
    const double *origin; /* of the scene */
    base_error *error;
    bool others_move; /* whether a path that names no light moves the other lights */
} path_reader;

static bool fail_path(const path_reader *reader, const char *wrong) {
    return base_fail(reader->error, reader->file, "paths[%d] %s", reader->number, wrong);
}

static bool read_numbers(const json_t *item, size_t count, double *numbers) {
    return file_json_numbers(item, count, -(double)LMP_LENGTH_MAX, (double)LMP_LENGTH_MAX, numbers);
}

static bool only_keys(const path_reader *reader, json_t *object, const char *const *known) {
    const char *key = file_json_unknown_key(object, known);
    if (key)
        return base_fail(reader->error, reader->file, "paths[%d] has an unknown key \"%.64s\"",
                         reader->number, key);
    return true;
}

static bool read_period(const path_reader *reader, json_t *object, path *p) {
    if (!file_json_number(json_object_get(object, "period"), 0, SECONDS_MAX, &p->period) ||
        !(p->period > 0))
        return fail_path(reader, "has no period above 0 and up to 1e6 seconds");
    return true;
}

/* Reads { "center": [x, y, z], "axis": [x, y, z], "period": s }. */
static bool read_circle(const path_reader *reader, json_t *object, path *p) {
    static const char *const known[] = { "center", "axis", "period", NULL };
    json_t *axis = json_object_get(object, "axis");
    p->kind = PATH_CIRCLE;
    memcpy(p->axis, (const double[3]) { 0, 1, 0 }, sizeof p->axis);
    if (!only_keys(reader, object, known) || !read_period(reader, object, p))
        return false;
    if (!read_numbers(json_object_get(object, "center"), 3, p->center))
        return fail_path(reader, "has no center of three numbers");
    for (int k = 0; k < 3; k++)
        p->center[k] -= reader->origin[k];
    if (axis && !read_numbers(axis, 3, p->axis))
        return fail_path(reader, "has an axis that is not three numbers");
    const double length =
        sqrt(p->axis[0] * p->axis[0] + p->axis[1] * p->axis[1] + p->axis[2] * p->axis[2]);
    if (!(length > 0))
        return fail_path(reader, "has an axis without direction");
    for (int k = 0; k < 3; k++)
        p->axis[k] /= length;
    return true;
}

/* Reads { "bottom": y, "period": s }. */
static bool read_bounce(const path_reader *reader, json_t *object, path *p) {
    static const char *const known[] = { "bottom", "period", NULL };
    const double far = (double)LMP_LENGTH_MAX;
    p->kind = PATH_BOUNCE;
    if (!only_keys(reader, object, known) || !read_period(reader, object, p))
        return false;
    if (!file_json_number(json_object_get(object, "bottom"), -far, far, &p->bottom))
        return fail_path(reader, "has no bottom, a height");
    p->bottom -= reader->origin[1];
    return true;
}

/* Reads [[seconds, x, y, z], …]. */
static bool read_keys(const path_reader *reader, json_t *array, const scene_light *light, path *p) {
    const size_t count = json_array_size(array);
    if (count < 2)
        return fail_path(reader, "needs at least two keys");
    p->kind = PATH_KEYS;
    p->keys = calloc(count, sizeof *p->keys);
    if (!p->keys)
        return base_fail(reader->error, NULL, "out of memory");
    double before = -1.0;
    for (size_t i = 0; i < count; i++) {
        double key[4];
        if (!read_numbers(json_array_get(array, i), 4, key))
            return fail_path(reader, "has a key that is not [seconds, x, y, z]");
        if (!(key[0] > before) || (p->key_count == 0) != (key[0] == 0.0) || key[0] > SECONDS_MAX)
            return fail_path(reader, "has keys whose seconds do not rise from 0");
        p->keys[p->key_count].time = p->period = before = key[0];
        const float *rest = &light->emitter.position.x;
        for (int k = 0; k < 3; k++)
            p->keys[p->key_count].offset[k] =
                key[k + 1] - scene_to_world(reader->origin[k], rest[k]);
        p->key_count++;
    }
    return true;
}

/* Finds the light that an entry names and checks that it can take this path: *index is its number.
 * An entry without a name is for all lights that have no path of their own. */
static bool read_light(const path_reader *reader, json_t *light, bool circle, const scene *world,
                       const path *paths, size_t *index) {
    double number = 0;
    if (light && (!file_json_number(light, 0, (double)world->light_count - 1, &number) ||
                  number != floor(number)))
        return base_fail(reader->error, reader->file,
                         "paths[%d] names none of the %zu lights, from 0", reader->number,
                         world->light_count);
    *index = (size_t)number;
    if (!light && reader->others_move)
        return fail_path(reader, "is the second path of all other lights");
    if (light && paths[*index].kind != PATH_REST)
        return fail_path(reader, "is the second path of its light");
    if (light && !circle && !scene_light_has(&world->lights[*index], SCENE_LIGHT_POSITION))
        return base_fail(reader->error, reader->file,
                         "paths[%d] moves a %s light, which has no position (circle rotates it)",
                         reader->number,
                         scene_light_kinds[world->lights[*index].emitter.kind].name);
    return true;
}

/* Fills the path of the lights that an entry names. */
static bool read_path(const path_reader *reader, json_t *entry, const scene *world, path *paths) {
    static const char *const known[] = { "light", "keys", "smooth", "circle", "bounce", NULL };
    json_t *light = json_object_get(entry, "light"), *keys = json_object_get(entry, "keys"),
           *smooth = json_object_get(entry, "smooth"), *circle = json_object_get(entry, "circle"),
           *fall = json_object_get(entry, "bounce");
    if (!json_is_object(entry))
        return fail_path(reader, "is not an object");
    if (!only_keys(reader, entry, known))
        return false;
    if (!!keys + !!circle + !!fall != 1)
        return fail_path(reader, "needs one of keys, circle and bounce");
    if (!keys && !json_is_object(circle ? circle : fall))
        return fail_path(reader, circle ? "has a circle that is not an object"
                                        : "has a bounce that is not an object");
    size_t index = 0;
    if (!read_light(reader, light, circle, world, paths, &index))
        return false;
    if (smooth && !json_is_boolean(smooth))
        return fail_path(reader, "has a smooth that is neither true nor false");
    if (keys && !light)
        return fail_path(reader, "has keys, but no light that follows them");
    path own = { .smooth = json_is_true(smooth) };
    path *p = light ? &paths[index] : &own;
    *p = own;
    if (keys ? !read_keys(reader, keys, &world->lights[index], p)
             : !(circle ? read_circle(reader, circle, p) : read_bounce(reader, fall, p)))
        return false;
    for (size_t i = 0; !light && i < world->light_count; i++)
        if (paths[i].kind == PATH_REST)
            paths[i] = own;
    return true;
}

bool animation_read_paths(const char *file, const scene *world, path *paths, base_error *error) {
    json_t *root = file_read_json(file, FILE_LIMIT, error);
    if (!root)
        return false;
    json_t *list = file_json_list(file, root, "paths", error), *entry;
    path_reader reader = { .file = file, .origin = world->origin, .error = error };
    size_t i;
    bool ok = list;
    json_array_foreach (list, i, entry) {
        ok = ok && read_path(&reader, entry, world, paths);
        reader.others_move |= ok && !json_object_get(entry, "light");
        reader.number++;
    }
    json_decref(root);
    return ok;
}
