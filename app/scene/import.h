/* SPDX-License-Identifier: MIT */
/* import.h - scene files: parsed by a sandboxed child process, cached by content. */
#ifndef LAMPION_SCENE_IMPORT_H
#define LAMPION_SCENE_IMPORT_H

#include "app/scene/scene.h"

bool import_scene(const char *path, const scene_options *options, scene *scene, cli_error *error);

#endif
