/* SPDX-License-Identifier: MIT */
#include "app/command/materials.h"

#include <stdlib.h>
#include <string.h>

/* Reports that no material has this name, and names those there are. */
static bool unknown_slot(const scene *world, const char *slot, cli_error *error) {
    char names[600] = "";
    size_t length = 0;
    for (size_t i = 0; i < world->material_count && length < 500; i++)
        length += (size_t)snprintf(names + length, sizeof names - length, "%s%s", i > 0 ? ", " : "",
                                   world->materials[i].name);
    return cli_fail(error, world->origin, "no material \"%s\" (it has: %s)", slot, names);
}

/* Gives the materials named like the slot the table `table`. */
static bool use_table(const scene *world, const char *text, size_t slot_length, int table,
                      int *uses, cli_error *error) {
    char slot[SCENE_NAME_SIZE] = "";
    bool found = false;
    if (slot_length >= sizeof slot)
        return cli_fail(error, text, "no material has so long a name");
    memcpy(slot, text, slot_length);
    for (size_t i = 0; i < world->material_count; i++)
        if (strcmp(world->materials[i].name, slot) == 0) {
            uses[i] = table;
            found = true;
        }
    return found || unknown_slot(world, slot, error);
}

static bool bake(const char *name, int bands, lmp_window window, lmp_brdf_table **table,
                 cli_error *error) {
    const lmp_brdf_table_desc desc = { .bands = bands,
                                       .views = LMP_BRDF_VIEWS_DEFAULT,
                                       .azimuths = LMP_BRDF_AZIMUTHS_DEFAULT,
                                       .window = window };
    material m;
    if (!material_open(name, &m, error))
        return false;
    const bool ok = material_bake(&m, &desc, table, error);
    material_close(&m);
    return ok;
}

bool materials_apply(const cli_list *list, const scene *world, int bands, lmp_window window,
                     gpu_renderer *renderer, materials *all, cli_error *error) {
    memset(all, 0, sizeof *all);
    if (list->count == 0)
        return true;
    int *uses = malloc((world->material_count + 1) * sizeof *uses);
    if (!uses)
        return cli_fail(error, NULL, "out of memory");
    for (size_t i = 0; i < world->material_count; i++)
        uses[i] = -1;
    bool ok = true;
    for (int i = 0; i < list->count && ok; i++) {
        const char *text = list->items[i], *equals = strchr(text, '=');
        ok = equals ? use_table(world, text, (size_t)(equals - text), i, uses, error) &&
                          bake(equals + 1, bands, window, &all->tables[i], error)
                    : cli_fail(error, text, "--material is SLOT=MATERIAL");
        all->count += ok;
    }
    ok = ok && gpu_set_tables(renderer, (const lmp_brdf_table *const *)all->tables, all->count,
                              uses, world->material_count, error);
    free(uses);
    return ok;
}

void materials_free(materials *all) {
    for (int i = 0; i < all->count; i++)
        lmp_brdf_table_destroy(all->tables[i]);
    all->count = 0;
}
