/* SPDX-License-Identifier: MIT */
#include "app/scene/cache.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

file_hash cache_key(const char *folder, const char *name, const void *data, size_t size) {
    file_hash key = { BLOB_VERSION, 0 };
    file_hash_add(&key, folder, strlen(folder));
    file_hash_add(&key, name, strlen(name));
    file_hash_add(&key, data, size);
    return key;
}

static bool cache_path(const file_hash *key, char *path, size_t size) {
    char text[33], name[64];
    file_hash_text(key, text);
    snprintf(name, sizeof name, "scene-%s", text);
    return file_cache_path(name, path, size);
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
    char path[4096];
    struct stat status;
    if (!cache_path(key, path, sizeof path))
        return false;
    const int fd = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    if (fd < 0)
        return false;
    *block = MAP_FAILED;
    if (fstat(fd, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0) {
        *size = (size_t)status.st_size;
        *block = mmap(NULL, *size, PROT_READ, MAP_PRIVATE, fd, 0);
    }
    close(fd);
    if (*block == MAP_FAILED)
        return false;
    cli_error ignored;
    if (blob_validate(*block, *size, true, path, &ignored) && sources_unchanged(*block, sources))
        return true;
    munmap(*block, *size);
    return false;
}

void cache_store(const file_hash *key, const void *block, size_t size) {
    char path[4096];
    if (cache_path(key, path, sizeof path))
        file_cache_store(path, block, size);
}
