/* SPDX-License-Identifier: MIT */
/* collada.h - checks of COLLADA files that Assimp omits. */
#ifndef LAMPION_SCENE_LOAD_COLLADA_H
#define LAMPION_SCENE_LOAD_COLLADA_H

#include "app/base/error.h"

/* Whether every accessor stays within its array: Assimp would read beyond it and return what lies
 * there. */
bool collada_check(const char *text, size_t size, const char *subject, base_error *error);

#endif
