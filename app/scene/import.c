/* SPDX-License-Identifier: MIT */
#include "app/scene/import.h"
bool import_scene(const char *path, bool no_cache, scene *s, cli_error *error) {
    (void)no_cache;
    (void)s;
    return cli_fail(error, path, "scene files cannot be read yet");
}
bool scene_add_lights_file(scene *s, const char *path, cli_error *error) {
    (void)s;
    return cli_fail(error, path, "lights files cannot be read yet");
}
