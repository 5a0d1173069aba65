/* SPDX-License-Identifier: MIT */
#include "app/render/gl/block.h"

#include <string.h>

static_assert(SHARED_MAPS == SCENE_MAPS, "a block has all maps of a material");

/* Sets the transmission: a leaf transmits a part of its base color, and reflects all of it. */
static void fill_transmission(const scene_material *from, vec4 transmission) {
    const bool leaf = from->flags & SCENE_LEAF;
    for (int c = 0; c < 3; c++)
        transmission[c] = leaf ? SCENE_LEAF_TRANSMITS : from->transmission_color[c];
    transmission[3] = leaf ? -1 : from->transmission;
}

void gpu_fill_material(const scene_material *from, size_t number, shared_material *block) {
    memset(block, 0, sizeof *block);
    memcpy(block->base_color, from->base_color, sizeof from->base_color);
    memcpy(block->emission, from->emission, sizeof from->emission);
    block->emission[3] = (float)(SHARED_KIND_SURFACE + number);
    block->factors[0] = from->metallic;
    block->factors[1] = from->roughness;
    block->factors[2] = from->normal_scale;
    block->factors[3] = from->alpha_cutoff;
    for (int i = 0; i < SHARED_MAPS; i++) {
        const scene_texture_use *use = &from->maps[i];
        (i < 4 ? block->maps : block->more[i / 4 - 1])[i % 4] = use->texture < 0 ? 0 : 1;
        memcpy(block->matrix[i], use->matrix, sizeof use->matrix);
        memcpy(block->offset[i], use->offset, sizeof use->offset);
        block->offset[i][2] = (float)use->set;
    }
    block->vertex[0] = from->flags & SCENE_VERTEX_COLORS ? 1.0f : 0.0f;
    block->vertex[1] = from->occlusion;
    block->vertex[2] = from->flags & SCENE_ALPHA_BLEND ? 1.0f : 0.0f;
    block->vertex[3] = block->vertex[0] > 0.0f && from->flags & SCENE_UNLIT ? 1.0f : 0.0f;
    block->coat[0] = from->coat;
    block->coat[1] = from->coat_roughness;
    block->coat[2] = from->coat_normal_scale;
    memcpy(block->sheen, from->sheen_color, sizeof from->sheen_color);
    block->sheen[3] = from->sheen_roughness;
    fill_transmission(from, block->transmission);
}

bool gpu_material_is_plain(const scene_material *source) {
    bool plain = !scene_is_layered(source) && !scene_is_translucent(source) &&
                 !(source->flags & (SCENE_ALPHA_MASK | SCENE_ALPHA_BLEND | SCENE_VERTEX_COLORS));
    for (int i = 0; i < SCENE_MAPS; i++)
        plain = plain && source->maps[i].texture < 0;
    return plain;
}

shared_material_constants gpu_material_constants(const scene_material *m) {
    return (shared_material_constants) { { m->f0[0], m->f0[1], m->f0[2], m->f90 },
                                         { -1, scene_is_layered(m) ? 1 : 0 } };
}
