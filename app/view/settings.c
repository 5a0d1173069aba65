/* SPDX-License-Identifier: MIT */
#include "app/view/settings.h"
#include "app/base/file.h"
#include "app/base/file_json.h"
#include "app/image/image.h"
#include "app/render/renderer/bounces.h"
#include "app/scene/material.h"
#include "app/scene/shot.h"
#include "app/scene/vector.h"
#include "app/scene/world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const view_split_names[GPU_SPLITS + 1] = { "none", "divided", "difference", NULL };

/* --- materials -------------------------------------------------------------------------------- */

static int find_material(const view_replacements *m, const char *material_name) {
    const size_t length = strlen(material_name);
    for (int i = 0; i < m->count; i++)
        if (strncmp(m->texts[i], material_name, length) == 0 && m->texts[i][length] == '=')
            return i;
    return -1;
}

const char *view_material_of(const view_settings *s, const char *material_name) {
    const int index = find_material(&s->materials, material_name);
    return index < 0 ? NULL : s->materials.texts[index] + strlen(material_name) + 1;
}

int view_find_name(const char *const *names, const char *name) {
    for (int i = 0; names[i]; i++)
        if (strcmp(names[i], name) == 0)
            return i;
    return -1;
}

bool view_set_material(view_settings *s, const char *material_name, const char *replacement) {
    view_replacements *m = &s->materials;
    int index = find_material(m, material_name);
    if (!replacement) {
        if (index >= 0) {
            m->count--;
            memmove(m->texts[index], m->texts[index + 1],
                    (size_t)(m->count - index) * sizeof *m->texts);
            memset(m->texts[m->count], 0, sizeof *m->texts);
        }
        return true;
    }
    if (strchr(material_name, '=') ||
        strlen(material_name) + strlen(replacement) + 2 > sizeof *m->texts ||
        (index < 0 && m->count == RENDER_TABLES_MAX))
        return false;
    if (index < 0)
        index = m->count++;
    memset(m->texts[index], 0, sizeof *m->texts);
    snprintf(m->texts[index], sizeof *m->texts, "%s=%s", material_name, replacement);
    return true;
}

/* --- origin ----------------------------------------------------------------------------------- */

void view_settings_rebase(view_settings *s, const double origin[3]) {
    scene_point_rebase(s->origin, origin, s->camera.eye);
    scene_point_rebase(s->origin, origin, s->camera.target);
    for (size_t i = 0; i < s->light_count; i++) {
        lmp_vec3 *position = &s->lights[i].emitter.position;
        float point[3];
        vec_store(*position, point);
        scene_point_rebase(s->origin, origin, point);
        *position = vec_load(point);
    }
    memcpy(s->origin, origin, sizeof s->origin);
}

/* --- members ---------------------------------------------------------------------------------- */

#define FAR ((double)LMP_LENGTH_MAX)
#define MEMBER(label, kind, place)                                                                 \
    .name = (label), .type = VIEW_##kind, .offset = offsetof(view_settings, place)
#define SIDE(i)                                                                                    \
    { MEMBER("method", CHOICE, shading[i].method), .list = method_names },                         \
        { MEMBER("bands", INTEGER, shading[i].bands), .range = { 1, LMP_BANDS_MAX } },             \
        { MEMBER("window", CHOICE, shading[i].window), .list = method_window_names },

static const view_member left[] = { SIDE(0) { .name = NULL } },
                         right[] = { SIDE(1) { .name = NULL } };

static const view_member sides[] = {
    { MEMBER("0", OBJECT, shading[0]), .members = left },
    { MEMBER("1", OBJECT, shading[1]), .members = right },
    { .name = NULL },
};

static const view_member environment_members[] = {
    { MEMBER("name", FILE, environment.name) },
    { MEMBER("rotation", FLOAT, environment.rotation), .range = { -360, 360 } },
    { MEMBER("strength", FLOAT, environment.strength), .range = { 0, ENVIRONMENT_STRENGTH_MAX } },
    { .name = NULL },
};

static const view_member camera_members[] = {
    { MEMBER("eye", POINT, camera.eye) },
    { MEMBER("target", POINT, camera.target) },
    { MEMBER("up", FLOATS, camera.up), .range = { -FAR, FAR } },
    { MEMBER("fov", FLOAT, camera.fov), .range = { 0.001, 3.1 } },
    { MEMBER("height", FLOAT, camera.height), VIEW_UNUSUAL, .range = { 1e-6, FAR } },
    { .name = NULL },
};

/* In the order in which they are read: what is in the world needs the origin before it. */
static const view_member settings_members[] = {
    { MEMBER("scene", FILE, scene), VIEW_FIXED },
    { MEMBER("up", CHOICE, up), VIEW_FIXED | VIEW_UNUSUAL, .absent = SCENE_UP_Y,
      .choices = scene_up_names },
    { MEMBER("leaves", CHOICE, leaves), VIEW_FIXED | VIEW_UNUSUAL, .choices = scene_leaves_names },
    { MEMBER("variant", TEXT, variant), VIEW_FIXED | VIEW_UNUSUAL },
    { MEMBER("width", INTEGER, width), VIEW_FIXED, .range = { 1, IMAGE_SIZE_MAX } },
    { MEMBER("height", INTEGER, height), VIEW_FIXED, .range = { 1, IMAGE_SIZE_MAX } },
    { MEMBER("samples", INTEGER, samples), .range = { 1, VIEW_SAMPLES_MAX } },
    { MEMBER("shadows", FLAG, shadows), VIEW_OPTIONAL },
    { MEMBER("bounces", INTEGER, bounces), VIEW_UNUSUAL, .range = { 0, TRANSFER_BOUNCES_MAX } },
    { MEMBER("ground", CHOICE, environment.ground), VIEW_OPTIONAL, .absent = ENVIRONMENT_GROUND_OFF,
      .choices = environment_ground_names },
    { MEMBER("exposure", FLOAT, exposure), .range = { 1e-30, 1e30 } },
    { MEMBER("tone", CHOICE, tone), VIEW_OPTIONAL, .list = image_tone_names },
    { MEMBER("background", FLOATS, background), .range = { 0, 1e30 } },
    { MEMBER("environment", OBJECT, environment), VIEW_OPTIONAL, .members = environment_members },
    { MEMBER("origin", ORIGIN, origin), VIEW_FIXED | VIEW_UNUSUAL, .range = { -FAR, FAR } },
    { MEMBER("camera", OBJECT, camera), .members = camera_members },
    { MEMBER("looks", ARRAY, shading), .members = sides },
    { MEMBER("split", CHOICE, split), .choices = view_split_names },
    { MEMBER("divider", FLOAT, divider), .range = { 0, 1 } },
    { MEMBER("hidden", HIDDEN, hidden), VIEW_FIXED | VIEW_UNUSUAL },
    { MEMBER("materials", MATERIALS, materials), VIEW_FIXED },
    { MEMBER("lights", LIGHTS, lights), VIEW_FIXED },
    { .name = NULL },
};

/* --- to JSON ---------------------------------------------------------------------------------- */

static json_t *hidden_to_json(const view_hidden *hidden) {
    json_t *ranges = json_array();
    for (const view_range *r = hidden->ranges; r < hidden->ranges + hidden->count; r++)
        ranges = file_json_append(ranges,
                                  json_pack("[I, I]", (json_int_t)r->first, (json_int_t)r->last));
    return ranges;
}

static json_t *materials_to_json(const view_replacements *materials) {
    json_t *texts = json_array();
    for (int i = 0; i < materials->count; i++)
        texts = file_json_append(texts, file_json_string(materials->texts[i]));
    return texts;
}

static json_t *lights_to_json(const view_settings *s) {
    json_t *lights = json_array();
    for (size_t i = 0; i < s->light_count; i++)
        lights = file_json_append(lights, scene_light_to_json(&s->lights[i], s->origin));
    return lights;
}

const char *const *view_choices(const view_member *m) {
    return m->choices ? m->choices : m->list();
}

static json_t *members_to_json(const view_member *members, const view_settings *s, json_t *to);

static json_t *value_to_json(const view_member *m, const view_settings *s) {
    const void *value = (const char *)s + m->offset;
    switch (m->type) {
    case VIEW_FLAG:
        return json_boolean(*(const bool *)value);
    case VIEW_INTEGER:
        return json_integer(*(const int *)value);
    case VIEW_CHOICE:
        return json_string(view_choices(m)[*(const int *)value]);
    case VIEW_FLOAT:
        return file_json_float(*(const float *)value);
    case VIEW_FLOATS:
        return file_json_floats(value, 3);
    case VIEW_POINT:
        return scene_world_to_json(s->origin, value);
    case VIEW_ORIGIN: /* so that what is in the world is restored to the bit */
        return scene_world_to_json(s->origin, (const float[3]) { 0, 0, 0 });
    case VIEW_FILE:
    case VIEW_TEXT:
        return file_json_string(value);
    case VIEW_OBJECT:
        return members_to_json(m->members, s, json_object());
    case VIEW_ARRAY:
        return members_to_json(m->members, s, json_array());
    case VIEW_HIDDEN:
        return hidden_to_json(&s->hidden);
    case VIEW_MATERIALS:
        return materials_to_json(&s->materials);
    case VIEW_LIGHTS:
        return lights_to_json(s);
    }
    return NULL;
}

/* Whether the value is what it is when absent. */
static bool is_usual(const view_member *m, const view_settings *s) {
    const void *value = (const char *)s + m->offset;
    return m->type == VIEW_TEXT     ? *(const char *)value == '\0'
           : m->type == VIEW_FLOAT  ? *(const float *)value == 0
           : m->type == VIEW_ORIGIN ? scene_origin_is_0(s->origin)
           : m->type == VIEW_HIDDEN ? s->hidden.count == 0
                                    : *(const int *)value == m->absent;
}

/* Adds the members to an object or an array, and takes it. */
static json_t *members_to_json(const view_member *members, const view_settings *s, json_t *to) {
    for (const view_member *m = members; m->name; m++)
        if (json_is_array(to))
            to = file_json_append(to, value_to_json(m, s));
        else if (!(m->traits & VIEW_UNUSUAL && is_usual(m, s)))
            to = file_json_with(to, m->name, value_to_json(m, s));
    return to;
}

json_t *view_settings_to_json(const view_settings *s) {
    return members_to_json(settings_members, s, json_object());
}

/* --- from JSON -------------------------------------------------------------------------------- */

static bool read_lights(json_t *array, view_settings *s) {
    const size_t count = json_array_size(array);
    scene_light_error wrong;
    bool ok = json_is_array(array) && count <= SCENE_LIGHTS_MAX;
    for (; ok && s->light_count < count; s->light_count++)
        ok = scene_light_from_json(json_array_get(array, s->light_count), s->origin,
                                   &s->lights[s->light_count], &wrong);
    return ok;
}

static bool read_materials(json_t *array, view_settings *s) {
    json_t *item;
    size_t i;
    if (!json_is_array(array) || json_array_size(array) > RENDER_TABLES_MAX)
        return false;
    json_array_foreach (array, i, item) {
        const char *text = json_is_string(item) ? json_string_value(item) : "";
        const char *equals = strchr(text, '=');
        char material_name[SCENE_NAME_SIZE] = "";
        if (!equals || (size_t)(equals - text) >= sizeof material_name ||
            file_is_standard_input(equals + 1))
            return false;
        memcpy(material_name, text, (size_t)(equals - text));
        if (!view_set_material(s, material_name, equals + 1))
            return false;
    }
    return true;
}

static bool read_hidden(json_t *array, view_hidden *hidden) {
    json_t *item;
    double least = 0, range[2];
    size_t i;
    if (!json_is_array(array) || json_array_size(array) > VIEW_HIDDEN_MAX)
        return false;
    json_array_foreach (array, i, item) {
        if (!file_json_numbers(item, 2, least, UINT32_MAX - 1, range) || range[1] < range[0] ||
            range[0] != floor(range[0]) || range[1] != floor(range[1]))
            return false;
        hidden->ranges[hidden->count++] = (view_range) { (uint32_t)range[0], (uint32_t)range[1] };
        least = range[1] + 2;
    }
    return true;
}

/* Reads a text of fewer bytes than `size`. */
static bool read_text(const json_t *item, size_t size, char *text) {
    if (!json_is_string(item) || strlen(json_string_value(item)) >= size)
        return false;
    strcpy(text, json_string_value(item));
    return true;
}

static bool read_integer(const view_member *m, const json_t *item, int *value) {
    double number;
    if (!file_json_number(item, m->range[0], m->range[1], &number) || number != floor(number))
        return false;
    *value = (int)number;
    return true;
}

static bool read_floats(const view_member *m, const json_t *item, int count, float *values) {
    double numbers[3];
    /* limits in float, so that the float nearest to a limit is accepted */
    const double least = (double)(float)m->range[0], most = (double)(float)m->range[1];
    if (!(count == 1 ? file_json_number(item, least, most, numbers)
                     : file_json_numbers(item, (size_t)count, least, most, numbers)))
        return false;
    for (int i = 0; i < count; i++)
        values[i] = (float)numbers[i];
    return true;
}

static bool read_choice(const view_member *m, const json_t *item, int *value) {
    const int found =
        json_is_string(item) ? view_find_name(view_choices(m), json_string_value(item)) : -1;
    *value = found < 0 ? *value : found;
    return found >= 0;
}

static bool read_origin(const view_member *m, const json_t *item, double origin[3]) {
    if (!file_json_numbers(item, 3, m->range[0], m->range[1], origin))
        return false;
    for (int k = 0; k < 3; k++)
        origin[k] += 0.0; /* turns -0 into 0 */
    return true;
}

static const char *read_members(const view_member *members, const json_t *from, view_settings *s);

bool view_read_member(const view_member *m, json_t *item, view_settings *s) {
    void *value = (char *)s + m->offset;
    switch (m->type) {
    case VIEW_FLAG:
        *(bool *)value = json_is_boolean(item) ? json_is_true(item) : *(bool *)value;
        return json_is_boolean(item);
    case VIEW_INTEGER:
        return read_integer(m, item, value);
    case VIEW_CHOICE:
        return read_choice(m, item, value);
    case VIEW_FLOAT:
        return read_floats(m, item, 1, value);
    case VIEW_FLOATS:
        return read_floats(m, item, 3, value);
    case VIEW_POINT:
        return scene_read_world(item, s->origin, value);
    case VIEW_ORIGIN:
        return read_origin(m, item, s->origin);
    case VIEW_FILE:
        return !(json_is_string(item) && file_is_standard_input(json_string_value(item))) &&
               read_text(item, VIEW_PATH_SIZE, value);
    case VIEW_TEXT:
        return read_text(item, SCENE_NAME_SIZE, value);
    case VIEW_OBJECT:
        return json_is_object(item) && !read_members(m->members, item, s);
    case VIEW_ARRAY:
        return json_array_size(item) == 2 && !read_members(m->members, item, s);
    case VIEW_HIDDEN:
        return read_hidden(item, &s->hidden);
    case VIEW_MATERIALS:
        return read_materials(item, s);
    case VIEW_LIGHTS:
        return read_lights(item, s);
    }
    return false;
}

/* Reads all members; returns the name of one that is wrong, or NULL. */
static const char *read_members(const view_member *members, const json_t *from, view_settings *s) {
    for (const view_member *m = members; m->name; m++) {
        json_t *item = json_is_array(from) ? json_array_get(from, (size_t)(m - members))
                                           : json_object_get(from, m->name);
        const bool absent = !item && m->traits & (VIEW_OPTIONAL | VIEW_UNUSUAL);
        if (absent && m->absent != 0)
            *(int *)((char *)s + m->offset) = m->absent;
        else if (!absent && !view_read_member(m, item, s))
            return m->name;
    }
    return NULL;
}

int view_bands_max(const view_shading *shading) {
    return method_table[shading->method].bands_max[DEVICE_AUTO];
}

void view_hold_bands(view_shading *shading) {
    const int most = view_bands_max(shading);
    shading->bands = shading->bands < 1 ? 1 : shading->bands > most ? most : shading->bands;
}

bool view_settings_from_json(const json_t *root, const char *subject, view_settings *s,
                             base_error *error) {
    memset(s, 0, view_settings_size(s));
    const char *wrong = json_is_object(root) ? read_members(settings_members, root, s) : "settings";
    if (!json_object_get(root, "environment"))
        strcpy(s->environment.name, "none");
    for (int i = 0; i < 2 && !wrong; i++)
        wrong = s->shading[i].bands > view_bands_max(&s->shading[i]) ? "looks" : NULL;
    if (!wrong && (long)s->width * s->height > IMAGE_PIXELS_MAX)
        wrong = "width";
    if (!wrong)
        return true;
    memset(s, 0, view_settings_size(s));
    return base_fail(error, subject, "has settings with invalid \"%s\"", wrong);
}

const view_member *view_find_member(const char *path) {
    for (const view_member *m = settings_members;; m = m->members) {
        const size_t length = strcspn(path, "/");
        while (m->name && (strlen(m->name) != length || strncmp(m->name, path, length) != 0))
            m++;
        if (!m->name || m->traits & VIEW_FIXED)
            return NULL;
        path += length;
        if (!m->members)
            return *path ? NULL : m;
        path += *path == '/';
    }
}

/* --- screenshots ------------------------------------------------------------------------------ */

bool view_write_shot(const view_settings *s, const unsigned char *rgb8, const char *path,
                     base_error *error) {
    char *text = file_json_text(view_settings_to_json(s), false, path, error);
    if (!text)
        return false;
    const image_text chunk = { SHOT_KEY, text };
    const bool ok = image_write_png8_text(rgb8, s->width, s->height, &chunk, path, error);
    free(text);
    return ok;
}

/* Checks a name of so many bytes that a screenshot uses for `part`. */
static bool check_name(const char *shot, const char *part, const char *name, size_t length,
                       base_error *error) {
    char path[VIEW_MATERIAL_SIZE];
    snprintf(path, sizeof path, "%.*s", (int)length, name);
    return file_confine(path, shot) ||
           base_fail(error, shot,
                     "names the %s \"%.300s\", which is outside its folder (see --allow-paths)",
                     part, path);
}

/* Whether an entry of the list replaces the material of a text NAME=MATERIAL. */
static bool is_replaced(const cli_list *list, const char *text) {
    const size_t length = strcspn(text, "=") + 1;
    for (int i = 0; list && i < list->count; i++)
        if (strncmp(list->items[i], text, length) == 0)
            return true;
    return false;
}

/* Checks every setting that names a file. A screenshot is untrusted and may name a private file, or
 * one that must not even be opened. */
static bool check_names(const view_settings *s, const char *shot, const view_shot_options *options,
                        base_error *error) {
    if (options->allow_paths)
        return true;
    if (!options->scene && scene_is_file(s->scene) &&
        !check_name(shot, "scene", s->scene, strlen(s->scene), error))
        return false;
    if (s->environment.name[0] && environment_is_file(s->environment.name) &&
        !check_name(shot, "environment", s->environment.name, strlen(s->environment.name), error))
        return false;
    for (int i = 0; i < s->materials.count; i++) {
        size_t length;
        const char *const file =
            material_file_named(strchr(s->materials.texts[i], '=') + 1, &length);
        if (file && !is_replaced(options->materials, s->materials.texts[i]) &&
            !check_name(shot, "material", file, length, error))
            return false;
    }
    return true;
}

bool view_shot_confines(const view_settings *s, const char *path) {
    static const view_shot_options strict = { .scene = NULL };
    base_error error;
    return check_names(s, path, &strict, &error);
}

bool view_read_shot(const char *path, const view_shot_options *options, view_settings *s,
                    base_error *error) {
    memset(s, 0, view_settings_size(s));
    json_t *root = shot_read(path, error);
    const bool ok = root && view_settings_from_json(root, path, s, error);
    json_decref(root);
    if (ok && (long)s->width * s->height > options->pixels_max)
        return base_fail(error, path, "asks for %d x %d pixels (at most %d; see --max-pixels)",
                         s->width, s->height, options->pixels_max);
    return ok && check_names(s, path, options, error);
}
