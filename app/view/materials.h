/* SPDX-License-Identifier: MIT */
/* materials.h - the materials that a side of the viewer has, and their tables. */
#ifndef LAMPION_VIEW_MATERIALS_H
#define LAMPION_VIEW_MATERIALS_H

#include "app/render/renderer/override.h"
#include "app/view/settings.h"

/* The materials of some settings, and the shading that they were made for; zero-initialized: none.
 * Free with view_materials_free. */
typedef struct view_materials {
    override_set made;
    view_replacements of;
    view_shading shading;
} view_materials;

/* Whether the materials are those that a side of the settings needs. */
bool view_materials_match(const view_materials *materials, const scene *world,
                          const view_settings *settings, const view_shading *shading);

/* Checks before tables are made whether they will fit the renderer. */
bool view_materials_fit(const scene *world, const view_settings *settings,
                        const view_shading *shading, const any_renderer *renderer,
                        base_error *error);

/* Makes the materials' tables, or reads them from the cache. On failure *fresh is empty. */
bool view_materials_make(const scene *world, const view_settings *settings,
                         const view_shading *shading, view_materials *fresh, base_error *error);

void view_materials_free(view_materials *materials);

#endif
