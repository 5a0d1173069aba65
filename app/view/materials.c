/* SPDX-License-Identifier: MIT */
#include "app/view/materials.h"
#include "app/base/cli.h"

#include <stdlib.h>
#include <string.h>

static bool is_preintegrated(const view_shading *shading) {
    return method_table[shading->method].reads & METHOD_READS_PREINTEGRATED;
}

bool view_materials_match(const view_materials *m, const scene *world,
                          const view_settings *settings, const view_shading *shading) {
    return m->count == settings->material_count &&
           (!override_is_needed(m->count, world) ||
            (m->bands == shading->bands && m->window == shading->window &&
             m->preintegrated == is_preintegrated(shading) &&
             memcmp(m->names, settings->materials, (size_t)m->count * sizeof *m->names) == 0));
}

/* Opens the materials of the settings. Free with override_free, on failure as well. */
static bool open(const scene *world, const view_settings *settings, override_set *set,
                 base_error *error) {
    cli_list list = { .count = settings->material_count };
    for (int i = 0; i < list.count; i++)
        list.items[i] = settings->materials[i];
    return override_open(&list, world, set, error);
}

bool view_materials_fit(const scene *world, const view_settings *settings,
                        const view_shading *shading, const any_renderer *renderer,
                        base_error *error) {
    override_set set;
    const bool ok = open(world, settings, &set, error) &&
                    override_fits(&set, shading->bands, shading->method, renderer, error);
    override_free(&set);
    return ok;
}

bool view_materials_make(const scene *world, const view_settings *settings,
                         const view_shading *shading, view_materials *fresh, base_error *error) {
    *fresh = (view_materials) { .count = settings->material_count,
                                .bands = shading->bands,
                                .window = shading->window,
                                .preintegrated = is_preintegrated(shading),
                                .names = calloc(RENDER_TABLES_MAX, sizeof *fresh->names) };
    if (!fresh->names)
        return base_fail(error, NULL, "out of memory");
    memcpy(fresh->names, settings->materials, (size_t)fresh->count * sizeof *fresh->names);
    override_set *made = &fresh->made;
    const bool ok = open(world, settings, made, error) &&
                    override_bake(made, shading->bands, shading->window, error) &&
                    override_bake_sheen(made, world, shading->bands, shading->window, error) &&
                    (!fresh->preintegrated || override_preintegrate(made, error));
    if (!ok)
        view_materials_free(fresh);
    return ok;
}

void view_materials_free(view_materials *m) {
    override_free(&m->made);
    free(m->names);
    *m = (view_materials) { .count = 0 };
}
