/* SPDX-License-Identifier: MIT */
/* light_json.c - lights as JSON, read and written by the table of kinds. */
#include "app/base/file_json.h"
#include "app/scene/light.h"
#include "app/scene/vector.h"
#include "app/scene/world.h"

#include <stdio.h>
#include <string.h>

/* Joins the names of a kind's members by ", ": those that set the same value as `like`, or all. */
static const char *join(const scene_light_kind *kind, const scene_light_member *like, char *text,
                        size_t size) {
    size_t used = 0;
    text[0] = '\0';
    for (const scene_light_member *m = kind->members; m->name; m++)
        if ((!like || m->offset == like->offset) && used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "", m->name);
    return text;
}

static bool read_kind(json_t *object, scene_light *light, scene_light_error *error) {
    json_t *item = json_object_get(object, "kind");
    const char *given = json_is_string(item) ? json_string_value(item) : "";
    const char *name = item ? given : scene_light_kinds[scene_light_kind_default].name;
    size_t used = 0;
    for (int i = 0; i < SCENE_LIGHT_KIND_COUNT; i++)
        if (strcmp(name, scene_light_kinds[i].name) == 0) {
            light->emitter.kind = (lmp_light_kind)i;
            return true;
        }
    for (int i = 0; i < SCENE_LIGHT_KIND_COUNT; i++)
        used += (size_t)snprintf(error->text + used, sizeof error->text - used, "%s%s",
                                 i ? ", " : ".kind is not one of ", scene_light_kinds[i].name);
    return false;
}

static bool check_keys(json_t *object, const scene_light_kind *kind, scene_light_error *error) {
    const char *known[SCENE_LIGHT_MEMBERS_MAX + 4] = { "name", "kind", "hidden" };
    char names[80];
    for (int i = 0; kind->members[i].name; i++)
        known[3 + i] = kind->members[i].name;
    const char *unknown = file_json_unknown_key(object, known);
    if (unknown)
        snprintf(error->text, sizeof error->text,
                 " has an unknown key \"%.64s\" (a %s light has %s)", unknown, kind->name,
                 join(kind, NULL, names, sizeof names));
    return !unknown;
}

/* Reads one number or three, without limits: the floats they become are checked. */
static bool read_numbers(json_t *item, const lmp_light *light, const scene_light_member *member,
                         double numbers[3]) {
    const bool three = scene_light_count(light, member) == 3;
    if (three && file_json_numbers(item, 3, -HUGE_VAL, HUGE_VAL, numbers))
        return true;
    if ((three && member->type != SCENE_LIGHT_COLOR) || !json_is_number(item))
        return false;
    numbers[0] = numbers[1] = numbers[2] = json_number_value(item);
    return true;
}

/* Normalizes a vector, but leaves one that is already unit to rounding, so that what was written is
 * read back bit by bit. */
static void make_unit(double v[3]) {
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3 && length > 0 && fabs(length - 1) > 1e-6; k++)
        v[k] /= length;
}

/* Reads 3 to LMP_LIGHT_CORNERS_MAX vectors. */
static bool read_corners(json_t *item, lmp_light *light) {
    const size_t count = json_array_size(item);
    if (count < 3 || count > LMP_LIGHT_CORNERS_MAX)
        return false;
    light->corner_count = (int)count;
    for (size_t i = 0; i < count; i++) {
        double v[3];
        if (!file_json_numbers(json_array_get(item, i), 3, -HUGE_VAL, HUGE_VAL, v))
            return false;
        light->corner[i] = vec((float)v[0], (float)v[1], (float)v[2]);
    }
    return true;
}

static bool read_values(json_t *item, const scene_light_member *member, const double origin[3],
                        lmp_light *light) {
    double numbers[3];
    float *value = scene_light_value(light, member);
    if (!read_numbers(item, light, member, numbers))
        return false;
    if (member->type == SCENE_LIGHT_DIRECTION)
        make_unit(numbers);
    for (int k = 0; k < scene_light_count(light, member); k++) {
        const bool placed = member->type == SCENE_LIGHT_POSITION;
        const float given = scene_from_world(placed ? origin[k] : 0.0, numbers[k]);
        value[k] = member->convert ? member->convert(light, given) : given;
    }
    return true;
}

static bool read_member(json_t *item, const scene_light_member *member, const double origin[3],
                        lmp_light *light, scene_light_error *error) {
    static const char *const shapes[] = {
        [SCENE_LIGHT_POSITION] = "three numbers",
        [SCENE_LIGHT_RADIUS] = "a number",
        [SCENE_LIGHT_DIRECTION] = "three numbers",
        [SCENE_LIGHT_EXTENT] = "three numbers",
        [SCENE_LIGHT_CORNERS] = "a list of 3 to 8 corners, three numbers each",
        [SCENE_LIGHT_FLAG] = "true or false",
        [SCENE_LIGHT_ANGLE] = "a number, in radians",
        [SCENE_LIGHT_COLOR] = "a number or three",
    };
    bool read;
    if (member->type == SCENE_LIGHT_FLAG) {
        read = json_is_boolean(item);
        *scene_light_flag(light, member) = json_is_true(item);
    } else if (member->type == SCENE_LIGHT_CORNERS)
        read = read_corners(item, light);
    else
        read = read_values(item, member, origin, light);
    if (!read)
        snprintf(error->text, sizeof error->text, ".%s is not %s", member->name,
                 shapes[member->type]);
    return read;
}

/* Checks that of the members that set one value exactly one is given. */
static bool given_once(json_t *object, const scene_light_kind *kind,
                       const scene_light_member *member, scene_light_error *error) {
    int given = 0, choices = 0;
    char names[80];
    for (const scene_light_member *m = kind->members; m->name; m++)
        if (m->offset == member->offset) {
            given += json_object_get(object, m->name) != NULL;
            choices++;
        }
    if (given == 1 || (given == 0 && member->optional))
        return true;
    snprintf(error->text, sizeof error->text, " needs %s%s", choices > 1 ? "one of " : "",
             join(kind, member, names, sizeof names));
    return false;
}

/* Reads the members that are converted from another quantity, or those that are not. */
static bool read_members(json_t *object, const scene_light_kind *kind, bool converted,
                         const double origin[3], lmp_light *light, scene_light_error *error) {
    for (const scene_light_member *m = kind->members; m->name; m++) {
        json_t *item = json_object_get(object, m->name);
        if (!given_once(object, kind, m, error) || (item && (m->convert != NULL) == converted &&
                                                    (!read_member(item, m, origin, light, error) ||
                                                     !scene_light_check_member(light, m, error))))
            return false;
    }
    return true;
}

static bool read_hidden(json_t *object, scene_light *light, scene_light_error *error) {
    json_t *hidden = json_object_get(object, "hidden");
    if (hidden && !json_is_boolean(hidden)) {
        snprintf(error->text, sizeof error->text, ".hidden is neither true nor false");
        return false;
    }
    light->hidden = json_is_true(hidden) ? 1 : 0;
    return true;
}

/* The shape is checked before what is converted by it. */
bool scene_light_from_json(json_t *object, const double origin[3], scene_light *light,
                           scene_light_error *error) {
    *light = (scene_light) { .hidden = 0 };
    if (!json_is_object(object)) {
        snprintf(error->text, sizeof error->text, " is not an object");
        return false;
    }
    if (!read_kind(object, light, error))
        return false;
    const scene_light_kind *kind = &scene_light_kinds[light->emitter.kind];
    return check_keys(object, kind, error) &&
           read_members(object, kind, false, origin, &light->emitter, error) &&
           scene_light_check(light, error) &&
           read_members(object, kind, true, origin, &light->emitter, error) &&
           read_hidden(object, light, error) && scene_light_check(light, error);
}

static json_t *corners_to_json(const lmp_light *light) {
    json_t *list = json_array();
    for (int i = 0; i < light->corner_count; i++)
        list = file_json_append(list, file_json_floats(&light->corner[i].x, 3));
    return list;
}

json_t *scene_light_to_json(const scene_light *light, const double origin[3]) {
    lmp_light emitter = light->emitter;
    const scene_light_kind *kind = &scene_light_kinds[emitter.kind];
    json_t *object = json_pack("{s:s}", "kind", kind->name);
    for (const scene_light_member *m = kind->members; m->name; m++) {
        const float *value = scene_light_value(&emitter, m);
        const int count = scene_light_count(&emitter, m);
        if (m->type == SCENE_LIGHT_POSITION)
            object = file_json_with(object, m->name, scene_world_to_json(origin, value));
        else if (m->type == SCENE_LIGHT_CORNERS)
            object = file_json_with(object, m->name, corners_to_json(&emitter));
        else if (m->type == SCENE_LIGHT_FLAG)
            object = file_json_with(object, m->name, json_boolean(*scene_light_flag(&emitter, m)));
        else if (!m->convert)
            object = file_json_with(object, m->name,
                                    count == 1 ? file_json_float(*value)
                                               : file_json_floats(value, (size_t)count));
    }
    return light->hidden ? file_json_with(object, "hidden", json_true()) : object;
}
