/* SPDX-License-Identifier: MIT */
/* Entries of the cache: files with arbitrary bytes, which are rejected, and scenes stored with
 * arbitrary bytes, which are validated. The first byte tells which. */
#include "app/scene/load/cache.h"
#include "app/base/file_cache.h"
#include "app/base/file_hash.h"
#include "fuzz/file.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static const file_hash key = { 1, 2 };

static char folder[64];

static void remove_folder(void) {
    file_cache_clear();
    char path[128];
    snprintf(path, sizeof path, "%s/lampion/entry", folder);
    unlink(path);
    path[strlen(path) - strlen("/entry")] = '\0';
    rmdir(path);
    rmdir(folder);
}

static void open_folder(void) {
    if (folder[0])
        return;
    snprintf(folder, sizeof folder, "/dev/shm/lampion-fuzz-cache-%ld", (long)getpid());
    mkdir(folder, 0700);
    setenv("XDG_CACHE_HOME", folder, 1);
    atexit(remove_folder);
}

static void expect_no_entry(const uint8_t *data, size_t size) {
    char path[3072 + 16];
    size_t found;
    if (!file_cache_directory(path, 3072))
        abort();
    strcat(path, "/entry");
    FILE *const stream = fopen(path, "wb");
    if (!stream || fwrite(data, 1, size, stream) != size || fclose(stream) != 0)
        abort();
    const void *const bytes = file_cache_map("entry", &found);
    if (bytes && found >= size)
        abort();
    file_cache_unmap(bytes, found);
}

static void load_stored(const uint8_t *data, size_t size) {
    source_set sources = { .subject = "input", .folder = "/nonexistent" };
    void *block;
    size_t found;
    cache_store(&key, data, size);
    if (cache_load(&key, &sources, &block, &found)) {
        if (found != size || memcmp(block, data, size) != 0)
            abort();
        file_cache_unmap(block, found);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    open_folder();
    if (size > 1 && data[0] % 4 == 0)
        expect_no_entry(data + 1, size - 1);
    else if (size > 1)
        load_stored(data + 1, size - 1);
    return 0;
}
