/* SPDX-License-Identifier: MIT */
/* cache.h - imported scenes stored as files, found by the content of all files they were made
 * from. */
#ifndef LAMPION_SCENE_LOAD_CACHE_H
#define LAMPION_SCENE_LOAD_CACHE_H

#include "app/base/file_hash.h"
#include "app/scene/sources.h"

/* Returns the key of a scene file: its content and path, the importer's version, and what is asked
 * of it: the up axis, the variant of materials, and how many lights a mesh may become. */
file_hash cache_key(const char *folder, const char *name, const void *data, size_t size,
                    const scene_options *options);

/* Maps the cached blob if it exists, is valid, and every file it was made from is unchanged. */
bool cache_load(const file_hash *key, source_set *sources, void **block, size_t *size);

/* Stores a blob; does nothing where that is impossible. */
void cache_store(const file_hash *key, const void *block, size_t size);

#endif
