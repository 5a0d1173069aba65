/* SPDX-License-Identifier: MIT */
#include "app/scene/cache.h"

#include <string.h>

file_hash cache_key(const char *folder, const char *name, const void *data, size_t size) {
    file_hash key = { BLOB_VERSION, 0 };
    file_hash_add(&key, folder, strlen(folder));
    file_hash_add(&key, name, strlen(name));
    file_hash_add(&key, data, size);
    return key;
}

typedef char entry_name[64];

static const char *name_of(const file_hash *key, entry_name name) {
    char text[33];
    file_hash_text(key, text);
    snprintf(name, sizeof(entry_name), "scene-%s", text);
    return name;
}

static bool sources_unchanged(const void *block, source_set *sources) {
    const blob_source *items = blob_items(block, BLOB_SOURCES);
    const blob_header *header = block;
    for (uint64_t i = 0; i < header->sections[BLOB_SOURCES].count; i++) {
        const source *found;
        cli_error ignored;
        file_hash hash = { 0 };
        if (!sources_read(sources, items[i].path, &found, &ignored) || found->size != items[i].size)
            return false;
        file_hash_add(&hash, found->data, found->size);
        if (hash.low != items[i].hash.low || hash.high != items[i].hash.high)
            return false;
    }
    return true;
}

bool cache_load(const file_hash *key, source_set *sources, void **block, size_t *size) {
    entry_name name;
    cli_error ignored;
    const void *const data = file_cache_map(name_of(key, name), size);
    if (!data)
        return false;
    *block = (void *)(uintptr_t)data;
    if (blob_validate(data, *size, false, name, &ignored) && sources_unchanged(data, sources))
        return true;
    file_cache_unmap(data, *size);
    return false;
}

void cache_store(const file_hash *key, const void *block, size_t size) {
    entry_name name;
    file_cache_store(name_of(key, name), block, size);
}
