/* SPDX-License-Identifier: MIT */
/* text.h - text files as their readers expect them. */
#ifndef LAMPION_SCENE_TEXT_H
#define LAMPION_SCENE_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* Makes UTF-8 of UTF-16, which a mark of its first two bytes tells, in a block from malloc; what
 * is half a character becomes U+FFFD. Other bytes stay. False without memory. */
bool text_to_utf8(void **data, size_t *size);

/* Removes the blanks at the beginning of what elements of XML contain; returns the size. */
size_t text_trim_xml(char *text, size_t size);

#endif
