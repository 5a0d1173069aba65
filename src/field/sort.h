/* SPDX-License-Identifier: MIT */
/* sort.h - sorts surfaces by what they read, so that neighbors share it. */
#ifndef LAMPION_FIELD_SORT_H
#define LAMPION_FIELD_SORT_H

#include <stddef.h>
#include <stdint.h>

/* Surfaces that are sorted together. */
enum { FIELD_SORTED = 1024 };

/* Sorts indices below FIELD_SORTED by their keys, stably. */
void lmpi_field_sort(const uint32_t *keys, size_t count, uint16_t *order);

#endif
