/* SPDX-License-Identifier: MIT */
#include "app/scene/load/leaves.h"

#include "app/scene/load/texels.h"

const char *const scene_leaves_names[] = { "translucent", "opaque", NULL };

/* Texels of a map that are sampled along each axis. */
enum { LOOKS = 32 };

/* Sums the texels that the alpha mask keeps, at samples spread evenly over a map; white without a
 * map. */
static void sum_texels(const scene *s, const scene_material *m, double sum[3]) {
    const int32_t map = m->base_color_map.texture;
    for (int c = 0; c < 3; c++)
        sum[c] = map < 0 ? 1 : 0;
    if (map < 0)
        return;
    const scene_texture *texture = &s->textures[map];
    const size_t width = texture->width, height = texture->height;
    for (size_t j = 0; j < LOOKS; j++)
        for (size_t i = 0; i < LOOKS; i++) {
            const size_t x = (2 * i + 1) * width / (2 * LOOKS);
            const size_t y = (2 * j + 1) * height / (2 * LOOKS);
            const unsigned char *texel = s->texels + texture->first_byte + 4 * (y * width + x);
            const bool left = (float)texel[3] * m->base_color[3] >= 255 * m->alpha_cutoff;
            for (int c = 0; left && c < 3; c++)
                sum[c] += texel[c];
        }
}

static bool is_leaf(const scene *s, const scene_material *m) {
    const uint32_t needed = SCENE_ALPHA_MASK | SCENE_DOUBLE_SIDED;
    double sum[3];
    if ((m->flags & needed) != needed || m->flags & SCENE_UNLIT ||
        (m->metallic > 0 && m->metallic_roughness_map.texture < 0))
        return false;
    sum_texels(s, m, sum);
    for (int c = 0; c < 3; c++)
        sum[c] *= (double)m->base_color[c];
    return sum[1] > sum[0] && sum[1] > sum[2];
}

bool scene_find_leaves(scene *s, size_t *count, base_error *error) {
    *count = 0;
    if (!s->texels && s->texture_count > 0)
        return true;
    for (size_t i = 0; i < s->material_count; i++)
        if (s->materials[i].transmission > 0)
            return true;
    for (size_t i = 0; i < s->material_count; i++) {
        if (!is_leaf(s, &s->materials[i]))
            continue;
        if (!scene_own_lists(s, error))
            return false;
        s->own_materials[i].flags |= SCENE_LEAF;
        ++*count;
    }
    return true;
}
