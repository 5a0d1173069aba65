/* SPDX-License-Identifier: MIT */
/* file_hash.h - hashes of contents. */
#ifndef LAMPION_BASE_FILE_HASH_H
#define LAMPION_BASE_FILE_HASH_H

#include <stddef.h>
#include <stdint.h>

/* 128-bit content hash for cache keys and checksums (XXH3, against damage, not against malice);
 * chain calls with the same state. */
typedef struct file_hash {
    uint64_t low, high;
} file_hash;
void file_hash_add(file_hash *hash, const void *data, size_t size);
void file_hash_text(const file_hash *hash, char text[33]);

#endif
