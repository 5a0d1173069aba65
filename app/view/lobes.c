/* SPDX-License-Identifier: MIT */
#include "app/view/lobes.h"

#include "app/scene/bake.h"

static int find(const view_lobes *lobes, const view_shading *shading) {
    for (int i = 0; i < VIEW_LOBES; i++)
        if (lobes->of[i].lobe && lobes->of[i].bands == shading->bands &&
            lobes->of[i].window == shading->window)
            return i;
    return -1;
}

bool view_lobes_have(const view_lobes *lobes, const view_shading *shading) {
    return find(lobes, shading) >= 0;
}

const lmp_preintegrated_lobe *view_lobes_get(view_lobes *lobes, const view_shading *shading,
                                             base_error *error) {
    int at = find(lobes, shading);
    if (at < 0) {
        lmp_preintegrated_lobe *lobe = NULL;
        if (!bake_lobes(shading->bands, shading->window, &lobe, error))
            return NULL;
        at = 0;
        for (int i = 1; i < VIEW_LOBES; i++)
            if (lobes->of[i].used < lobes->of[at].used)
                at = i;
        lmp_preintegrated_lobe_destroy(lobes->of[at].lobe);
        lobes->of[at] = (struct view_lobe) { shading->bands, shading->window, lobe, 0 };
    }
    lobes->of[at].used = ++lobes->clock;
    return lobes->of[at].lobe;
}

void view_lobes_free(view_lobes *lobes) {
    for (int i = 0; i < VIEW_LOBES; i++)
        lmp_preintegrated_lobe_destroy(lobes->of[i].lobe);
    *lobes = (view_lobes) { .clock = 0 };
}
