/* SPDX-License-Identifier: MIT */
/* lobes.h - preintegrated lobes that were made for what was shown last. */
#ifndef LAMPION_VIEW_LOBES_H
#define LAMPION_VIEW_LOBES_H

#include "app/view/settings.h"

enum { VIEW_LOBES = 8 };

typedef struct view_lobes {
    struct view_lobe {
        int bands;
        lmp_window window;
        lmp_preintegrated_lobe *lobe;
        unsigned used; /* when, by the clock */
    } of[VIEW_LOBES];
    unsigned clock;
} view_lobes;

/* Whether that of the bands and window is there. */
bool view_lobes_have(const view_lobes *lobes, const view_shading *shading);

/* Makes it if need be, in place of the one that was used longest ago. NULL on failure. */
const lmp_preintegrated_lobe *view_lobes_get(view_lobes *lobes, const view_shading *shading,
                                             cli_error *error);
void view_lobes_free(view_lobes *lobes);

#endif
