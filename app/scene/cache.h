/* SPDX-License-Identifier: MIT */
/* cache.h - imported scenes kept as files, found again by the content of all they were made from.
 */
#ifndef LAMPION_SCENE_CACHE_H
#define LAMPION_SCENE_CACHE_H

#include "app/scene/sources.h"

/* The key of a scene file: its content and path, how it stands, which variant of its materials it
 * shows (or NULL), and the version of the importer. */
file_hash cache_key(const char *folder, const char *name, const void *data, size_t size, int up,
                    const char *variant);

/* Maps the cached blob if it is there, valid, and every file it was made from is unchanged. */
bool cache_load(const file_hash *key, source_set *sources, void **block, size_t *size);

/* Stores a blob; without effect where that is impossible. */
void cache_store(const file_hash *key, const void *block, size_t size);

#endif
