/* SPDX-License-Identifier: MIT */
#include "app/scene/cache.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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

/* One at a time and no more than was read then: a file may have grown beyond memory. */
static bool is_unchanged(const source_set *sources, const blob_source *item) {
    struct stat status;
    cli_error ignored;
    file_hash hash = { 0 };
    void *data = NULL;
    size_t size = 0;
    const int fd = sources_open(sources, item->path, &ignored);
    if (fd < 0)
        return false;
    const bool read = fstat(fd, &status) == 0 && (uint64_t)status.st_size == item->size &&
                      file_read_descriptor(fd, item->path, item->size, &data, &size, &ignored);
    close(fd);
    if (read)
        file_hash_add(&hash, data, size);
    free(data);
    return read && hash.low == item->hash.low && hash.high == item->hash.high;
}

static bool sources_unchanged(const void *block, const source_set *sources) {
    const blob_source *items = blob_items(block, BLOB_SOURCES);
    const blob_header *header = block;
    for (uint64_t i = 0; i < header->sections[BLOB_SOURCES].count; i++)
        if (!is_unchanged(sources, &items[i]))
            return false;
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
