/* SPDX-License-Identifier: MIT */
/* baking.h - tabulation of materials in a process of `lampion brdf bake`, into the cache, while the
 * viewer goes on drawing. */
#ifndef LAMPION_VIEW_BAKING_H
#define LAMPION_VIEW_BAKING_H

#include "app/view/settings.h"

#include <sys/types.h>

/* The tabulation in progress, or the last one; zero-initialized: none yet. */
typedef struct view_baking {
    pid_t process; /* tabulates one side after the other, each on all cores; 0: none */
    int started, sides;
    view_shading shading[2];
    view_replacements materials;
} view_baking;

/* Whether the tables of these settings are being made, or were. */
bool view_bakes(const view_baking *baking, const view_settings *settings);

/* Makes the tables of these settings, dropping any others in progress. Returns false once it has
 * ended, successfully or not: the tables can then be read from the cache, or the error is found by
 * making them here. */
bool view_bake(view_baking *baking, const view_settings *settings);

void view_baking_stop(view_baking *baking);

#endif
