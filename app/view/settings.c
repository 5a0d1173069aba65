/* SPDX-License-Identifier: MIT */
#include "app/view/settings.h"
#include "app/file/file.h"
#include "app/image/image.h"
#include "app/material/material.h"
#include "app/scene/vector.h"
#include "app/scene/world.h"

#include <cjson/cJSON.h>
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

/* Told where it is not 0: what is in the world then becomes the same again to the bit. */
static void add_origin(cJSON *root, const double origin[3]) {
    if (scene_origin_is_0(origin))
        return;
    cJSON *array = cJSON_AddArrayToObject(root, "origin");
    for (int k = 0; k < 3; k++) {
        char text[32];
        snprintf(text, sizeof text, "%.17g", origin[k]);
        cJSON_AddItemToArray(array, cJSON_CreateRaw(text));
    }
}

static void add_camera(cJSON *root, const view_settings *s) {
    const scene_camera *camera = &s->camera;
    cJSON *object = cJSON_AddObjectToObject(root, "camera");
    scene_add_world(object, "eye", s->origin, camera->eye);
    scene_add_world(object, "target", s->origin, camera->target);
    file_json_add_floats(object, "up", camera->up, 3);
    file_json_add_floats(object, "fov", &camera->fov, 1);
    if (camera->height > 0)
        file_json_add_floats(object, "height", &camera->height, 1);
}

static void add_shading(cJSON *array, const view_shading *shading) {
    cJSON *object = cJSON_CreateObject();
    cJSON_AddStringToObject(object, "method", method_table[shading->method].name);
    cJSON_AddNumberToObject(object, "bands", shading->bands);
    cJSON_AddStringToObject(object, "window", lmp_sh_window_name(shading->window));
    cJSON_AddItemToArray(array, object);
}

cJSON *view_settings_to_json(const view_settings *s) {
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "scene", s->scene);
    if (s->up != SCENE_UP_Y)
        cJSON_AddStringToObject(root, "up", scene_up_names[s->up]);
    if (s->variant[0])
        cJSON_AddStringToObject(root, "variant", s->variant);
    cJSON_AddNumberToObject(root, "width", s->width);
    cJSON_AddNumberToObject(root, "height", s->height);
    cJSON_AddNumberToObject(root, "samples", s->samples);
    cJSON_AddBoolToObject(root, "shadows", s->shadows);
    cJSON_AddStringToObject(root, "ground", environment_ground_names[s->ground]);
    file_json_add_floats(root, "exposure", &s->exposure, 1);
    cJSON_AddStringToObject(root, "tone", image_tones[s->tone].name);
    file_json_add_floats(root, "background", s->background, 3);
    cJSON *around = cJSON_AddObjectToObject(root, "environment");
    cJSON_AddStringToObject(around, "name", s->environment);
    file_json_add_floats(around, "rotation", &s->environment_rotation, 1);
    file_json_add_floats(around, "strength", &s->environment_strength, 1);
    add_origin(root, s->origin);
    add_camera(root, s);
    cJSON *both = cJSON_AddArrayToObject(root, "looks");
    add_shading(both, &s->shading[0]);
    add_shading(both, &s->shading[1]);
    cJSON_AddStringToObject(root, "split", view_split_names[s->split]);
    file_json_add_floats(root, "divider", &s->divider, 1);
    cJSON *materials = cJSON_AddArrayToObject(root, "materials");
    for (int i = 0; i < s->material_count; i++)
        cJSON_AddItemToArray(materials, cJSON_CreateString(s->materials[i]));
    cJSON *lights = cJSON_AddArrayToObject(root, "lights");
    for (size_t i = 0; i < s->light_count; i++)
        cJSON_AddItemToArray(lights, scene_light_to_json(&s->lights[i], s->origin));
    return root;
}

/* --- from JSON -------------------------------------------------------------------------------- */

static bool read_int(const cJSON *object, const char *name, int minimum, int maximum, int *value) {
    double number;
    if (!file_json_number(file_json_member(object, name), minimum, maximum, &number) ||
        number != floor(number))
        return false;
    *value = (int)number;
    return true;
}

static bool read_float(const cJSON *object, const char *name, double minimum, double maximum,
                       float *value) {
    double number;
    /* limits in float, so that the nearest float of a limit is taken again */
    if (!file_json_number(file_json_member(object, name), (double)(float)minimum,
                          (double)(float)maximum, &number))
        return false;
    *value = (float)number;
    return true;
}

static bool read_floats(const cJSON *object, const char *name, double minimum, double maximum,
                        float value[3]) {
    double numbers[3];
    if (!file_json_numbers(file_json_member(object, name), 3, minimum, (double)(float)maximum,
                           numbers))
        return false;
    for (int i = 0; i < 3; i++)
        value[i] = (float)numbers[i];
    return true;
}

static bool read_choice(const cJSON *object, const char *name, const char *const *choices,
                        int *value) {
    const cJSON *item = file_json_member(object, name);
    for (int i = 0; cJSON_IsString(item) && choices[i]; i++)
        if (strcmp(choices[i], item->valuestring) == 0) {
            *value = i;
            return true;
        }
    return false;
}

/* Absent where the scene is as its file has it. */
static bool read_up(const cJSON *root, int *up) {
    *up = SCENE_UP_Y;
    return !file_json_member(root, "up") || read_choice(root, "up", scene_up_names, up);
}

/* Absent where the scene has the materials of its file. */
static bool read_variant(const cJSON *root, char variant[SCENE_NAME_SIZE]) {
    const cJSON *item = file_json_member(root, "variant");
    if (item && (!cJSON_IsString(item) || strlen(item->valuestring) >= SCENE_NAME_SIZE))
        return false;
    strcpy(variant, item ? item->valuestring : "");
    return true;
}

/* Absent from the screenshots of before there was a choice. */
static bool read_tone(const cJSON *root, int *tone) {
    *tone = 0;
    return !file_json_member(root, "tone") || read_choice(root, "tone", image_tone_names(), tone);
}

/* Screenshots of before there were shadows have none. */
static bool read_shadows(const cJSON *root, bool *shadows) {
    const cJSON *item = file_json_member(root, "shadows");
    *shadows = cJSON_IsTrue(item);
    return !item || cJSON_IsBool(item);
}

/* Nor had those of before there was ground. */
static bool read_ground(const cJSON *root, int *ground) {
    *ground = ENVIRONMENT_GROUND_OFF;
    return !file_json_member(root, "ground") ||
           read_choice(root, "ground", environment_ground_names, ground);
}

/* Absent where it is 0. */
static bool read_origin(const cJSON *root, double origin[3]) {
    const double far = (double)LMP_LENGTH_MAX;
    const cJSON *item = file_json_member(root, "origin");
    if (item && !file_json_numbers(item, 3, -far, far, origin))
        return false;
    for (int k = 0; k < 3; k++)
        origin[k] += 0.0; /* no -0 */
    return true;
}

static bool read_camera(const cJSON *root, const double origin[3], scene_camera *camera) {
    const double far = (double)LMP_LENGTH_MAX;
    const cJSON *object = file_json_member(root, "camera");
    return scene_read_world(file_json_member(object, "eye"), origin, camera->eye) &&
           scene_read_world(file_json_member(object, "target"), origin, camera->target) &&
           read_floats(object, "up", -far, far, camera->up) &&
           read_float(object, "fov", 0.001, 3.1, &camera->fov) &&
           (!file_json_member(object, "height") ||
            read_float(object, "height", 1e-6, far, &camera->height));
}

static bool read_shading(const cJSON *object, view_shading *shading) {
    int method, window;
    if (!read_choice(object, "method", method_names(), &method) ||
        !read_choice(object, "window", method_window_names(), &window))
        return false;
    shading->method = (method_kind)method;
    shading->window = (lmp_window)window;
    return read_int(object, "bands", 1, method_table[shading->method].bands_max[DEVICE_AUTO],
                    &shading->bands);
}

static bool read_both_shadings(const cJSON *root, view_shading both[2]) {
    const cJSON *array = file_json_member(root, "looks");
    return cJSON_IsArray(array) && cJSON_GetArraySize(array) == 2 &&
           read_shading(cJSON_GetArrayItem(array, 0), &both[0]) &&
           read_shading(cJSON_GetArrayItem(array, 1), &both[1]);
}

static bool read_lights(const cJSON *root, view_settings *s) {
    const cJSON *array = file_json_member(root, "lights"), *item;
    scene_light_error wrong;
    if (!cJSON_IsArray(array) || cJSON_GetArraySize(array) > SCENE_LIGHTS_MAX)
        return false;
    cJSON_ArrayForEach(item, array) {
        if (!scene_light_from_json(item, s->origin, &s->lights[s->light_count++], &wrong))
            return false;
    }
    return true;
}

static bool read_materials(const cJSON *root, view_settings *s) {
    const cJSON *array = file_json_member(root, "materials"), *item;
    if (!cJSON_IsArray(array) || cJSON_GetArraySize(array) > RENDER_TABLES_MAX)
        return false;
    cJSON_ArrayForEach(item, array) {
        const char *text = cJSON_IsString(item) ? item->valuestring : "";
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

static bool read_path(const cJSON *object, const char *member, char name[VIEW_PATH_SIZE]) {
    const cJSON *item = file_json_member(object, member);
    if (!cJSON_IsString(item) || strlen(item->valuestring) >= VIEW_PATH_SIZE ||
        file_is_standard_input(item->valuestring))
        return false;
    strcpy(name, item->valuestring);
    return true;
}

/* Screenshots of before there were environments have none. */
static bool read_environment(const cJSON *root, view_settings *s) {
    const cJSON *object = file_json_member(root, "environment");
    if (!object)
        strcpy(s->environment, "none");
    return !object ||
           (read_path(object, "name", s->environment) &&
            read_float(object, "rotation", -360, 360, &s->environment_rotation) &&
            read_float(object, "strength", 0, ENVIRONMENT_STRENGTH_MAX, &s->environment_strength));
}

bool view_settings_from_json(const cJSON *root, const char *subject, view_settings *s,
                             cli_error *error) {
    memset(s, 0, sizeof *s);
    int split = 0;
    const char *wrong = !cJSON_IsObject(root)                                          ? "settings"
                        : !read_path(root, "scene", s->scene)                          ? "scene"
                        : !read_up(root, &s->up)                                       ? "up"
                        : !read_variant(root, s->variant)                              ? "variant"
                        : !read_int(root, "width", 1, IMAGE_SIZE_MAX, &s->width)       ? "width"
                        : !read_int(root, "height", 1, IMAGE_SIZE_MAX, &s->height)     ? "height"
                        : !read_int(root, "samples", 1, VIEW_SAMPLES_MAX, &s->samples) ? "samples"
                        : !read_shadows(root, &s->shadows)                             ? "shadows"
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
                        : !read_materials(root, s)                                 ? "materials"
                        : !read_lights(root, s)                                    ? "lights"
                                                                                   : NULL;
    if (!wrong && (long)s->width * s->height > IMAGE_PIXELS_MAX)
        wrong = "width";
    s->split = (gpu_split)split;
    if (!wrong)
        return true;
    memset(s, 0, sizeof *s);
    return cli_fail(error, subject, "has settings whose %s make no sense", wrong);
}

/* --- screenshots ------------------------------------------------------------------------------ */

bool view_write_shot(const view_settings *s, const unsigned char *rgb8, const char *path,
                     cli_error *error) {
    char *text = file_json_text(view_settings_to_json(s), false, path, error);
    if (!text)
        return false;
    const image_text chunk = { IMAGE_SETTINGS_KEY, text };
    const bool ok = image_write_png8_text(rgb8, s->width, s->height, &chunk, path, error);
    free(text);
    return ok;
}

/* A name of so many bytes that a screenshot has for a part of what it shows. */
static bool check_name(const char *shot, const char *part, const char *name, size_t length,
                       cli_error *error) {
    char path[VIEW_MATERIAL_SIZE];
    snprintf(path, sizeof path, "%.*s", (int)length, name);
    return file_confine(path, shot) ||
           cli_fail(error, shot,
                    "names the %s \"%.300s\", which is outside its folder (see --allow-paths)",
                    part, path);
}

/* Whether the material of a text NAME=MATERIAL is replaced by one of the list. */
static bool is_replaced(const cli_list *list, const char *text) {
    const size_t length = strcspn(text, "=") + 1;
    for (int i = 0; list && i < list->count; i++)
        if (strncmp(list->items[i], text, length) == 0)
            return true;
    return false;
}

/* Whoever made a screenshot is a stranger, and may name what is no business of theirs: a private
 * file, or one whose mere opening does something. Each setting that is a name of a file is here. */
static bool check_names(const view_settings *s, const char *shot, const view_shot_options *options,
                        cli_error *error) {
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

bool view_read_shot(const char *path, const view_shot_options *options, view_settings *s,
                    cli_error *error) {
    memset(s, 0, sizeof *s);
    char *text = NULL;
    if (!image_read_png_text(path, IMAGE_SETTINGS_KEY, &text, error))
        return false;
    cJSON *root = file_parse_json(path, text, strlen(text), error);
    free(text);
    const bool ok = root && view_settings_from_json(root, path, s, error);
    cJSON_Delete(root);
    if (ok && (long)s->width * s->height > options->pixels_max)
        return cli_fail(error, path, "asks for %d x %d pixels (at most %d; see --max-pixels)",
                        s->width, s->height, options->pixels_max);
    return ok && check_names(s, path, options, error);
}
