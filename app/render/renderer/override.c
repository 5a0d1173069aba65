/* SPDX-License-Identifier: MIT */
#include "app/render/renderer/override.h"

#include "app/base/choice.h"
#include "app/render/method.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Lets entry `entry` replace the materials with the name before `=` in text. */
static bool use_entry(const scene *world, const char *text, size_t length, int entry, int *uses,
                      base_error *error) {
    char name[SCENE_NAME_SIZE] = "";
    bool found = false;
    if (length >= sizeof name)
        return base_fail(error, text, "no material has so long a name");
    memcpy(name, text, length);
    for (size_t i = 0; i < world->material_count; i++)
        if (strcmp(world->materials[i].name, name) == 0) {
            uses[i] = entry;
            found = true;
        }
    return found ||
           choice_fail_member(error, world->name, "material", name, world->materials[0].name,
                              sizeof *world->materials, world->material_count);
}

bool override_open(const cli_list *list, const scene *world, override_set *all, base_error *error) {
    *all = (override_set) { .count = 0 };
    if (list->count == 0)
        return true;
    all->uses = malloc((world->material_count + 1) * sizeof *all->uses);
    if (!all->uses)
        return base_fail(error, NULL, "out of memory");
    for (size_t i = 0; i < world->material_count; i++)
        all->uses[i] = -1;
    for (int i = 0; i < list->count; i++) {
        const char *text = list->items[i], *equals = strchr(text, '=');
        if (!equals)
            return base_fail(error, text, "--material is " OVERRIDE_ARGUMENT);
        if (!use_entry(world, text, (size_t)(equals - text), i, all->uses, error) ||
            !material_open(equals + 1, &all->opened[i], error))
            return false;
        all->count++;
    }
    return true;
}

static lmp_brdf_table_desc desc_of(int bands, lmp_window window) {
    return (lmp_brdf_table_desc) { .bands = bands,
                                   .azimuths = LMP_BRDF_AZIMUTHS_DEFAULT,
                                   .window = window };
}

bool override_fits(const override_set *all, int bands, method_kind method,
                   const any_renderer *renderer, base_error *error) {
    const lmp_brdf_table_desc desc = desc_of(bands, LMP_WINDOW_NONE);
    lmp_brdf_table_info plans[RENDER_TABLES_MAX];
    for (int i = 0; i < all->count; i++)
        plans[i] = material_plan(&all->opened[i], &desc);
    return renderer_tables_fit(renderer, method, plans, all->count, error);
}

bool override_bake(override_set *all, int bands, lmp_window window, base_error *error) {
    const lmp_brdf_table_desc desc = desc_of(bands, window);
    for (int i = 0; i < all->count; i++)
        if (!material_bake(&all->opened[i], &desc, &all->tables[i], error))
            return false;
    return true;
}

bool override_is_needed(int count, const scene *world) {
    bool sheen = false;
    for (size_t i = 0; i < world->material_count; i++)
        sheen = sheen || scene_has_sheen(&world->materials[i]);
    return count > 0 || sheen;
}

/* Sheen is so smooth that 20 bands miss only a thousandth of it. */
enum { SHEEN_BANDS_MAX = 20 };

bool override_bake_sheen(override_set *all, const scene *world, int bands, lmp_window window,
                         base_error *error) {
    const lmp_brdf_table_desc desc = { .bands = bands < SHEEN_BANDS_MAX ? bands : SHEEN_BANDS_MAX,
                                       .window = window };
    const float least = LMP_SHEEN_ROUGHNESS_MIN, last = LMP_SHEEN_TABLES - 1;
    bool ok = true;
    for (int i = 0; ok && i < LMP_SHEEN_TABLES && override_is_needed(0, world); i++) {
        char name[32];
        material white;
        snprintf(name, sizeof name, "sheen:%.6f", (double)(least + (1 - least) * (float)i / last));
        if (!material_open(name, &white, error))
            return false;
        ok = material_bake(&white, &desc, &all->sheen_tables[i], error);
        material_close(&white);
    }
    return ok;
}

bool override_preintegrate(override_set *all, base_error *error) {
    for (int i = 0; i < all->count; i++)
        if (!material_preintegrate(&all->opened[i], all->tables[i], &all->preintegrated[i], error))
            return false;
    return true;
}

bool override_apply(const override_set *all, const scene *world, any_renderer *renderer,
                    base_error *error) {
    const size_t count = world->material_count;
    int *none = NULL;
    if (!all->uses) {
        none = malloc((count + 1) * sizeof *none);
        if (!none)
            return base_fail(error, NULL, "out of memory");
        memset(none, 0xff, (count + 1) * sizeof *none);
    }
    const bool ok = renderer_set_tables(renderer, (const lmp_brdf_table *const *)all->tables,
                                        all->count, all->uses ? all->uses : none, error);
    if (ok)
        renderer_set_brdfs(renderer, (const lmp_preintegrated_brdf *const *)all->preintegrated);
    renderer_set_sheen(
        renderer, all->sheen_tables[0] ? (const lmp_brdf_table *const *)all->sheen_tables : NULL);
    free(none);
    return ok;
}

bool override_prepare(const cli_list *list, const scene *world, const render_frame *frame,
                      any_renderer *renderer, override_set *all, base_error *error) {
    return override_open(list, world, all, error) &&
           override_fits(all, frame->bands, frame->method, renderer, error) &&
           override_bake(all, frame->bands, frame->window, error) &&
           (!(method_table[frame->method].reads & METHOD_READS_PREINTEGRATED) ||
            override_preintegrate(all, error)) &&
           override_bake_sheen(all, world, frame->bands, frame->window, error) &&
           (!override_is_needed(all->count, world) || override_apply(all, world, renderer, error));
}

/* Returns the fraction of even light that a table's BRDF reflects, each view weighted by its solid
 * angle and cosine; in whole thousandths, which tables of other bands share. */
static lmp_rgb albedo_of(const lmp_brdf_table *table) {
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    double sum[3] = { 0 }, weights = 0;
    for (int view = 0; view < info.views; view++) {
        lmp_rgb whole, series;
        const double weight = sin(2 * (double)info.theta_step * view);
        lmp_brdf_table_find_albedo(table, view, 0, &whole, &series);
        sum[0] += weight * (double)whole.r;
        sum[1] += weight * (double)whole.g;
        sum[2] += weight * (double)whole.b;
        weights += weight;
    }
    for (int c = 0; c < 3; c++)
        sum[c] = fmin(fmax(round(1e3 * sum[c] / weights) / 1e3, 0), 1);
    return (lmp_rgb) { (float)sum[0], (float)sum[1], (float)sum[2] };
}

lmp_rgb *override_albedos(const override_set *all, const scene *world) {
    lmp_rgb of[RENDER_TABLES_MAX];
    lmp_rgb *albedos = malloc((world->material_count + 1) * sizeof *albedos);
    for (int i = 0; i < all->count; i++)
        of[i] = albedo_of(all->tables[i]);
    for (size_t m = 0; albedos && m < world->material_count; m++)
        albedos[m] = all->uses && all->uses[m] >= 0 ? of[all->uses[m]] : (lmp_rgb) { -1, -1, -1 };
    return albedos;
}

void override_free(override_set *all) {
    for (int i = 0; i < all->count; i++) {
        lmp_preintegrated_brdf_destroy(all->preintegrated[i]);
        lmp_brdf_table_destroy(all->tables[i]);
        material_close(&all->opened[i]);
    }
    for (int i = 0; i < LMP_SHEEN_TABLES; i++)
        lmp_brdf_table_destroy(all->sheen_tables[i]);
    free(all->uses);
    *all = (override_set) { .count = 0 };
}
