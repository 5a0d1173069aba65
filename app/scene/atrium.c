/* SPDX-License-Identifier: MIT */
/* atrium.c - builtin:atrium, a two-storey colonnaded court under a coffered barrel vault, with
 * lanterns. */
#include "app/scene/atrium.h"

#include "app/scene/vector.h"

static void add_material(scene_builder *builder, const char *name, float r, float g, float b,
                         float roughness, float metallic) {
    scene_material *material = builder_material(builder, name);
    if (!material)
        return;
    vec_store(vec(r, g, b), material->base_color);
    material->roughness = roughness;
    material->metallic = metallic;
}

/* In the order of `stone`. */
static void add_materials(scene_builder *builder) {
    static const char *const gloss_names[3][4] = {
        { "tile light polished", "tile light honed", "tile light worn", "tile light matte" },
        { "tile dark polished", "tile dark honed", "tile dark worn", "tile dark matte" },
        { "tile accent polished", "tile accent honed", "tile accent worn", "tile accent matte" },
    };
    static const float tile_colors[3][3] = { { 0.62f, 0.56f, 0.47f },
                                             { 0.055f, 0.07f, 0.075f },
                                             { 0.36f, 0.075f, 0.05f } };
    static const float gloss[4] = { 0.36f, 0.42f, 0.50f, 0.72f };
    /* Part metal, or Schlick's 0.04 would hide the lamps in the floor at the bands of real time. */
    static const float sheen[4] = { 0.60f, 0.45f, 0.25f, 0.0f };
    add_material(builder, "limestone", 0.46f, 0.38f, 0.29f, 0.85f, 0.0f);
    add_material(builder, "marble", 0.64f, 0.59f, 0.52f, 0.42f, 0.0f);
    add_material(builder, "trim", 0.56f, 0.48f, 0.38f, 0.65f, 0.0f);
    add_material(builder, "plaster", 0.40f, 0.38f, 0.36f, 0.95f, 0.0f);
    add_material(builder, "fresco", 0.42f, 0.09f, 0.06f, 0.7f, 0.0f);
    add_material(builder, "dado", 0.10f, 0.17f, 0.16f, 0.38f, 0.0f);
    add_material(builder, "bronze", 0.52f, 0.33f, 0.16f, 0.45f, 1.0f);
    add_material(builder, "baluster", 0.70f, 0.66f, 0.59f, 0.5f, 0.0f);
    add_material(builder, "terracotta", 0.40f, 0.19f, 0.11f, 0.6f, 0.0f);
    add_material(builder, "grout", 0.16f, 0.14f, 0.12f, 0.95f, 0.0f);
    for (int color = 0; color < 3; color++)
        for (int i = 0; i < 4; i++)
            add_material(builder, gloss_names[color][i], tile_colors[color][0],
                         tile_colors[color][1], tile_colors[color][2], gloss[i], sheen[i]);
}

void builtin_atrium(const builtin_parameters *parameters, scene_builder *builder) {
    court_plan court = { .shaper = { .builder = builder },
                         .bays = BAYS_LONG * parameters->tiles,
                         .random = parameters->seed };
    court.half_length = 0.5f * BAY * (float)court.bays;
    add_materials(builder);
    atrium_put_bays(&court);
    atrium_put_court(&court);
    atrium_hang_lanterns(&court, parameters->lanterns);
    shaper_finish(&court.shaper);
    scene_camera *camera = builder_append(builder, BLOB_CAMERAS, 1);
    if (!camera)
        return;
    scene_clean_name(camera->name, "down the court");
    vec_store(vec(-1.1f, 2.3f, court.half_length - 1.4f), camera->eye);
    vec_store(vec(0.35f, 3.9f, court.half_length - 16.0f), camera->target);
    camera->up[1] = 1.0f;
    camera->fov = 0.92f;
    camera->aspect = 1.6f;
}
