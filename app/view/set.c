/* SPDX-License-Identifier: MIT */
/* set.c - sets one value, by the names that it has in the state's JSON. */
#include "app/base/file_json.h"
#include "app/view/aim.h"
#include "app/view/lights.h"
#include "app/view/state.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Reads a value as it is typed: JSON, several numbers separated by commas, or else a text. */
static json_t *parse_value(const char *typed) {
    char list[VIEW_TYPED_SIZE + 2];
    json_error_t wrong;
    snprintf(list, sizeof list, strchr(typed, ',') ? "[%s]" : "%s", typed);
    json_t *const value = file_json_load(list, strlen(list), &wrong);
    return value ? value : file_json_string(typed);
}

/* Returns what follows `begin` in a path, or NULL. */
static const char *after(const char *path, const char *begin) {
    const size_t length = strlen(begin);
    return strncmp(path, begin, length) == 0 ? path + length : NULL;
}

/* Reads the index that a path begins with and what follows the slash after it. */
static bool read_index(const char *path, size_t count, size_t *index, const char **rest) {
    char *end;
    *index = strtoul(path, &end, 10);
    *rest = end + (*end == '/');
    return isdigit((unsigned char)path[0]) && *index < count;
}

/* --- lights ----------------------------------------------------------------------------------- */

/* Returns the light as JSON with one member replaced, and without others that set the same value.
 */
static json_t *light_with(const scene_light *light, const double origin[3], const char *name,
                          const char *typed) {
    const scene_light_member *members = scene_light_kinds[light->emitter.kind].members;
    const scene_light_member *given = members;
    while (given->name && strcmp(given->name, name) != 0)
        given++;
    json_t *object = scene_light_to_json(light, origin);
    for (const scene_light_member *m = members; given->name && m->name; m++)
        if (m->offset == given->offset)
            json_object_del(object, m->name);
    return file_json_with(object, name, parse_value(typed));
}

bool view_set_light(view_state *s, size_t index, const char *name, const char *typed,
                    base_error *error) {
    scene_light *light = &s->now.lights[index], changed;
    scene_light_error wrong;
    for (int kind = 0; strcmp(name, "kind") == 0 && kind < SCENE_LIGHT_KIND_COUNT; kind++)
        if (strcmp(typed, scene_light_kinds[kind].name) == 0) {
            view_make_kind(s, (int)index, kind);
            return true;
        }
    json_t *object = light_with(light, s->now.origin, name, typed);
    if (!object)
        return base_fail(error, NULL, "out of memory");
    const bool ok = scene_light_from_json(object, s->now.origin, &changed, &wrong);
    json_decref(object);
    if (!ok)
        return base_fail(error, "the light", "%s", wrong.text + strspn(wrong.text, ". "));
    changed.glow = light->glow;
    changed.glows_both = light->glows_both;
    *light = changed;
    s->lights_edited = true;
    return true;
}

/* --- what the viewer alone knows -------------------------------------------------------------- */

static bool set_view(view_state *s, const char *name, const char *typed, base_error *error) {
    char *end;
    const double number = strtod(typed, &end);
    const bool is_number = end > typed && *end == '\0';
    int path, aim;
    if (strcmp(name, "selected") == 0 && is_number && number == floor(number) && number >= -1 &&
        number < (double)s->now.light_count)
        s->selected = (int)number;
    else if (strcmp(name, "node") == 0 && is_number && number == floor(number) && number >= -1 &&
             number < (double)s->world->node_count)
        s->node = (long)number;
    else if (strcmp(name, "seconds") == 0 && is_number && number >= 0 && number <= 1e6)
        s->seconds = number;
    else if (strcmp(name, "playing") == 0 && (typed[0] == 't' || typed[0] == 'f'))
        s->playing = typed[0] == 't';
    else if (strcmp(name, "camera") == 0 && is_number && number == floor(number) && number >= 0 &&
             number < (double)s->world->camera_count)
        view_use_camera(s, (int)number);
    else if (strcmp(name, "path") == 0 && (path = view_find_name(s->paths.names, typed)) >= 0)
        s->paths.at = path;
    else if (strcmp(name, "aim") == 0 && (aim = view_find_name(view_aim_names, typed)) >= 0) {
        if (s->aim != (view_aim)aim) /* the same again would end it */
            view_choose_aim(s, aim);
    } else
        return base_fail(error, name, "cannot be \"%s\"", typed);
    return true;
}

/* --- settings --------------------------------------------------------------------------------- */

static bool set_setting(view_state *s, const char *path, const char *typed, base_error *error) {
    const view_member *member = view_find_member(path);
    if (!member)
        return base_fail(error, path, "is nothing that can be set");
    json_t *item = parse_value(typed);
    const bool ok = view_read_member(member, item, &s->now);
    json_decref(item);
    for (int side = 0; side < 2; side++)
        view_hold_bands(&s->now.shading[side]);
    return ok || base_fail(error, path, "cannot be \"%s\"", typed);
}

/* --- any -------------------------------------------------------------------------------------- */

bool view_set(view_state *s, const char *path, const char *typed, base_error *error) {
    const char *rest, *name;
    size_t index;
    if ((rest = after(path, "lights/")))
        return read_index(rest, s->now.light_count, &index, &name)
                   ? view_set_light(s, index, name, typed, error)
                   : base_fail(error, path, "is no light");
    if ((rest = after(path, "materials/")))
        return view_replace_material(s, rest, typed[0] ? typed : NULL, error);
    if ((rest = after(path, "view/")))
        return set_view(s, rest, typed, error);
    return set_setting(s, path, typed, error);
}

/* Returns the length of the path that a line begins with: a material's name may have blanks. */
static size_t path_length(const view_state *s, const char *line) {
    const char *name = after(line, "materials/");
    for (size_t i = 0; name && i < s->world->material_count; i++) {
        const char *end = after(name, s->world->materials[i].name);
        if (end && (*end == ' ' || !*end))
            return (size_t)(end - line);
    }
    return strcspn(line, " ");
}

void view_set_by_line(view_state *s, const char *line) {
    char path[VIEW_PATH_SIZE];
    base_error error;
    const size_t length = path_length(s, line);
    snprintf(path, sizeof path, "%.*s", (int)length, line);
    if (!view_set(s, path, line + length + strspn(line + length, " "), &error))
        view_say(s, "%s", error.text);
}
