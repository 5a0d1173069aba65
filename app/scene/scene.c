/* SPDX-License-Identifier: MIT */
#include "app/scene/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

/* Returns the ending of a noun's plural: "es" as in meshes, or "s" as in files. */
static const char *ending_of(const char *noun, size_t length) {
    return length > 0 && noun[length - 1] == 'h' ? "es" : "s";
}

void scene_unsupported_text(const scene_unsupported *item, char *text, size_t size) {
    const char *noun = item->noun,
               *after = strstr(noun, " outside "); /* files outside the folder */
    const size_t length = after ? (size_t)(after - noun) : strlen(noun);
    char counted[SCENE_NAME_SIZE + 16];
    snprintf(counted, sizeof counted, "%u %.*s%s%s", item->count, (int)length, noun,
             item->count == 1 ? "" : ending_of(noun, length), noun + length);
    snprintf(text, size, item->what[0] ? "%s (%s)" : "%s%s", item->what, counted);
}

scene_material scene_material_plain(void) {
    const scene_texture_use none = { .texture = -1, .matrix = { 1.0f, 0.0f, 0.0f, 1.0f } };
    scene_material material = {
        .base_color = { 1.0f, 1.0f, 1.0f, 1.0f },
        .roughness = 1.0f,
        .normal_scale = 1.0f,
        .alpha_cutoff = 0.5f,
        .f0 = { LMP_DIELECTRIC_F0, LMP_DIELECTRIC_F0, LMP_DIELECTRIC_F0 },
        .f90 = 1.0f,
        .occlusion = 1.0f,
        .coat_normal_scale = 1.0f,
    };
    for (int i = 0; i < SCENE_MAPS; i++)
        material.maps[i] = none;
    return material;
}

bool scene_is_layered(const scene_material *m) {
    return m->coat > 0 || scene_has_sheen(m) || m->specular_color_map.texture >= 0;
}

bool scene_has_sheen(const scene_material *m) {
    return m->sheen_color[0] > 0 || m->sheen_color[1] > 0 || m->sheen_color[2] > 0;
}

bool scene_is_translucent(const scene_material *m) {
    return m->transmission > 0 || m->flags & SCENE_LEAF;
}

void scene_free(scene *s) {
    if (s->mapped)
        munmap(s->block, s->block_size);
    else
        free(s->block);
    if (s->decoded)
        munmap(s->decoded, s->decoded_size);
    free(s->own_materials);
    free(s->own_unsupported);
    free(s->lights);
    free(s->frame);
    memset(s, 0, sizeof *s);
}
