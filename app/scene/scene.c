/* SPDX-License-Identifier: MIT */
#include "app/scene/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

void scene_left_out_text(const scene_left_out *item, char *text, size_t size) {
    const char last = item->noun[0] ? item->noun[strlen(item->noun) - 1] : 0;
    const char *ending = item->count == 1 ? "" : last == 'h' ? "es" : "s"; /* mesh, meshes */
    if (item->what[0])
        snprintf(text, size, "%s (%u %s%s)", item->what, item->count, item->noun, ending);
    else
        snprintf(text, size, "%u %s%s", item->count, item->noun, ending);
}

lmp_dielectric scene_dielectric(const scene_material *m) {
    if (m->flags & SCENE_DIELECTRIC)
        return (lmp_dielectric) { true, { m->f0[0], m->f0[1], m->f0[2] }, m->f90 };
    return (lmp_dielectric) { true, { 0.04f, 0.04f, 0.04f }, 1.0f };
}

void scene_free(scene *s) {
    if (s->mapped)
        munmap(s->block, s->block_size);
    else
        free(s->block);
    free(s->lights);
    memset(s, 0, sizeof *s);
}
