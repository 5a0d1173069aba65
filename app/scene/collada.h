/* SPDX-License-Identifier: MIT */
/* collada.h - what Assimp does not check of COLLADA. */
#ifndef LAMPION_SCENE_COLLADA_H
#define LAMPION_SCENE_COLLADA_H

#include "app/cli/cli.h"

/* Whether every accessor stays within its array: Assimp reads beyond, and gives what lies there. */
bool collada_check(const char *text, size_t size, const char *subject, cli_error *error);

#endif
