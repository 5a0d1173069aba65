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

static int find_material(const view_settings *s, const char *material_name) {
    const size_t length = strlen(material_name);
    for (int i = 0; i < s->material_count; i++)
        if (strncmp(s->materials[i], material_name, length) == 0 && s->materials[i][length] == '=')
            return i;
    return -1;
}

const char *view_material_of(const view_settings *s, const char *material_name) {
    const int index = find_material(s, material_name);
    return index < 0 ? NULL : s->materials[index] + strlen(material_name) + 1;
}

int view_find_name(const char *const *names, const char *name) {
    for (int i = 0; names[i]; i++)
        if (strcmp(names[i], name) == 0)
            return i;
    return -1;
}

bool view_set_material(view_settings *s, const char *material_name, const char *replacement) {
    int index = find_material(s, material_name);
    if (!replacement) {
        if (index >= 0) {
            s->material_count--;
            memmove(s->materials[index], s->materials[index + 1],
                    (size_t)(s->material_count - index) * sizeof s->materials[0]);
            memset(s->materials[s->material_count], 0, sizeof s->materials[0]);
        }
        return true;
    }
    if (strchr(material_name, '=') ||
        strlen(material_name) + strlen(replacement) + 2 > sizeof s->materials[0] ||
        (index < 0 && s->material_count == RENDER_TABLES_MAX))
        return false;
    if (index < 0)
        index = s->material_count++;
    memset(s->materials[index], 0, sizeof s->materials[0]);
    snprintf(s->materials[index], sizeof s->materials[0], "%s=%s", material_name, replacement);
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

/* --- to JSON ---------------------------------------------------------------------------------- */

static json_t *camera_to_json(const view_settings *s) {
    const scene_camera *camera = &s->camera;
    json_t *object =
        json_pack("{s:o, s:o, s:o, s:o}", "eye", scene_world_to_json(s->origin, camera->eye),
                  "target", scene_world_to_json(s->origin, camera->target), "up",
                  file_json_floats(camera->up, 3), "fov", file_json_float(camera->fov));
    return camera->height > 0 ? file_json_with(object, "height", file_json_float(camera->height))
                              : object;
}

static json_t *shading_to_json(const view_shading *shading) {
    return json_pack("{s:s, s:i, s:s}", "method", method_table[shading->method].name, "bands",
                     shading->bands, "window", lmp_sh_window_name(shading->window));
}

static json_t *environment_to_json(const view_settings *s) {
    return json_pack("{s:o, s:o, s:o}", "name", file_json_string(s->environment), "rotation",
                     file_json_float(s->environment_rotation), "strength",
                     file_json_float(s->environment_strength));
}

static json_t *hidden_to_json(const view_settings *s) {
    json_t *ranges = json_array();
    for (int i = 0; i < s->hidden_count; i++)
        ranges = file_json_append(ranges, json_pack("[I, I]", (json_int_t)s->hidden[i].first,
                                                    (json_int_t)s->hidden[i].last));
    return ranges;
}

json_t *view_settings_to_json(const view_settings *s) {
    json_t *materials = json_array(), *lights = json_array();
    for (int i = 0; i < s->material_count; i++)
        materials = file_json_append(materials, file_json_string(s->materials[i]));
    for (size_t i = 0; i < s->light_count; i++)
        lights = file_json_append(lights, scene_light_to_json(&s->lights[i], s->origin));
    json_t *root = json_pack("{s:o}", "scene", file_json_string(s->scene));
    if (s->up == SCENE_UP_Z)
        root = file_json_with(root, "up", json_string(scene_up_names[s->up]));
    if (s->leaves != SCENE_LEAVES_TRANSLUCENT)
        root = file_json_with(root, "leaves", json_string(scene_leaves_names[s->leaves]));
    if (s->variant[0])
        root = file_json_with(root, "variant", file_json_string(s->variant));
    root = file_json_with(root, "width", json_integer(s->width));
    root = file_json_with(root, "height", json_integer(s->height));
    root = file_json_with(root, "samples", json_integer(s->samples));
    root = file_json_with(root, "shadows", json_boolean(s->shadows));
    if (s->bounces > 0)
        root = file_json_with(root, "bounces", json_integer(s->bounces));
    root = file_json_with(root, "ground", json_string(environment_ground_names[s->ground]));
    root = file_json_with(root, "exposure", file_json_float(s->exposure));
    root = file_json_with(root, "tone", json_string(image_tones[s->tone].name));
    root = file_json_with(root, "background", file_json_floats(s->background, 3));
    root = file_json_with(root, "environment", environment_to_json(s));
    /* Written where it is not 0, so that what is in the world is restored to the bit. */
    if (!scene_origin_is_0(s->origin))
        root = file_json_with(root, "origin",
                              scene_world_to_json(s->origin, (const float[3]) { 0, 0, 0 }));
    root = file_json_with(root, "camera", camera_to_json(s));
    root = file_json_with(
        root, "looks",
        json_pack("[o, o]", shading_to_json(&s->shading[0]), shading_to_json(&s->shading[1])));
    root = file_json_with(root, "split", json_string(view_split_names[s->split]));
    root = file_json_with(root, "divider", file_json_float(s->divider));
    if (s->hidden_count > 0)
        root = file_json_with(root, "hidden", hidden_to_json(s));
    root = file_json_with(root, "materials", materials);
    return file_json_with(root, "lights", lights);
}

/* --- from JSON -------------------------------------------------------------------------------- */

static bool read_int(const json_t *object, const char *name, int minimum, int maximum, int *value) {
    double number;
    if (!file_json_number(json_object_get(object, name), minimum, maximum, &number) ||
        number != floor(number))
        return false;
    *value = (int)number;
    return true;
}

static bool read_float(const json_t *object, const char *name, double minimum, double maximum,
                       float *value) {
    double number;
    /* limits in float, so that the float nearest to a limit is accepted */
    if (!file_json_number(json_object_get(object, name), (double)(float)minimum,
                          (double)(float)maximum, &number))
        return false;
    *value = (float)number;
    return true;
}

static bool read_floats(const json_t *object, const char *name, double minimum, double maximum,
                        float value[3]) {
    double numbers[3];
    if (!file_json_numbers(json_object_get(object, name), 3, minimum, (double)(float)maximum,
                           numbers))
        return false;
    for (int i = 0; i < 3; i++)
        value[i] = (float)numbers[i];
    return true;
}

static bool read_choice(const json_t *object, const char *name, const char *const *choices,
                        int *value) {
    const json_t *item = json_object_get(object, name);
    const int found = json_is_string(item) ? view_find_name(choices, json_string_value(item)) : -1;
    *value = found < 0 ? *value : found;
    return found >= 0;
}

/* Reads a choice, or returns `absent` if the object does not have it. */
static bool read_choice_or(const json_t *object, const char *name, const char *const *choices,
                           int absent, int *value) {
    *value = absent;
    return !json_object_get(object, name) || read_choice(object, name, choices, value);
}

/* Reads the up axis; absent means that nothing is rotated. */
static bool read_up(const json_t *root, int *up) {
    return read_choice_or(root, "up", scene_up_names, SCENE_UP_Y, up);
}

static bool read_leaves(const json_t *root, int *leaves) {
    return read_choice_or(root, "leaves", scene_leaves_names, SCENE_LEAVES_TRANSLUCENT, leaves);
}

/* Reads the variant; absent means the materials of the scene's file. */
static bool read_variant(const json_t *root, char variant[SCENE_NAME_SIZE]) {
    const json_t *item = json_object_get(root, "variant");
    if (item && (!json_is_string(item) || strlen(json_string_value(item)) >= SCENE_NAME_SIZE))
        return false;
    strcpy(variant, item ? json_string_value(item) : "");
    return true;
}

/* Reads the tone curve, which screenshots of early versions lack. */
static bool read_tone(const json_t *root, int *tone) {
    return read_choice_or(root, "tone", image_tone_names(), 0, tone);
}

/* Reads whether there are shadows, which screenshots of early versions lack. */
static bool read_shadows(const json_t *root, bool *shadows) {
    const json_t *item = json_object_get(root, "shadows");
    *shadows = json_is_true(item);
    return !item || json_is_boolean(item);
}

/* Reads how often light bounces; absent means not at all. */
static bool read_bounces(const json_t *root, int *bounces) {
    return !json_object_get(root, "bounces") ||
           read_int(root, "bounces", 0, TRANSFER_BOUNCES_MAX, bounces);
}

/* Reads the ground, which screenshots of early versions lack. */
static bool read_ground(const json_t *root, int *ground) {
    return read_choice_or(root, "ground", environment_ground_names, ENVIRONMENT_GROUND_OFF, ground);
}

/* Reads the origin; absent means 0. */
static bool read_origin(const json_t *root, double origin[3]) {
    const double far = (double)LMP_LENGTH_MAX;
    const json_t *item = json_object_get(root, "origin");
    if (item && !file_json_numbers(item, 3, -far, far, origin))
        return false;
    for (int k = 0; k < 3; k++)
        origin[k] += 0.0; /* turns -0 into 0 */
    return true;
}

static bool read_camera(const json_t *root, const double origin[3], scene_camera *camera) {
    const double far = (double)LMP_LENGTH_MAX;
    const json_t *object = json_object_get(root, "camera");
    return scene_read_world(json_object_get(object, "eye"), origin, camera->eye) &&
           scene_read_world(json_object_get(object, "target"), origin, camera->target) &&
           read_floats(object, "up", -far, far, camera->up) &&
           read_float(object, "fov", 0.001, 3.1, &camera->fov) &&
           (!json_object_get(object, "height") ||
            read_float(object, "height", 1e-6, far, &camera->height));
}

static bool read_shading(const json_t *object, view_shading *shading) {
    int method, window;
    if (!read_choice(object, "method", method_names(), &method) ||
        !read_choice(object, "window", method_window_names(), &window))
        return false;
    shading->method = (method_kind)method;
    shading->window = (lmp_window)window;
    return read_int(object, "bands", 1, method_table[shading->method].bands_max[DEVICE_AUTO],
                    &shading->bands);
}

static bool read_both_shadings(const json_t *root, view_shading both[2]) {
    const json_t *array = json_object_get(root, "looks");
    return json_array_size(array) == 2 && read_shading(json_array_get(array, 0), &both[0]) &&
           read_shading(json_array_get(array, 1), &both[1]);
}

static bool read_lights(const json_t *root, view_settings *s) {
    const json_t *array = json_object_get(root, "lights");
    const size_t count = json_array_size(array);
    scene_light_error wrong;
    bool ok = json_is_array(array) && count <= SCENE_LIGHTS_MAX;
    for (; ok && s->light_count < count; s->light_count++)
        ok = scene_light_from_json(json_array_get(array, s->light_count), s->origin,
                                   &s->lights[s->light_count], &wrong);
    return ok;
}

static bool read_materials(const json_t *root, view_settings *s) {
    json_t *array = json_object_get(root, "materials"), *item;
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

/* Reads which nodes are hidden: none if that is absent. */
static bool read_hidden(const json_t *root, view_settings *s) {
    json_t *array = json_object_get(root, "hidden"), *item;
    double least = 0, range[2];
    size_t i;
    if (array && (!json_is_array(array) || json_array_size(array) > VIEW_HIDDEN_MAX))
        return false;
    json_array_foreach (array, i, item) {
        if (!file_json_numbers(item, 2, least, UINT32_MAX - 1, range) || range[1] < range[0] ||
            range[0] != floor(range[0]) || range[1] != floor(range[1]))
            return false;
        s->hidden[s->hidden_count++] = (view_range) { (uint32_t)range[0], (uint32_t)range[1] };
        least = range[1] + 2;
    }
    return true;
}

static bool read_path(const json_t *object, const char *member, char name[VIEW_PATH_SIZE]) {
    const json_t *item = json_object_get(object, member);
    if (!json_is_string(item) || strlen(json_string_value(item)) >= VIEW_PATH_SIZE ||
        file_is_standard_input(json_string_value(item)))
        return false;
    strcpy(name, json_string_value(item));
    return true;
}

/* Reads the environment, which screenshots of early versions lack. */
static bool read_environment(const json_t *root, view_settings *s) {
    const json_t *object = json_object_get(root, "environment");
    if (!object)
        strcpy(s->environment, "none");
    return !object ||
           (read_path(object, "name", s->environment) &&
            read_float(object, "rotation", -360, 360, &s->environment_rotation) &&
            read_float(object, "strength", 0, ENVIRONMENT_STRENGTH_MAX, &s->environment_strength));
}

bool view_settings_from_json(const json_t *root, const char *subject, view_settings *s,
                             base_error *error) {
    memset(s, 0, view_settings_size(s));
    int split = 0;
    const char *wrong = !json_is_object(root)                                          ? "settings"
                        : !read_path(root, "scene", s->scene)                          ? "scene"
                        : !read_up(root, &s->up)                                       ? "up"
                        : !read_leaves(root, &s->leaves)                               ? "leaves"
                        : !read_variant(root, s->variant)                              ? "variant"
                        : !read_int(root, "width", 1, IMAGE_SIZE_MAX, &s->width)       ? "width"
                        : !read_int(root, "height", 1, IMAGE_SIZE_MAX, &s->height)     ? "height"
                        : !read_int(root, "samples", 1, VIEW_SAMPLES_MAX, &s->samples) ? "samples"
                        : !read_shadows(root, &s->shadows)                             ? "shadows"
                        : !read_bounces(root, &s->bounces)                             ? "bounces"
                        : !read_ground(root, &s->ground)                               ? "ground"
                        : !read_float(root, "exposure", 1e-30, 1e30, &s->exposure)     ? "exposure"
                        : !read_tone(root, &s->tone)                                   ? "tone"
                        : !read_floats(root, "background", 0, 1e30, s->background) ? "background"
                        : !read_environment(root, s)                               ? "environment"
                        : !read_origin(root, s->origin)                            ? "origin"
                        : !read_camera(root, s->origin, &s->camera)                ? "camera"
                        : !read_both_shadings(root, s->shading)                    ? "looks"
                        : !read_choice(root, "split", view_split_names, &split)    ? "split"
                        : !read_float(root, "divider", 0, 1, &s->divider)          ? "divider"
                        : !read_hidden(root, s)                                    ? "hidden"
                        : !read_materials(root, s)                                 ? "materials"
                        : !read_lights(root, s)                                    ? "lights"
                                                                                   : NULL;
    if (!wrong && (long)s->width * s->height > IMAGE_PIXELS_MAX)
        wrong = "width";
    s->split = (gpu_split)split;
    if (!wrong)
        return true;
    memset(s, 0, view_settings_size(s));
    return base_fail(error, subject, "has settings with invalid \"%s\"", wrong);
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
    if (s->environment[0] && environment_is_file(s->environment) &&
        !check_name(shot, "environment", s->environment, strlen(s->environment), error))
        return false;
    for (int i = 0; i < s->material_count; i++) {
        size_t length;
        const char *const file = material_file_named(strchr(s->materials[i], '=') + 1, &length);
        if (file && !is_replaced(options->materials, s->materials[i]) &&
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
