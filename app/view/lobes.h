/* SPDX-License-Identifier: MIT */
/* lobes.h - the preintegrated lobes used most recently. */
#ifndef LAMPION_VIEW_LOBES_H
#define LAMPION_VIEW_LOBES_H

#include "app/view/settings.h"

enum { VIEW_LOBES = 8 };

typedef struct view_lobes {
    struct view_lobe {
        int bands;
        lmp_window window;
        lmp_preintegrated_lobe *lobe;
        unsigned used; /* when it was last used, by the clock */
    } of[VIEW_LOBES];
    unsigned clock;
} view_lobes;

/* Whether the lobe of these bands and window is there. */
bool view_lobes_have(const view_lobes *lobes, const view_shading *shading);

/* Returns the lobe of these bands and window; if it must be made, it replaces the least recently
 * used one. Returns NULL on failure. */
const lmp_preintegrated_lobe *view_lobes_get(view_lobes *lobes, const view_shading *shading,
                                             base_error *error);
void view_lobes_free(view_lobes *lobes);

#endif
