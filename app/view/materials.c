/* SPDX-License-Identifier: MIT */
#include "app/view/materials.h"
#include "app/base/cli.h"

#include <string.h>

bool view_materials_match(const view_materials *m, const scene *world,
                          const view_settings *settings, const view_shading *shading) {
    const view_shading *own = &m->shading;
    return m->of.count == settings->materials.count &&
           (!override_is_needed(m->of.count, world) ||
            (own->bands == shading->bands && own->window == shading->window &&
             view_is_preintegrated(own) == view_is_preintegrated(shading) &&
             memcmp(&m->of, &settings->materials, sizeof m->of) == 0));
}

/* Opens the materials of the settings. Free with override_free, on failure as well. */
static bool open(const scene *world, const view_settings *settings, override_set *set,
                 base_error *error) {
    cli_list list = { .count = settings->materials.count };
    for (int i = 0; i < list.count; i++)
        list.items[i] = settings->materials.texts[i];
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
    *fresh = (view_materials) { .of = settings->materials, .shading = *shading };
    override_set *made = &fresh->made;
    const bool ok = open(world, settings, made, error) &&
                    override_bake(made, shading->bands, shading->window, error) &&
                    override_bake_sheen(made, world, shading->bands, shading->window, error) &&
                    (!view_is_preintegrated(shading) || override_preintegrate(made, error));
    if (!ok)
        view_materials_free(fresh);
    return ok;
}

void view_materials_free(view_materials *m) {
    override_free(&m->made);
    memset(m, 0, sizeof *m);
}
