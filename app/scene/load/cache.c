/* SPDX-License-Identifier: MIT */
#include "app/scene/load/cache.h"
#include "app/base/file.h"
#include "app/base/file_cache.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

file_hash cache_key(const char *folder, const char *name, const void *data, size_t size,
                    const scene_options *options) {
    file_hash key = { BLOB_VERSION, (uint64_t)options->up | (uint64_t)options->mesh_lights << 32 };
    file_hash_add(&key, folder, strlen(folder));
    file_hash_add(&key, name, strlen(name));
    file_hash_add(&key, data, size);
    if (options->variant)
        file_hash_add(&key, options->variant, strlen(options->variant));
    return key;
}

typedef char entry_name[64];

static const char *name_of(const file_hash *key, entry_name name) {
    char text[33];
    file_hash_text(key, text);
    snprintf(name, sizeof(entry_name), "scene-%s", text);
    return name;
}

typedef struct file_identity {
    dev_t device;
    ino_t inode;
} file_identity;

static bool is_same(const blob_source *a, const blob_source *b) {
    return a->size == b->size && a->hash.low == b->hash.low && a->hash.high == b->hash.high;
}

/* Whether an open file still has the content that was read. No more than the old size is read,
 * because the file may have grown beyond memory. */
static bool holds(int fd, const blob_source *item) {
    base_error ignored;
    blob_source found = { .size = 0 };
    void *data;
    size_t size;
    if (!file_read_descriptor(fd, item->path, item->size, &data, &size, &ignored))
        return false;
    found.size = size;
    file_hash_add(&found.hash, data, size);
    free(data);
    return is_same(&found, item);
}

/* Whether a source is unchanged; a file already checked under another name is not read again. */
static bool is_unchanged(source_set *sources, const blob_source *items, size_t i,
                         file_identity *known) {
    struct stat status;
    base_error ignored;
    const int fd = sources_open(sources, items[i].path, &ignored);
    if (items[i].size == BLOB_SOURCE_ABSENT || fd < 0) {
        if (fd >= 0)
            close(fd);
        return items[i].size == BLOB_SOURCE_ABSENT && fd < 0;
    }
    bool ok = fstat(fd, &status) == 0 && (uint64_t)status.st_size == items[i].size, read = false;
    known[i] = (file_identity) { status.st_dev, status.st_ino };
    for (size_t k = 0; ok && !read && k < i; k++)
        read = known[k].device == known[i].device && known[k].inode == known[i].inode &&
               is_same(&items[k], &items[i]);
    ok = ok && (read || holds(fd, &items[i]));
    close(fd);
    return ok;
}

static bool sources_unchanged(const void *block, source_set *sources) {
    const blob_source *items = blob_items(block, BLOB_SOURCES);
    const blob_header *header = block;
    const uint64_t count = header->sections[BLOB_SOURCES].count;
    file_identity *known = calloc(count + 1, sizeof *known);
    bool ok = known;
    for (uint64_t i = 0; ok && i < count; i++)
        ok = is_unchanged(sources, items, i, known);
    free(known);
    return ok;
}

bool cache_load(const file_hash *key, source_set *sources, void **block, size_t *size) {
    entry_name name;
    base_error ignored;
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
