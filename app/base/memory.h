/* SPDX-License-Identifier: MIT */
/* memory.h - large arrays. */
#ifndef LAMPION_BASE_MEMORY_H
#define LAMPION_BASE_MEMORY_H

#include <stddef.h>

/* Allocates like malloc; release with free. A block of many megabytes is placed on huge pages if
 * the system has them: arrays with values per pixel are written side by side, each on pages of its
 * own, and the first touch of a 4 KB page costs as much as writing it many times. */
void *memory_large(size_t size);

/* Resizes like realloc; where a block of many megabytes grows, it grows on huge pages. */
void *memory_large_resize(void *memory, size_t size);

#endif
