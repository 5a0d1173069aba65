/* SPDX-License-Identifier: MIT */
/* lights_file.c - lights from JSON (docs/lights.md), in a file of their own or in the viewer's
 * settings. */
#include "app/base/file_json.h"
#include "app/base/file_writer.h"
#include "app/scene/scene.h"
#include "app/scene/shot.h"

#include <stdlib.h>
#include <string.h>

#define FILE_LIMIT ((size_t)16 << 20)

static json_t *read_root(const char *path, base_error *error) {
    return shot_has_name(path) ? shot_read(path, error) : file_read_json(path, FILE_LIMIT, error);
}

/* Finds the list of lights; saved settings, which name their scene, have it among other members. */
static json_t *find_list(const char *path, const json_t *root, base_error *error) {
    json_t *const list = json_object_get(root, "lights");
    return json_object_get(root, "scene") && json_is_array(list)
               ? list
               : file_json_list(path, root, "lights", error);
}

bool scene_read_lights(const char *path, const double origin[3], size_t room, scene_light *lights,
                       size_t *count, base_error *error) {
    json_t *root = read_root(path, error);
    if (!root)
        return false;
    json_t *list = find_list(path, root, error), *entry;
    const size_t given = json_array_size(list);
    size_t i;
    bool ok = list;
    if (ok && given > room)
        ok = base_fail(error, path, "makes %zu lights (at most %d)",
                       given + SCENE_LIGHTS_MAX - room, SCENE_LIGHTS_MAX);
    *count = given;
    json_array_foreach (list, i, entry) {
        scene_light_error wrong;
        if (ok && !scene_light_from_json(entry, origin, &lights[i], &wrong))
            ok = base_fail(error, path, "lights[%zu]%s", i, wrong.text);
    }
    json_decref(root);
    return ok;
}

bool scene_add_lights_file(scene *s, const char *path, base_error *error) {
    size_t count;
    if (!scene_read_lights(path, s->origin, SCENE_LIGHTS_MAX - s->light_count,
                           s->lights + s->light_count, &count, error))
        return false;
    s->light_count += count;
    return true;
}

bool scene_write_lights(const char *path, const double origin[3], const scene_light *lights,
                        size_t count, base_error *error) {
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++)
        list = file_json_append(list, scene_light_to_json(&lights[i], origin));
    char *text = file_json_text(json_pack("{s:o}", "lights", list), true, path, error);
    const bool ok = text && file_write_whole(path, text, strlen(text), error);
    free(text);
    return ok;
}
