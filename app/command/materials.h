/* SPDX-License-Identifier: MIT */
/* materials.h - the option --material SLOT=MATERIAL: materials of a scene replaced by tables. */
#ifndef LAMPION_COMMAND_MATERIALS_H
#define LAMPION_COMMAND_MATERIALS_H

#include "app/gpu/gpu.h"
#include "app/material/material.h"

#define MATERIALS_OPTION_ROW(list)                                                                 \
    {                                                                                              \
        .name = "material", .kind = CLI_LIST, .target = &(list), .argument = "SLOT=MATERIAL",      \
        .help = "replace a material of the scene: " MATERIAL_NAMES                                 \
    }

typedef struct materials {
    lmp_brdf_table *tables[GPU_TABLES_MAX];
    int count;
} materials;

/* Makes a table for each of the list, and has the renderer shade by them. An unknown slot is an
 * error that lists those there are. */
bool materials_apply(const cli_list *list, const scene *scene, int bands, lmp_window window,
                     gpu_renderer *renderer, materials *materials, cli_error *error);
/* After the renderer. */
void materials_free(materials *materials);

#endif
