/* SPDX-License-Identifier: MIT */
#include "app/render/materials.h"

#include <stdlib.h>
#include <string.h>

bool render_materials_create(const scene *world, render_materials *materials) {
    *materials = (render_materials) { .count = world->material_count };
    materials->of = calloc(world->material_count + 1, sizeof *materials->of);
    if (!materials->of)
        return false;
    for (size_t i = 0; i < world->material_count; i++) {
        const scene_material *from = &world->materials[i];
        render_material_constants *to = &materials->of[i];
        memcpy(to->f0, from->f0, sizeof to->f0);
        to->f90 = from->f90;
        to->layered = scene_is_layered(from);
        to->sheen = scene_has_sheen(from);
        to->translucent = scene_is_translucent(from);
        to->table = -1;
        materials->layered = materials->layered || to->layered;
        materials->translucent = materials->translucent || to->translucent;
        materials->blends = materials->blends || from->flags & SCENE_ALPHA_BLEND;
    }
    return true;
}

void render_materials_free(render_materials *materials) {
    free(materials->of);
    *materials = (render_materials) { .count = 0 };
}

bool render_materials_set_tables(render_materials *m, const lmp_brdf_table *const *tables,
                                 int count, const int *uses, base_error *error) {
    if (count > RENDER_TABLES_MAX)
        return base_fail(error, NULL, "%d materials with tables: a frame takes %d", count,
                         RENDER_TABLES_MAX);
    for (int t = 1; t < count; t++) {
        const int first = lmp_brdf_table_describe(tables[0]).bands,
                  bands = lmp_brdf_table_describe(tables[t]).bands;
        if (bands != first)
            return base_fail(error, NULL, "tables of %d and of %d bands in one image", first,
                             bands);
    }
    m->table_count = count;
    for (int t = 0; t < count; t++) {
        m->tables[t] = tables[t];
        m->table_bands = lmp_brdf_table_describe(tables[t]).bands;
    }
    for (size_t i = 0; i < m->count; i++)
        m->of[i].table = uses[i];
    render_materials_set_brdfs(m, NULL);
    return true;
}

void render_materials_set_brdfs(render_materials *m, const lmp_preintegrated_brdf *const *brdfs) {
    for (int t = 0; t < RENDER_TABLES_MAX; t++)
        m->brdfs[t] = brdfs && t < m->table_count ? brdfs[t] : NULL;
}

void render_materials_set_sheen(render_materials *m, const lmp_brdf_table *const *white) {
    for (int i = 0; i < LMP_SHEEN_TABLES; i++)
        m->sheen_tables[i] = white ? white[i] : NULL;
}

bool render_material_is_layered(const render_materials *m, size_t number) {
    return m->of[number].layered && m->of[number].table < 0;
}

bool render_material_is_translucent(const render_materials *m, size_t number) {
    return m->of[number].translucent && m->of[number].table < 0;
}

static float at_most_one(float x) {
    return x < 1 ? x : 1;
}

void render_material_fill(const render_materials *m, size_t number, float specular, lmp_rgb tint,
                          lmp_material *material) {
    const render_material_constants *from = &m->of[number];
    const float weight = from->f90 * specular;
    if (from->table >= 0)
        *material = (lmp_material) { .kind = LMP_MATERIAL_TABLE,
                                     .table = m->tables[from->table],
                                     .preintegrated = m->brdfs[from->table] };
    else
        *material = (lmp_material) { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                                     .dielectric = { true,
                                                     { at_most_one(from->f0[0] * tint.r) * weight,
                                                       at_most_one(from->f0[1] * tint.g) * weight,
                                                       at_most_one(from->f0[2] * tint.b) * weight },
                                                     weight } };
}

void render_material_cover(const render_materials *m, lmp_coat coat, lmp_rgb sheen,
                           float sheen_roughness, lmp_material *material) {
    material->coat = coat;
    if (m->sheen_tables[0] && (sheen.r > 0 || sheen.g > 0 || sheen.b > 0))
        material->sheen = (lmp_sheen_layer) { sheen, sheen_roughness, m->sheen_tables };
}

lmp_material render_material_matte(lmp_rgb color) {
    return (lmp_material) { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                            .base_color = color,
                            .roughness = 1,
                            .dielectric = { .given = true } };
}

unsigned render_materials_sheens(const render_materials *m) {
    unsigned count = 0;
    for (size_t i = 0; i < m->count; i++)
        count += m->of[i].sheen && m->of[i].table < 0;
    return count;
}

void render_materials_note_sheen(render_materials *m, bool drawn) {
    const scene_unsupported sheen = { "sheen", "material", render_materials_sheens(m) };
    char text[64];
    if (drawn || sheen.count == 0 || m->sheen_noted)
        return;
    scene_unsupported_text(&sheen, text, sizeof text);
    base_note(NULL, "left out: %s", text);
    m->sheen_noted = true;
}
