/* SPDX-License-Identifier: MIT */
/* room.c - builtin:room, a living room lit by one light of each shape: a ceiling panel, a neon
 * tube, a window and a lamp. */
#include "app/scene/builtin/builtin.h"
#include "app/scene/builtin/shape.h"
#include "app/scene/builtin/stage.h"
#include "app/scene/random.h"
#include "app/scene/vector.h"

/* The room is 6 x 2.8 x 6 m, its floor around the origin. */
#define HALF   3.0f
#define HEIGHT 2.8f

/* The window in the left wall, between two heights and two depths, with a round top. */
static const float window_low = 0.8f, window_spring = 1.9f, window_top = 2.3f;
static const float window_middle = 0.8f, window_half = 0.65f;

static void put_walls(scene_shaper *shaper) {
    const lmp_vec3 low[4] = {
        { -HALF, 0, HALF }, { HALF, 0, HALF }, { HALF, 0, -HALF }, { -HALF, 0, -HALF }
    };
    lmp_vec3 high[4];
    for (int i = 0; i < 4; i++)
        high[i] = vec_add(low[i], vec(0, HEIGHT, 0));
    shaper->material =
        stage_material(shaper->builder, "floor", (lmp_rgb) { 0.24f, 0.14f, 0.08f }, 0.3f, 0);
    shape_quad(shaper, low[0], low[1], low[2], low[3]);
    shaper->material =
        stage_material(shaper->builder, "ceiling", (lmp_rgb) { 0.8f, 0.8f, 0.78f }, 0.95f, 0);
    shape_quad(shaper, high[3], high[2], high[1], high[0]);
    shaper->material =
        stage_material(shaper->builder, "wall", (lmp_rgb) { 0.66f, 0.63f, 0.58f }, 0.9f, 0);
    for (int i = 0; i < 4; i++)
        shape_quad(shaper, low[(i + 1) % 4], low[i], high[i], high[(i + 1) % 4]);
}

static void put_skirting(scene_shaper *shaper) {
    static const shape_point profile[] = { { 0.016f, 0 }, { 0.012f, 0.08f }, { 0, 0.09f } };
    shaper->material =
        stage_material(shaper->builder, "skirting", (lmp_rgb) { 0.7f, 0.68f, 0.64f }, 0.5f, 0);
    for (shaper->quarters = 0; shaper->quarters < 4; shaper->quarters++)
        shape_sweep(shaper, profile, 3, vec(0, 0, -HALF), -HALF, HALF);
    shaper->quarters = 0;
}

/* A sill, and bars that divide the window. */
static void put_window(scene_shaper *shaper) {
    const float x = -HALF, near = window_middle + window_half, far = window_middle - window_half;
    shape_box(shaper, vec(x, window_low - 0.06f, far - 0.1f),
              vec(x + 0.16f, window_low, near + 0.1f));
    shape_box(shaper, vec(x, window_spring - 0.02f, far),
              vec(x + 0.05f, window_spring + 0.02f, near));
    shape_box(shaper, vec(x, window_low, window_middle - 0.02f),
              vec(x + 0.05f, window_top, window_middle + 0.02f));
}

static void put_table(scene_shaper *shaper) {
    const lmp_vec3 low = { 0.55f, 0, -1.55f }, high = { 2.35f, 0.75f, -0.55f };
    const float leg = 0.07f, inset = 0.06f, top = 0.05f;
    shaper->material =
        stage_material(shaper->builder, "wood", (lmp_rgb) { 0.30f, 0.17f, 0.09f }, 0.4f, 0);
    shape_box(shaper, vec(low.x, high.y - top, low.z), high);
    for (int i = 0; i < 4; i++) {
        const float x = i % 2 ? high.x - inset - leg : low.x + inset;
        const float z = i / 2 ? high.z - inset - leg : low.z + inset;
        shape_box(shaper, vec(x, 0, z), vec(x + leg, high.y - top, z + leg));
    }
}

static void put_sofa(scene_shaper *shaper) {
    const float left = -2.35f, right = -0.05f, back = -2.7f, front = -1.75f, arm = 0.22f;
    shaper->material =
        stage_material(shaper->builder, "fabric", (lmp_rgb) { 0.06f, 0.16f, 0.22f }, 0.95f, 0);
    shape_box(shaper, vec(left, 0.06f, back), vec(right, 0.4f, front));
    shape_box(shaper, vec(left + arm, 0.4f, back), vec(right - arm, 0.9f, back + 0.25f));
    shape_box(shaper, vec(left, 0.4f, back), vec(left + arm, 0.62f, front));
    shape_box(shaper, vec(right - arm, 0.4f, back), vec(right, 0.62f, front));
    shaper->material =
        stage_material(shaper->builder, "cushion", (lmp_rgb) { 0.55f, 0.25f, 0.06f }, 0.95f, 0);
    shape_box(shaper, vec(left + arm + 0.08f, 0.4f, -2.43f), vec(left + arm + 0.5f, 0.8f, -2.3f));
}

static void put_shelf(scene_shaper *shaper) {
    const float x = HALF - 0.36f, near = 1.5f, far = 0.2f, board = 0.035f;
    shaper->material =
        stage_material(shaper->builder, "shelf", (lmp_rgb) { 0.38f, 0.24f, 0.13f }, 0.5f, 0);
    shape_box(shaper, vec(x, 0, far - board), vec(HALF, 2.0f, far));
    shape_box(shaper, vec(x, 0, near), vec(HALF, 2.0f, near + board));
    for (int i = 0; i < 5; i++) {
        const float y = 0.05f + 0.48f * (float)i;
        shape_box(shaper, vec(x, y, far), vec(HALF, y + board, near));
    }
    static const lmp_rgb cloths[] = { { 0.42f, 0.08f, 0.06f },
                                      { 0.08f, 0.14f, 0.30f },
                                      { 0.5f, 0.42f, 0.28f } };
    uint64_t random = 5;
    for (int cloth = 0; cloth < 3; cloth++) {
        static const char *const names[] = { "red book", "blue book", "pale book" };
        shaper->material = stage_material(shaper->builder, names[cloth], cloths[cloth], 0.6f, 0);
        for (int shelf = 0; shelf < 4; shelf++) {
            float z = far + 0.02f + 0.4f * (float)((cloth + shelf) % 3);
            const float y = 0.05f + 0.48f * (float)shelf + board;
            for (int i = 0; i < 8 - shelf; i++) {
                const float thick = 0.025f + 0.025f * random_unit(&random);
                const float tall = 0.24f + 0.14f * random_unit(&random);
                shape_box(shaper, vec(x + 0.06f, y, z), vec(HALF - 0.06f, y + tall, z + thick));
                z += thick + 0.003f;
            }
        }
    }
}

static void put_vase(scene_shaper *shaper) {
    static const shape_point vase[] = { { 0, 0 },         { 0.09f, 0 },      { 0.1f, 0.015f },
                                        { 0.15f, 0.12f }, { 0.16f, 0.2f },   { 0.13f, 0.29f },
                                        { 0.07f, 0.36f }, { 0.055f, 0.41f }, { 0.08f, 0.46f },
                                        { 0.07f, 0.46f }, { 0.045f, 0.41f }, { 0, 0.40f } };
    const lmp_vec3 low = { -2.7f, 0, -1.0f }, high = { -2.2f, 0.9f, -0.5f };
    shaper->material =
        stage_material(shaper->builder, "plinth", (lmp_rgb) { 0.72f, 0.70f, 0.66f }, 0.35f, 0);
    shape_box(shaper, low, high);
    shaper->material =
        stage_material(shaper->builder, "gold", (lmp_rgb) { 0.95f, 0.64f, 0.30f }, 0.25f, 1);
    shape_revolve(shaper, &(shape_revolution) { .profile = vase,
                                                .point_count = sizeof vase / sizeof *vase,
                                                .origin = { 0.5f * (low.x + high.x), high.y,
                                                            0.5f * (low.z + high.z) },
                                                .axis = 'y',
                                                .segments = 64 });
}

static void put_rug(scene_shaper *shaper) {
    shaper->material =
        stage_material(shaper->builder, "rug", (lmp_rgb) { 0.33f, 0.07f, 0.06f }, 1, 0);
    shape_box(shaper, vec(-1.5f, 0, -1.5f), vec(1.4f, 0.012f, 0.9f));
}

/* The foot of the lamp on the table. */
static void put_lamp(scene_shaper *shaper, lmp_vec3 globe, float radius) {
    const float foot = 0.75f, neck = globe.y - radius - foot + 0.01f;
    const shape_point profile[] = {
        { 0, 0 },        { 0.09f, 0 },    { 0.09f, 0.012f },       { 0.02f, 0.025f },
        { 0.02f, neck }, { 0.04f, neck }, { 0.04f, neck + 0.01f }, { 0, neck + 0.01f }
    };
    shaper->material =
        stage_material(shaper->builder, "brass", (lmp_rgb) { 0.78f, 0.57f, 0.25f }, 0.3f, 1);
    shape_revolve(shaper, &(shape_revolution) { .profile = profile,
                                                .point_count = sizeof profile / sizeof *profile,
                                                .origin = { globe.x, foot, globe.z },
                                                .axis = 'y',
                                                .segments = 48 });
}

/* Adds the window, an opening with a round top: corners counter-clockwise seen from the room. */
static void add_window(scene_builder *builder) {
    const float middle = 0.4f * window_half, down = window_low - window_spring,
                up = window_top - window_spring;
    lmp_light window = { .kind = LMP_LIGHT_POLYGON,
                         /* beside the bars, because what is inside of something lights nothing */
                         .position = { -HALF + 0.005f, window_spring + 0.5f * down,
                                       window_middle + middle },
                         .corner_count = LMP_LIGHT_CORNERS_MAX,
                         .radiance = { 2.6f, 3.9f, 6.2f } };
    const float base = 0.5f * down, spring = -0.5f * down;
    window.corner[0] = (lmp_vec3) { 0, base, -window_half - middle };
    for (int i = 0; i < 6; i++) {
        const float angle = PI * (float)i / 5.0f;
        window.corner[1 + i] =
            (lmp_vec3) { 0, spring + up * sinf(angle), -window_half * cosf(angle) - middle };
    }
    window.corner[7] = (lmp_vec3) { 0, base, window_half - middle };
    stage_light(builder, window);
}

void builtin_room(const builtin_parameters *parameters, scene_builder *builder) {
    (void)parameters;
    const lmp_vec3 globe = { 1.85f, 1.12f, -1.05f };
    const float radius = 0.17f;
    scene_shaper shaper = { .builder = builder };
    put_walls(&shaper);
    put_skirting(&shaper);
    put_window(&shaper);
    put_table(&shaper);
    put_sofa(&shaper);
    put_shelf(&shaper);
    put_vase(&shaper);
    put_rug(&shaper);
    put_lamp(&shaper, globe, radius);
    shaper_finish(&shaper);
    stage_light(builder, (lmp_light) { .kind = LMP_LIGHT_RECTANGLE,
                                       .position = { 0.3f, HEIGHT - 0.005f, 0.3f },
                                       .half = { { 0.6f, 0, 0 }, { 0, 0, 0.3f } },
                                       .radiance = { 9, 8, 6.6f } });
    stage_light(builder, (lmp_light) { .kind = LMP_LIGHT_TUBE,
                                       .position = { -1.2f, 1.85f, -HALF + 0.09f },
                                       .half = { { 0.8f, 0, 0 } },
                                       .radius = 0.025f,
                                       .radiance = { 60, 9, 36 } });
    add_window(builder);
    stage_light(builder,
                (lmp_light) { .position = globe, .radius = radius, .radiance = { 19, 11, 4.6f } });
    stage_camera(builder, "from the door", vec(1.5f, 1.55f, 2.85f), vec(-0.5f, 1.05f, -1.6f), 1.15f,
                 1.78f);
}
