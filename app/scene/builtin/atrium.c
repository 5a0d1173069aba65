/* SPDX-License-Identifier: MIT */
/* atrium.c - builtin:atrium, a two-storey colonnaded court under a coffered barrel vault, with
 * lanterns. */
#include "app/scene/builtin/atrium.h"
#include "app/scene/builtin/stage.h"

#include "app/scene/vector.h"

/* Appends the materials in the order of `stone`. */
static void add_materials(scene_builder *builder) {
    static const char *const gloss_names[3][4] = {
        { "tile light polished", "tile light honed", "tile light worn", "tile light matte" },
        { "tile dark polished", "tile dark honed", "tile dark worn", "tile dark matte" },
        { "tile accent polished", "tile accent honed", "tile accent worn", "tile accent matte" },
    };
    static const lmp_rgb tile_colors[3] = { { 0.62f, 0.56f, 0.47f },
                                            { 0.055f, 0.07f, 0.075f },
                                            { 0.36f, 0.075f, 0.05f } };
    static const float gloss[4] = { 0.36f, 0.42f, 0.50f, 0.72f };
    /* Metallic fraction: Schlick's 0.04 would hide the lamps' reflections in the floor at real-time
     * bands. */
    static const float sheen[4] = { 0.60f, 0.45f, 0.25f, 0.0f };
    stage_material(builder, "limestone", (lmp_rgb) { 0.46f, 0.38f, 0.29f }, 0.85f, 0.0f);
    stage_material(builder, "marble", (lmp_rgb) { 0.64f, 0.59f, 0.52f }, 0.42f, 0.0f);
    stage_material(builder, "trim", (lmp_rgb) { 0.56f, 0.48f, 0.38f }, 0.65f, 0.0f);
    stage_material(builder, "plaster", (lmp_rgb) { 0.40f, 0.38f, 0.36f }, 0.95f, 0.0f);
    stage_material(builder, "fresco", (lmp_rgb) { 0.42f, 0.09f, 0.06f }, 0.7f, 0.0f);
    stage_material(builder, "dado", (lmp_rgb) { 0.10f, 0.17f, 0.16f }, 0.38f, 0.0f);
    stage_material(builder, "bronze", (lmp_rgb) { 0.52f, 0.33f, 0.16f }, 0.45f, 1.0f);
    stage_material(builder, "baluster", (lmp_rgb) { 0.70f, 0.66f, 0.59f }, 0.5f, 0.0f);
    stage_material(builder, "terracotta", (lmp_rgb) { 0.40f, 0.19f, 0.11f }, 0.6f, 0.0f);
    stage_material(builder, "grout", (lmp_rgb) { 0.16f, 0.14f, 0.12f }, 0.95f, 0.0f);
    for (int color = 0; color < 3; color++)
        for (int i = 0; i < 4; i++)
            stage_material(builder, gloss_names[color][i], tile_colors[color], gloss[i], sheen[i]);
}

void builtin_atrium(const builtin_parameters *parameters, scene_builder *builder) {
    court_plan court = { .shaper = { .builder = builder, .detail = parameters->detail },
                         .bays = BAYS_LONG * parameters->tiles,
                         .random = parameters->seed };
    court.half_length = 0.5f * BAY * (float)court.bays;
    add_materials(builder);
    atrium_put_bays(&court);
    atrium_put_court(&court);
    atrium_hang_lanterns(&court, parameters->lanterns);
    shaper_finish(&court.shaper);
    stage_camera(builder, "down the court", vec(-1.1f, 2.3f, court.half_length - 1.4f),
                 vec(0.35f, 3.9f, court.half_length - 16.0f), 0.92f, 1.6f);
}
