/* SPDX-License-Identifier: MIT */
/* sequence.h - the files of an image sequence. */
#ifndef LAMPION_IMAGE_SEQUENCE_H
#define LAMPION_IMAGE_SEQUENCE_H

#include <stdbool.h>
#include <stddef.h>

/* Whether the pattern says where the number goes. */
bool image_sequence_has_number(const char *pattern);

/* The file of image `index`: the number takes the place of %d or %0Nd in the pattern, or goes
 * before its extension with four digits. */
void image_sequence_name(const char *pattern, int index, char *path, size_t size);

#endif
