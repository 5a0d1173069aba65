/* SPDX-License-Identifier: MIT */
/* override.h - the option --material NAME=MATERIAL: replaces materials of a scene by others. */
#ifndef LAMPION_RENDER_RENDERER_OVERRIDE_H
#define LAMPION_RENDER_RENDERER_OVERRIDE_H

#include "app/base/cli.h"
#include "app/render/renderer/renderer.h"
#include "app/scene/material.h"

#define OVERRIDE_ARGUMENT "NAME=MATERIAL"
#define OVERRIDE_OPTION_ROW(list)                                                                  \
    {                                                                                              \
        .name = "material", .kind = CLI_LIST, .target = &(list), .argument = OVERRIDE_ARGUMENT,    \
        .help = "replace a material of the scene: " MATERIAL_NAMES                                 \
    }

typedef struct override_set {
    material opened[RENDER_TABLES_MAX];
    lmp_brdf_table *tables[RENDER_TABLES_MAX];                /* NULL before override_bake */
    lmp_preintegrated_brdf *preintegrated[RENDER_TABLES_MAX]; /* of tables; NULL unless requested */
    lmp_brdf_table *sheen_tables[LMP_SHEEN_TABLES]; /* of white sheen; NULL if the scene has none */
    int count;
    int *uses; /* for each of the scene's materials the entry that replaces it, or -1 */
} override_set;

/* Opens each entry of the list. An unknown name is an error that lists the known ones. *set must be
 * freed even after a failure. */
bool override_open(const cli_list *list, const scene *scene, override_set *set, base_error *error);

/* Checks before tables are made whether they will fit the renderer. */
bool override_fits(const override_set *set, int bands, method_kind method,
                   const any_renderer *renderer, base_error *error);

/* Tabulates each entry. */
bool override_bake(override_set *set, int bands, lmp_window window, base_error *error);

/* Preintegrates, after override_bake, the tables that allow it, for a method that reads them. */
bool override_preintegrate(override_set *set, base_error *error);

/* Whether the list, or the sheen of the scene's own materials, requires a set. */
bool override_is_needed(int count, const scene *scene);

/* Makes the tables of lmp_sheen_layer if the scene has sheen. */
bool override_bake_sheen(override_set *set, const scene *scene, int bands, lmp_window window,
                         base_error *error);

/* Lets the renderer shade the scene with the set; without entries, with the scene's own materials
 * again. */
bool override_apply(const override_set *set, const scene *scene, any_renderer *renderer,
                    base_error *error);

/* Does all of the above, as the frame's method, bands and window require, and applies it to the
 * renderer. */
bool override_prepare(const cli_list *list, const scene *scene, const render_frame *frame,
                      any_renderer *renderer, override_set *set, base_error *error);

/* Returns the albedo of each of the scene's materials that an entry replaces, over all views, and
 * colors below 0 for the others; NULL if memory ran out. Release it with free. Call it after
 * override_bake. */
lmp_rgb *override_albedos(const override_set *set, const scene *scene);

/* Frees the set; call it after the renderer is destroyed. */
void override_free(override_set *set);

#endif
