/* SPDX-License-Identifier: MIT */
/* name.h - names of a scene's parts as they are kept: whole UTF-8, no control characters. */
#ifndef LAMPION_SCENE_NAME_H
#define LAMPION_SCENE_NAME_H

#define SCENE_NAME_SIZE 64 /* bytes of a name, NUL included, valid UTF-8 */

/* Copies a name truncated to whole characters; what is not UTF-8 or is a control character becomes
 * '?'. */
void scene_clean_name(char name[SCENE_NAME_SIZE], const char *text);

#endif
