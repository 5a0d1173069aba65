/* SPDX-License-Identifier: MIT */
#include "app/device/materials.h"

#include "app/device/device.h"

#include <stdlib.h>
#include <string.h>

/* Notes that the materials named like the slot are replaced by entry `entry`. */
static bool use_entry(const scene *world, const char *text, size_t slot_length, int entry,
                      int *uses, cli_error *error) {
    char slot[SCENE_NAME_SIZE] = "";
    bool found = false;
    if (slot_length >= sizeof slot)
        return cli_fail(error, text, "no material has so long a name");
    memcpy(slot, text, slot_length);
    for (size_t i = 0; i < world->material_count; i++)
        if (strcmp(world->materials[i].name, slot) == 0) {
            uses[i] = entry;
            found = true;
        }
    return found ||
           cli_fail_member(error, world->origin, "material", slot, world->materials[0].name,
                           sizeof *world->materials, world->material_count);
}

bool device_materials_open(const cli_list *list, const scene *world, device_materials *all,
                           cli_error *error) {
    *all = (device_materials) { .count = 0 };
    if (list->count == 0)
        return true;
    all->uses = malloc((world->material_count + 1) * sizeof *all->uses);
    if (!all->uses)
        return cli_fail(error, NULL, "out of memory");
    for (size_t i = 0; i < world->material_count; i++)
        all->uses[i] = -1;
    for (int i = 0; i < list->count; i++) {
        const char *text = list->items[i], *equals = strchr(text, '=');
        if (!equals)
            return cli_fail(error, text, "--material is SLOT=MATERIAL");
        if (!use_entry(world, text, (size_t)(equals - text), i, all->uses, error) ||
            !material_open(equals + 1, &all->opened[i], error))
            return false;
        all->count++;
    }
    return true;
}

bool device_materials_bake(device_materials *all, int bands, lmp_window window, cli_error *error) {
    const lmp_brdf_table_desc desc = { .bands = bands,
                                       .azimuths = LMP_BRDF_AZIMUTHS_DEFAULT,
                                       .window = window };
    for (int i = 0; i < all->count; i++)
        if (!material_bake(&all->opened[i], &desc, &all->tables[i], error))
            return false;
    return true;
}

bool device_materials_respond(device_materials *all, cli_error *error) {
    for (int i = 0; i < all->count; i++)
        if (!device_preintegrated_brdf(&all->opened[i], all->tables[i], &all->responses[i], error))
            return false;
    return true;
}

bool device_materials_give(const device_materials *all, const scene *world, gpu_renderer *renderer,
                           cli_error *error) {
    const size_t count = world->material_count;
    int *none = NULL;
    if (!all->uses) {
        none = malloc((count + 1) * sizeof *none);
        if (!none)
            return cli_fail(error, NULL, "out of memory");
        memset(none, 0xff, (count + 1) * sizeof *none);
    }
    const bool ok = gpu_set_tables(renderer, (const lmp_brdf_table *const *)all->tables, all->count,
                                   all->uses ? all->uses : none, count, error);
    if (ok)
        gpu_set_responses(renderer, (const lmp_preintegrated_brdf *const *)all->responses);
    free(none);
    return ok;
}

bool device_materials_apply(const cli_list *list, const scene *world, const gpu_frame *frame,
                            gpu_renderer *renderer, device_materials *all, cli_error *error) {
    return device_materials_open(list, world, all, error) &&
           device_materials_bake(all, frame->bands, frame->window, error) &&
           (frame->method != GPU_METHOD_PREINTEGRATED || device_materials_respond(all, error)) &&
           (all->count == 0 || device_materials_give(all, world, renderer, error));
}

void device_materials_free(device_materials *all) {
    for (int i = 0; i < all->count; i++) {
        lmp_preintegrated_brdf_destroy(all->responses[i]);
        lmp_brdf_table_destroy(all->tables[i]);
        material_close(&all->opened[i]);
    }
    free(all->uses);
    *all = (device_materials) { .count = 0 };
}
