/* SPDX-License-Identifier: MIT */
/* lights_file.c - lights from JSON (docs/lights.md), alone or among the settings of the viewer. */
#include "app/file/file.h"
#include "app/image/image.h"
#include "app/scene/scene.h"

#include <cjson/cJSON.h>
#include <stdlib.h>
#include <string.h>

#define FILE_LIMIT ((size_t)16 << 20)

static cJSON *read_root(const char *path, cli_error *error) {
    char *text = NULL;
    if (image_format_of(path) != IMAGE_PNG)
        return file_read_json(path, FILE_LIMIT, error);
    if (!image_read_png_text(path, IMAGE_SETTINGS_KEY, &text, error))
        return NULL;
    cJSON *root = file_parse_json(path, text, strlen(text), error);
    free(text);
    return root;
}

/* Settings name their scene. */
static const cJSON *find_list(const char *path, const cJSON *root, cli_error *error) {
    const cJSON *const list = file_json_member(root, "lights");
    return file_json_member(root, "scene") && cJSON_IsArray(list)
               ? list
               : file_json_list(path, root, "lights", error);
}

bool scene_read_lights(const char *path, const double origin[3], size_t room, scene_light *lights,
                       size_t *count, cli_error *error) {
    cJSON *root = read_root(path, error);
    if (!root)
        return false;
    const cJSON *list = find_list(path, root, error), *entry;
    const size_t given = (size_t)cJSON_GetArraySize(list);
    bool ok = list;
    if (ok && given > room)
        ok = cli_fail(error, path, "makes %zu lights (at most %d)", given + SCENE_LIGHTS_MAX - room,
                      SCENE_LIGHTS_MAX);
    *count = 0;
    cJSON_ArrayForEach(entry, list) {
        scene_light_error wrong;
        if (ok && !scene_light_from_json(entry, origin, &lights[*count], &wrong))
            ok = cli_fail(error, path, "lights[%zu]%s", *count, wrong.text);
        ++*count;
    }
    cJSON_Delete(root);
    return ok;
}

bool scene_add_lights_file(scene *s, const char *path, cli_error *error) {
    size_t count;
    if (!scene_read_lights(path, s->origin, SCENE_LIGHTS_MAX - s->light_count,
                           s->lights + s->light_count, &count, error))
        return false;
    s->light_count += count;
    return true;
}

bool scene_write_lights(const char *path, const double origin[3], const scene_light *lights,
                        size_t count, cli_error *error) {
    cJSON *root = cJSON_CreateObject();
    cJSON *list = cJSON_AddArrayToObject(root, "lights");
    for (size_t i = 0; i < count; i++)
        cJSON_AddItemToArray(list, scene_light_to_json(&lights[i], origin));
    char *text = file_json_text(root, true, path, error);
    const bool ok = text && file_write_whole(path, text, strlen(text), error);
    free(text);
    return ok;
}
