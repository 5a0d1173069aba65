/* SPDX-License-Identifier: MIT */
/* text.h - text files in the encoding that their readers expect. */
#ifndef LAMPION_SCENE_LOAD_TEXT_H
#define LAMPION_SCENE_LOAD_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* Converts UTF-16, recognized by its byte-order mark, to UTF-8 in a block from malloc; half a
 * character becomes U+FFFD. Leaves other bytes alone. Returns false if memory ran out. */
bool text_to_utf8(void **data, size_t *size);

/* Removes blanks at the beginning of the contents of XML elements; returns the new size. */
size_t text_trim_xml(char *text, size_t size);

#endif
