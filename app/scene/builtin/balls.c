/* SPDX-License-Identifier: MIT */
/* balls.c - builtin:balls, a row of spheres from matte to glossy, and builtin:ball, a preview. */
#include "app/scene/builtin/builtin.h"
#include "app/scene/builtin/shape.h"
#include "app/scene/builtin/stage.h"
#include "app/scene/vector.h"

#include <stdio.h>

static void put_sphere(scene_shaper *shaper, lmp_vec3 center, float radius, int segments) {
    shape_point profile[65];
    const int rings = 64;
    for (int i = 0; i <= rings; i++) {
        const float angle = PI * (float)i / (float)rings;
        profile[i] = (shape_point) { radius * sinf(angle), -radius * cosf(angle) };
    }
    profile[0].r = profile[rings].r = 0.0f;
    shape_revolve(shaper, &(shape_revolution) { .profile = profile,
                                                .point_count = rings + 1,
                                                .origin = center,
                                                .axis = 'y',
                                                .segments = segments });
}

/* Adds a floor that bends up into a wall behind, as photographers use. */
static void sweep_backdrop(scene_shaper *shaper, float front, float back, float bend, float height,
                           float half_width) {
    shape_point profile[20];
    int count = 0;
    profile[count++] = (shape_point) { front, 0.0f };
    for (int i = 0; i <= 16; i++) {
        const float angle = 0.5f * PI * (float)i / 16.0f;
        profile[count++] =
            (shape_point) { back + bend - bend * sinf(angle), bend - bend * cosf(angle) };
    }
    profile[count++] = (shape_point) { back, height };
    shape_sweep(shaper, profile, count, vec(0.0f, 0.0f, 0.0f), -half_width, half_width);
}

void builtin_balls(const builtin_parameters *parameters, scene_builder *builder) {
    (void)parameters;
    enum { BALLS = 7 };
    scene_shaper shaper = { .builder = builder };
    shaper.material =
        stage_material(builder, "backdrop", (lmp_rgb) { 0.42f, 0.40f, 0.38f }, 0.85f, 0.0f);
    sweep_backdrop(&shaper, 9.0f, -5.0f, 2.0f, 11.0f, 16.0f);
    for (int i = 0; i < BALLS; i++) {
        const float step = (float)i / (float)(BALLS - 1), x = 1.25f * ((float)i - 3.0f);
        char name[32];
        snprintf(name, sizeof name, "plastic %.2f", (double)(1.0f - 0.85f * step));
        shaper.material = stage_material(builder, name, (lmp_rgb) { 0.55f, 0.10f, 0.06f },
                                         1.0f - 0.85f * step, 0.0f);
        put_sphere(&shaper, vec(x, 0.55f, 0.0f), 0.55f, 96);
        /* in front, between two spheres, a darker one of the same gloss */
        if (i + 1 == BALLS)
            break;
        snprintf(name, sizeof name, "glaze %.2f", (double)(1.0f - 0.85f * step));
        shaper.material = stage_material(builder, name, (lmp_rgb) { 0.03f, 0.16f, 0.20f },
                                         1.0f - 0.85f * step, 0.0f);
        put_sphere(&shaper, vec(x + 0.62f, 0.36f, 1.35f), 0.36f, 96);
    }
    shaper_finish(&shaper);
    builder_sphere_light(builder, vec(-3.9f, 2.5f, 0.6f), 0.42f, (lmp_rgb) { 1.0f, 0.56f, 0.20f },
                         190.0f);
    builder_sphere_light(builder, vec(-1.5f, 2.1f, -1.6f), 0.30f, (lmp_rgb) { 1.0f, 0.16f, 0.34f },
                         110.0f);
    builder_sphere_light(builder, vec(0.6f, 5.4f, 2.6f), 0.50f, (lmp_rgb) { 1.0f, 0.90f, 0.76f },
                         330.0f);
    builder_sphere_light(builder, vec(1.7f, 1.9f, -1.9f), 0.30f, (lmp_rgb) { 0.14f, 1.0f, 0.55f },
                         100.0f);
    builder_sphere_light(builder, vec(4.1f, 2.4f, 0.4f), 0.42f, (lmp_rgb) { 0.12f, 0.45f, 1.0f },
                         190.0f);
    stage_camera(builder, "default", vec(0.0f, 2.1f, 8.4f), vec(0.1f, 0.72f, 0.0f), 0.66f, 1.99f);
}

void builtin_ball(const builtin_parameters *parameters, scene_builder *builder) {
    (void)parameters;
    static const shape_point foot[] = { { 0.0f, 0.0f },   { 0.52f, 0.0f },  { 0.52f, 0.06f },
                                        { 0.47f, 0.10f }, { 0.36f, 0.12f }, { 0.32f, 0.16f },
                                        { 0.34f, 0.24f }, { 0.42f, 0.30f }, { 0.0f, 0.30f } };
    scene_shaper shaper = { .builder = builder };
    shaper.material =
        stage_material(builder, "backdrop", (lmp_rgb) { 0.30f, 0.30f, 0.31f }, 0.9f, 0.0f);
    sweep_backdrop(&shaper, 5.0f, -2.6f, 1.6f, 6.0f, 8.0f);
    shaper.material =
        stage_material(builder, "stand", (lmp_rgb) { 0.08f, 0.08f, 0.09f }, 0.5f, 0.0f);
    shape_revolve(&shaper, &(shape_revolution) { .profile = foot,
                                                 .point_count = sizeof foot / sizeof *foot,
                                                 .axis = 'y',
                                                 .segments = 96 });
    shaper.material =
        stage_material(builder, "test_material", (lmp_rgb) { 0.70f, 0.36f, 0.12f }, 0.35f, 0.0f);
    put_sphere(&shaper, vec(0.0f, 1.18f, 0.0f), 1.0f, 192);
    shaper_finish(&shaper);
    /* ten lights on two rings around the ball, warm on the left and cold on the right */
    for (int i = 0; i < 10; i++) {
        const float angle = 2.0f * PI * ((float)(i / 2) + 0.5f) / 5.0f;
        const float height = i % 2 ? 3.3f : 1.7f, ring = i % 2 ? 1.9f : 2.5f;
        const lmp_vec3 center = vec(ring * sinf(angle), height, 0.9f + ring * cosf(angle) * 0.8f);
        const float warm = 0.5f - 0.5f * center.x / ring;
        const lmp_rgb color = { 0.45f + 0.55f * warm, 0.62f + 0.06f * warm, 1.0f - 0.62f * warm };
        builder_sphere_light(builder, center, 0.13f, color, 34.0f);
    }
    stage_camera(builder, "default", vec(0.0f, 1.75f, 6.6f), vec(0.0f, 1.12f, 0.0f), 0.50f, 0.735f);
}
