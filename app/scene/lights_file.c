/* SPDX-License-Identifier: MIT */
/* lights_file.c - lights from JSON (docs/lights.md). */
#include "app/file/file.h"
#include "app/scene/scene.h"

#include <cjson/cJSON.h>

#define FILE_LIMIT ((size_t)16 << 20)

bool scene_add_lights_file(scene *s, const char *path, cli_error *error) {
    cJSON *root = file_read_json(path, FILE_LIMIT, error);
    if (!root)
        return false;
    const cJSON *list = file_json_list(path, root, "lights", error), *entry;
    const size_t given = (size_t)cJSON_GetArraySize(list), room = SCENE_LIGHTS_MAX - s->light_count;
    bool ok = list;
    if (ok && given > room)
        ok = cli_fail(error, path, "makes %zu lights (at most %d)", given + s->light_count,
                      SCENE_LIGHTS_MAX);
    size_t count = s->light_count;
    cJSON_ArrayForEach(entry, list) {
        scene_light_error wrong;
        if (ok && !scene_light_from_json(entry, &s->lights[count], &wrong))
            ok = cli_fail(error, path, "lights[%zu]%s", count - s->light_count, wrong.text);
        count++;
    }
    if (ok)
        s->light_count = count;
    cJSON_Delete(root);
    return ok;
}
