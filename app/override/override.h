/* SPDX-License-Identifier: MIT */
/* override.h - the option --material NAME=MATERIAL: materials of a scene replaced by others. */
#ifndef LAMPION_OVERRIDE_H
#define LAMPION_OVERRIDE_H

#include "app/material/material.h"
#include "app/render/renderer.h"

#define OVERRIDE_ARGUMENT "NAME=MATERIAL"
#define OVERRIDE_OPTION_ROW(list)                                                                  \
    {                                                                                              \
        .name = "material", .kind = CLI_LIST, .target = &(list), .argument = OVERRIDE_ARGUMENT,    \
        .help = "replace a material of the scene: " MATERIAL_NAMES                                 \
    }

typedef struct override_set {
    material opened[RENDER_TABLES_MAX];
    lmp_brdf_table *tables[RENDER_TABLES_MAX];                /* NULL before override_bake */
    lmp_preintegrated_brdf *preintegrated[RENDER_TABLES_MAX]; /* of tables; NULL unless asked for */
    lmp_brdf_table *fibers[LMP_FIBER_TABLES]; /* white ones; NULL where the scene has no sheen */
    int count;
    int *uses; /* for each of the scene's materials the entry that replaces it, or -1 */
} override_set;

/* Opens each of the list. An unknown name is an error that lists those there are. On failure too,
 * *set is to be freed. */
bool override_open(const cli_list *list, const scene *scene, override_set *set, cli_error *error);

/* Whether the tables of each will fit the renderers, of which any may be NULL: they would be made
 * in vain. */
bool override_fits(const override_set *set, int bands, method_kind method,
                   any_renderer *const *renderers, int count, cli_error *error);

/* Makes a table of each. */
bool override_bake(override_set *set, int bands, lmp_window window, cli_error *error);

/* Then preintegrates the tables that allow it, for a method that reads them so. */
bool override_preintegrate(override_set *set, cli_error *error);

/* Whether the list, or the sheen of the scene's own materials, makes a renderer need a set. */
bool override_is_needed(int count, const scene *scene);

/* Makes the tables of lmp_fibers if the scene has sheen. */
bool override_bake_fibers(override_set *set, const scene *scene, int bands, lmp_window window,
                          cli_error *error);

/* Has the renderer of the scene shade by them; without any by the scene's own again. */
bool override_apply(const override_set *set, const scene *scene, any_renderer *renderer,
                    cli_error *error);

/* All of these: what the frame's method, bands and window need, for the renderer. */
bool override_prepare(const cli_list *list, const scene *scene, const render_frame *frame,
                      any_renderer *renderer, override_set *set, cli_error *error);

/* After the renderer. */
void override_free(override_set *set);

#endif
