/* SPDX-License-Identifier: MIT */
/* shot.h - the viewer's screenshots, .png files that hold its settings, lights included, as
 * JSON. */
#ifndef LAMPION_SCENE_SHOT_H
#define LAMPION_SCENE_SHOT_H

#include "app/base/file_json.h"

#define SHOT_KEY "lampion" /* of the settings among a .png's texts */

/* Whether a path ends as a screenshot's. */
bool shot_has_name(const char *path);

/* Reads the settings, in a sandbox; returns NULL on failure. Free with json_decref. */
json_t *shot_read(const char *path, base_error *error);

#endif
