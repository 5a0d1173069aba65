/* SPDX-License-Identifier: MIT */
/* baking.h - tables of materials made beside the viewer, which goes on drawing: by a process of
 * `lampion brdf bake`, into the cache. */
#ifndef LAMPION_VIEW_BAKING_H
#define LAMPION_VIEW_BAKING_H

#include "app/view/settings.h"

#include <sys/types.h>

/* What is being made, or was; zero-initialized: nothing yet. */
typedef struct view_baking {
    pid_t process; /* of one side after the other, each on all cores; 0: none */
    int started, sides, material_count;
    view_shading shading[2];
    char materials[RENDER_TABLES_MAX][VIEW_MATERIAL_SIZE];
} view_baking;

/* Makes the tables of these settings, in place of those of others. False once that has ended, well
 * or not: they can be read from the cache, or what is wrong is found by making them here. */
bool view_bake(view_baking *baking, const view_settings *settings);

void view_baking_stop(view_baking *baking);

#endif
