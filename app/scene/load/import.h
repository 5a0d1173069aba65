/* SPDX-License-Identifier: MIT */
/* import.h - import of scene files: parsed by a sandboxed child process, cached by content.
 * find_reader of import.c tells formats apart. */
#ifndef LAMPION_SCENE_LOAD_IMPORT_H
#define LAMPION_SCENE_LOAD_IMPORT_H

#include "app/scene/scene.h"

bool import_scene(const char *path, const scene_options *options, scene *scene, base_error *error);

#endif
