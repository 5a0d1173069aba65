/* SPDX-License-Identifier: MIT */
#include "app/bake/bake.h"

#include <omp.h>
#include <stdio.h>

typedef char entry_name[64];

void bake_parallel(void *user, size_t count, void (*task)(size_t index, void *data), void *data) {
    (void)user;
    const long tasks = (long)count;
#pragma omp parallel for schedule(dynamic)
    for (long i = 0; i < tasks; i++)
        task((size_t)i, data);
}

void bake_progress(void *user, double done) {
    if (omp_get_thread_num() == 0)
        cli_progress((const char *)user, done);
}

void bake_add_settings(file_hash *key, const void *settings, size_t size) {
    const uint32_t maker[] = { lmp_version(), BAKE_EPOCH };
    file_hash_add(key, maker, sizeof maker);
    file_hash_add(key, settings, size);
}

/* The entry of a recipe in the cache. */
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
    const lmp_result result = recipe->make(recipe->user, object);
    cli_progress_end();
    if (result == LMP_OK)
        file_cache_store_object(name, recipe->size(*object), recipe->write, *object);
    return result;
}
