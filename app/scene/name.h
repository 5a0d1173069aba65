/* SPDX-License-Identifier: MIT */
/* name.h - names of a scene's parts: whole UTF-8 characters, no control characters. */
#ifndef LAMPION_SCENE_NAME_H
#define LAMPION_SCENE_NAME_H

#include "app/base/error.h"

#define SCENE_NAME_SIZE 64 /* bytes of a name, NUL included, valid UTF-8 */

/* Copies a name, truncated to whole characters; bytes that are not UTF-8 and control characters
 * become '?'. */
void scene_clean_name(char name[SCENE_NAME_SIZE], const char *text);

/* Finds the one of `count` things that `wanted` gives by name or by number from 0, or fails with an
 * error that lists all. `first` is the name of the first thing; names are `stride` bytes apart. */
bool scene_find_name(const char *subject, const char *kind, const char *wanted, const char *first,
                     size_t stride, size_t count, size_t *index, base_error *error);

#endif
