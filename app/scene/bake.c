/* SPDX-License-Identifier: MIT */
#include "app/scene/bake.h"
#include "app/base/file_cache.h"
#include "app/base/parallel.h"
#include "app/base/progress.h"

#include <stdio.h>

typedef char entry_name[64];

static void show_progress(double done, void *user) {
    const char *const *what = user;
    progress_show(*what, done);
}

lmp_host bake_host(const char **what) {
    lmp_host host = parallel_host();
    host.progress = show_progress;
    host.user = what;
    return host;
}

void bake_add_settings(file_hash *key, const void *settings, size_t size) {
    const uint32_t maker[] = { lmp_version(), BAKE_EPOCH };
    file_hash_add(key, maker, sizeof maker);
    file_hash_add(key, settings, size);
}

/* Names the cache entry of a recipe. */
static void name_entry(const bake_recipe *recipe, entry_name name) {
    char text[33];
    file_hash_text(&recipe->key, text);
    snprintf(name, sizeof(entry_name), "%s.%s", text, recipe->kind);
}

static void *read_entry(const bake_recipe *recipe, const char *name) {
    size_t size;
    const void *bytes = file_cache_map(name, &size);
    void *object = bytes ? recipe->read(bytes, size, recipe->user) : NULL;
    file_cache_unmap(bytes, size);
    return object;
}

lmp_result bake(const bake_recipe *recipe, void **object) {
    entry_name name;
    name_entry(recipe, name);
    *object = read_entry(recipe, name);
    if (*object)
        return LMP_OK;
    const char *what = recipe->what;
    const lmp_host host = bake_host(&what);
    const lmp_result result = recipe->make(&host, recipe->user, object);
    progress_end();
    if (result == LMP_OK)
        file_cache_store_object(name, recipe->size(*object), recipe->write, *object);
    return result;
}
