/* SPDX-License-Identifier: MIT */
/* name.h - names of a scene's parts as they are kept: whole UTF-8, no control characters. */
#ifndef LAMPION_SCENE_NAME_H
#define LAMPION_SCENE_NAME_H

#include "app/cli/cli.h"

#define SCENE_NAME_SIZE 64 /* bytes of a name, NUL included, valid UTF-8 */

/* Copies a name truncated to whole characters; what is not UTF-8 or is a control character becomes
 * '?'. */
void scene_clean_name(char name[SCENE_NAME_SIZE], const char *text);

/* Finds the one of `count` things of a kind, the first named `first`, each `stride` bytes after the
 * one before, that is wanted by its name or its number from 0; else an error that lists all. */
bool scene_find_name(const char *subject, const char *kind, const char *wanted, const char *first,
                     size_t stride, size_t count, size_t *index, cli_error *error);

#endif
