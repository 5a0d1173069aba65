/* SPDX-License-Identifier: MIT */
/* sequence.h - the files of an image sequence. */
#ifndef LAMPION_IMAGE_SEQUENCE_H
#define LAMPION_IMAGE_SEQUENCE_H

#include <stdbool.h>
#include <stddef.h>

/* Whether the pattern has a place for the number. */
bool image_sequence_has_number(const char *pattern);

/* Names the file of image `index`: the number replaces %d or %0Nd in the pattern, or is inserted
 * before its extension with four digits. */
void image_sequence_name(const char *pattern, int index, char *path, size_t size);

#endif
