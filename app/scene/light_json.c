/* SPDX-License-Identifier: MIT */
/* light_json.c - a light as JSON, read and written by the table of kinds. */
#include "app/file/file.h"
#include "app/scene/light.h"
#include "app/scene/vector.h"
#include "app/scene/world.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <string.h>

/* The names of a kind's members that set the value at `offset`, or of all; joined by ", ". */
static const char *join(const scene_light_kind *kind, const scene_light_member *like, char *text,
                        size_t size) {
    size_t used = 0;
    text[0] = '\0';
    for (const scene_light_member *m = kind->members; m->name; m++)
        if ((!like || m->offset == like->offset) && used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "", m->name);
    return text;
}

static bool read_kind(const cJSON *object, scene_light *light, scene_light_error *error) {
    const cJSON *item = file_json_member(object, "kind");
    const char *given = cJSON_IsString(item) ? item->valuestring : "";
    const char *name = item ? given : scene_light_kinds[scene_light_kind_default].name;
    size_t used = 0;
    for (int i = 0; i < LMP_LIGHT_KINDS; i++)
        if (strcmp(name, scene_light_kinds[i].name) == 0) {
            light->emitter.kind = (lmp_light_kind)i;
            return true;
        }
    for (int i = 0; i < LMP_LIGHT_KINDS; i++)
        used += (size_t)snprintf(error->text + used, sizeof error->text - used, "%s%s",
                                 i ? ", " : ".kind is not one of ", scene_light_kinds[i].name);
    return false;
}

static bool check_keys(const cJSON *object, const scene_light_kind *kind,
                       scene_light_error *error) {
    const char *known[SCENE_LIGHT_MEMBERS_MAX + 4] = { "name", "kind", "hidden" };
    char names[80];
    for (int i = 0; kind->members[i].name; i++)
        known[3 + i] = kind->members[i].name;
    const char *unknown = file_json_unknown_key(object, known);
    /* it compares every pair: of the few known ones alone */
    const char *repeated = unknown ? NULL : file_json_repeated_key(object);
    if (unknown)
        snprintf(error->text, sizeof error->text,
                 " has an unknown key \"%.64s\" (a %s light has %s)", unknown, kind->name,
                 join(kind, NULL, names, sizeof names));
    else if (repeated)
        snprintf(error->text, sizeof error->text, " has the key \"%.64s\" twice", repeated);
    return !unknown && !repeated;
}

/* Of any size: the floats they become are checked. */
static bool read_numbers(const cJSON *item, const scene_light_member *member, double numbers[3]) {
    const bool three = scene_light_count(member) == 3;
    if (three && file_json_numbers(item, 3, -HUGE_VAL, HUGE_VAL, numbers))
        return true;
    if ((three && member->type != SCENE_LIGHT_COLOR) || !cJSON_IsNumber(item))
        return false;
    numbers[0] = numbers[1] = numbers[2] = item->valuedouble;
    return true;
}

/* A vector that is already a unit one to rounding stays as it is, so that what was written is read
 * back bit by bit. */
static void make_unit(double v[3]) {
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3 && length > 0 && fabs(length - 1) > 1e-6; k++)
        v[k] /= length;
}

static bool read_member(const cJSON *item, const scene_light_member *member, const double origin[3],
                        scene_light *light, scene_light_error *error) {
    static const char *const shapes[] = {
        [SCENE_LIGHT_POSITION] = "three numbers",  [SCENE_LIGHT_RADIUS] = "a number",
        [SCENE_LIGHT_DIRECTION] = "three numbers", [SCENE_LIGHT_ANGLE] = "a number, in radians",
        [SCENE_LIGHT_COLOR] = "a number or three",
    };
    double numbers[3];
    float *value = scene_light_value(&light->emitter, member);
    if (!read_numbers(item, member, numbers)) {
        snprintf(error->text, sizeof error->text, ".%s is not %s", member->name,
                 shapes[member->type]);
        return false;
    }
    if (member->type == SCENE_LIGHT_DIRECTION)
        make_unit(numbers);
    for (int k = 0; k < scene_light_count(member); k++) {
        const bool placed = member->type == SCENE_LIGHT_POSITION;
        const float given = scene_from_world(placed ? origin[k] : 0.0, numbers[k]);
        value[k] = member->convert ? member->convert(given, light->emitter.radius) : given;
    }
    return true;
}

/* Of the members that set one value just one is given. */
static bool given_once(const cJSON *object, const scene_light_kind *kind,
                       const scene_light_member *member, scene_light_error *error) {
    int given = 0, choices = 0;
    char names[80];
    for (const scene_light_member *m = kind->members; m->name; m++)
        if (m->offset == member->offset) {
            given += file_json_member(object, m->name) != NULL;
            choices++;
        }
    if (given == 1 || (given == 0 && member->optional))
        return true;
    snprintf(error->text, sizeof error->text, " needs %s%s", choices > 1 ? "one of " : "",
             join(kind, member, names, sizeof names));
    return false;
}

bool scene_light_from_json(const cJSON *object, const double origin[3], scene_light *light,
                           scene_light_error *error) {
    *light = (scene_light) { .hidden = 0 };
    if (!cJSON_IsObject(object)) {
        snprintf(error->text, sizeof error->text, " is not an object");
        return false;
    }
    if (!read_kind(object, light, error))
        return false;
    const scene_light_kind *kind = &scene_light_kinds[light->emitter.kind];
    if (!check_keys(object, kind, error))
        return false;
    for (const scene_light_member *m = kind->members; m->name; m++) {
        const cJSON *item = file_json_member(object, m->name);
        if (!given_once(object, kind, m, error) ||
            (item && (!read_member(item, m, origin, light, error) ||
                      !scene_light_check_member(&light->emitter, m, error))))
            return false;
    }
    const cJSON *hidden = file_json_member(object, "hidden");
    if (hidden && !cJSON_IsBool(hidden)) {
        snprintf(error->text, sizeof error->text, ".hidden is neither true nor false");
        return false;
    }
    light->hidden = cJSON_IsTrue(hidden) ? 1 : 0;
    return scene_light_check(light, error);
}

cJSON *scene_light_to_json(const scene_light *light, const double origin[3]) {
    lmp_light emitter = light->emitter;
    const scene_light_kind *kind = &scene_light_kinds[emitter.kind];
    cJSON *object = cJSON_CreateObject();
    cJSON_AddStringToObject(object, "kind", kind->name);
    for (const scene_light_member *m = kind->members; m->name; m++) {
        const float *value = scene_light_value(&emitter, m);
        if (m->type == SCENE_LIGHT_POSITION)
            scene_add_world(object, m->name, origin, value);
        else if (!m->convert)
            file_json_add_floats(object, m->name, value, scene_light_count(m));
    }
    if (light->hidden)
        cJSON_AddTrueToObject(object, "hidden");
    return object;
}
