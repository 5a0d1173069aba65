/* SPDX-License-Identifier: MIT */
/* memory.h - large arrays. */
#ifndef LAMPION_MEMORY_H
#define LAMPION_MEMORY_H

#include <stddef.h>

/* As malloc; free() frees it. Of many megabytes in large pages, where the system has them: arrays
 * of values a pixel are written side by side, each on pages of its own, and the first touch of a
 * page of 4 KB costs as much as writing it many times. */
void *memory_large(size_t size);

#endif
