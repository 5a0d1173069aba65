/* SPDX-License-Identifier: MIT */
/* materials.h - the option --material SLOT=MATERIAL: materials of a scene replaced. */
#ifndef LAMPION_DEVICE_MATERIALS_H
#define LAMPION_DEVICE_MATERIALS_H

#include "app/gpu/gpu.h"
#include "app/material/material.h"

#define MATERIALS_OPTION_ROW(list)                                                                 \
    {                                                                                              \
        .name = "material", .kind = CLI_LIST, .target = &(list), .argument = "SLOT=MATERIAL",      \
        .help = "replace a material of the scene: " MATERIAL_NAMES                                 \
    }

typedef struct device_materials {
    material opened[GPU_TABLES_MAX];
    lmp_brdf_table *tables[GPU_TABLES_MAX];            /* NULL before device_materials_bake */
    lmp_preintegrated_brdf *responses[GPU_TABLES_MAX]; /* of tables; NULL unless asked for */
    int count;
    int *uses; /* for each of the scene's materials the entry that replaces it, or -1 */
} device_materials;

/* Opens each of the list. An unknown slot is an error that lists those there are. On failure too,
 * *materials is to be freed. */
bool device_materials_open(const cli_list *list, const scene *scene, device_materials *materials,
                           cli_error *error);

/* Makes a table of each. */
bool device_materials_bake(device_materials *materials, int bands, lmp_window window,
                           cli_error *error);

/* Then a response, where it has one, for the method preintegrated. */
bool device_materials_respond(device_materials *materials, cli_error *error);

/* Has the renderer of the scene shade by them; without any by the scene's own again. */
bool device_materials_give(const device_materials *materials, const scene *scene,
                           gpu_renderer *renderer, cli_error *error);

/* All that the frame's method, bands and window need, and has the renderer shade by them. */
bool device_materials_apply(const cli_list *list, const scene *scene, const gpu_frame *frame,
                            gpu_renderer *renderer, device_materials *materials, cli_error *error);
/* After the renderer. */
void device_materials_free(device_materials *materials);

#endif
