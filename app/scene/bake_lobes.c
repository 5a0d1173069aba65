/* SPDX-License-Identifier: MIT */
#include "app/scene/bake.h"

static void *read_lobes(const void *bytes, size_t size, const void *user) {
    const lmp_preintegrated_lobe_desc *desc = user;
    lmp_preintegrated_lobe *lobes;
    if (lmp_preintegrated_lobe_read(NULL, bytes, size, NULL, &lobes) != LMP_OK)
        return NULL;
    const lmp_preintegrated_lobe_info info = lmp_preintegrated_lobe_describe(lobes);
    if (info.bands == desc->bands && info.window == desc->window)
        return lobes;
    lmp_preintegrated_lobe_destroy(lobes);
    return NULL;
}

static lmp_result make_lobes(const lmp_host *host, const void *user, void **object) {
    lmp_preintegrated_lobe *lobes;
    const lmp_result result = lmp_preintegrated_lobe_create(host, user, &lobes);
    *object = lobes;
    return result;
}

static size_t size_of_lobes(const void *lobes) {
    return lmp_preintegrated_lobe_size(lobes);
}

static void write_lobes(const void *lobes, void *bytes) {
    lmp_preintegrated_lobe_write(lobes, lmp_preintegrated_lobe_size(lobes), bytes);
}

bool bake_lobes(int bands, lmp_window window, lmp_preintegrated_lobe **lobes, base_error *error) {
    const lmp_preintegrated_lobe_desc desc = {
        .bands = bands,
        .window = window,
        .error = BAKE_LOBES_ERROR,
    };
    bake_recipe recipe = { .kind = "lmpr",
                           .what = "integrating lobes",
                           .read = read_lobes,
                           .make = make_lobes,
                           .size = size_of_lobes,
                           .write = write_lobes,
                           .user = &desc };
    const int32_t settings[] = { bands, (int32_t)window };
    bake_add_settings(&recipe.key, settings, sizeof settings);
    void *object;
    const lmp_result result = bake(&recipe, &object);
    *lobes = object;
    return result == LMP_OK ||
           base_fail(error, NULL, "the lobes of %d bands: %s", bands, lmp_result_text(result));
}
