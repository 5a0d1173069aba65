/* SPDX-License-Identifier: MIT */
/* The view of a scene without cameras: sixty shapes, each from where a person would stand. */
#include "app/scene/environment.h"
#include "app/scene/space.h"

#include "tests/oracle/check.h"
#include "tests/program/shapes.h"

#include <stdlib.h>

#define REVOLVE(s, at, from, to, ...)                                                              \
    shape_revolve(s, at, (const float[][2]) { __VA_ARGS__ },                                       \
                  sizeof((const float[][2]) { __VA_ARGS__ }) / sizeof(float[2]), from, to)

static const lmp_vec3 here = { 0, 0, 0 };

static void block(shape *s, float x, float y, float z, float wide, float high, float deep) {
    shape_box(s, vec(x - wide / 2, y, z - deep / 2), vec(x + wide / 2, y + high, z + deep / 2),
              false, 0);
}

/* --- things: round ones ----------------------------------------------------------------------- */

static void torus(shape *s, int kind) {
    float profile[33][2];
    const float thick[] = { 0.15f, 0.35f, 0.6f, 0.35f };
    for (int i = 0; i <= 32; i++) {
        const double angle = 2 * 3.14159265358979 * i / 32;
        profile[i][0] = 1 + thick[kind] * (float)cos(angle);
        profile[i][1] = thick[kind] * (float)sin(angle);
    }
    shape_revolve(s, here, (const float(*)[2])profile, 33, 0, 64);
    if (kind == 3)
        shape_lie(s);
}

static void tube(shape *s, int kind) {
    const float length = kind == 2 ? 0.3f : 3;
    REVOLVE(s, here, 0, 64, { 0.8f, length }, { 0.8f, -length }, { 1, -length }, { 1, length },
            { 0.8f, length });
    if (kind > 0)
        shape_lie(s);
}

/* Makes part of a ball's shell, open below `from` and above `to` (sines of the elevation). */
static void shell(shape *s, float inner, float from, float to, int first, int last) {
    float profile[66][2];
    for (int i = 0; i < 33; i++) {
        const float y = from + (to - from) * (float)i / 32, across = sqrtf(fmaxf(0, 1 - y * y));
        profile[i][0] = across;
        profile[i][1] = y;
        profile[65 - i][0] = inner * across;
        profile[65 - i][1] = inner * y;
    }
    shape_revolve(s, here, (const float(*)[2])profile, 66, first, last);
}

static void helmet(shape *s, int kind) {
    const float inner[] = { 0.98f, 0.9f, 0.85f, 0.95f }, low[] = { -0.5f, -0.8f, -0.3f, -0.95f };
    shell(s, inner[kind], low[kind], 1, kind == 3 ? 0 : 4, kind == 3 ? 64 : 60);
    if (kind == 1)
        block(s, 1.02f, -0.2f, 0, 0.05f, 0.3f, 0.6f);
}

static void shield(shape *s, int kind) {
    shell(s, 0.97f, kind == 2 ? -1 : 0.8f, kind == 2 ? -0.7f : 1, 0, 64);
    if (kind == 1)
        shape_lie(s);
}

static void bowl(shape *s, int kind) {
    if (kind ==
        0) /* a bowl, a dome, an egg with its top cut off, a vase with a neck, a bottle, a jar */
        shell(s, 0.93f, -1, 0.1f, 0, 64);
    else if (kind == 1)
        shell(s, 0.93f, 0, 1, 0, 64);
    else if (kind == 2)
        shell(s, 0.93f, -1, 0.7f, 0, 64);
    else if (kind == 3)
        REVOLVE(s, here, 0, 64, { 0, 0 }, { 0.9f, 0 }, { 1.2f, 1.5f }, { 0.3f, 2.4f }, { 0.4f, 3 },
                { 0.32f, 3 }, { 0.22f, 2.4f }, { 1.1f, 1.5f }, { 0.85f, 0.1f }, { 0, 0.1f });
    else if (kind == 4)
        REVOLVE(s, here, 0, 64, { 0, 0 }, { 0.5f, 0 }, { 0.5f, 2 }, { 0.15f, 2.5f }, { 0.15f, 3 },
                { 0, 3 });
    else
        REVOLVE(s, here, 0, 64, { 0, 0 }, { 1, 0 }, { 1, 2 }, { 0, 2 }, { 0, 1.9f }, { 0.9f, 1.9f },
                { 0.9f, 0.1f }, { 0, 0.1f });
}

static void well(shape *s, int kind) {
    const float high = kind == 1 ? 3 : 0.8f;
    REVOLVE(s, here, 0, 64, { 0, 0 }, { 1, 0 }, { 1, high }, { 0.75f, high }, { 0.75f, 0.05f },
            { 0, 0.05f });
    if (kind == 2)
        return;
    block(s, -0.9f, 0, 0, 0.1f, high + 1.4f, 0.1f);
    block(s, 0.9f, 0, 0, 0.1f, high + 1.4f, 0.1f);
    REVOLVE(s, vec(0, high + 1.3f, 0), 0, 64, { 1.4f, 0 }, { 0, 0.8f });
    REVOLVE(s, vec(0, high + 1.3f, 0), 0, 64, { 0, 0.7f }, { 1.4f, -0.1f });
}

/* Makes a beam along z with as many sides as a pencil, and one that is round. */
static void pencil(shape *s, int kind) {
    const int sides = kind == 0 ? 8 : 32;
    const double part = 2 * 3.14159265358979 / sides;
    for (int i = 0; i < sides; i++) {
        const double a = part * (i + 0.5), b = part * (i + 1.5);
        const float x[2] = { (float)cos(a), (float)cos(b) },
                    y[2] = { (float)sin(a), (float)sin(b) };
        const lmp_vec3 quad[4] = {
            { x[0], y[0], 39 }, { x[0], y[0], -39 }, { x[1], y[1], -39 }, { x[1], y[1], 39 }
        };
        shape_quad(s, quad, false);
        shape_triangle(s, vec(0, 0, 39), quad[0], quad[3]);
        shape_triangle(s, vec(0, 0, -39), quad[2], quad[1]);
    }
}

/* Makes a tall box and a small one far beside it. */
static void boards(shape *s, int kind) {
    (void)kind;
    block(s, 0, 0, 0, 0.1f, 0.74f, 0.1f);
    block(s, -0.55f, -0.34f, -0.2f, 0.07f, 0.19f, 0.12f);
}

/* --- things: with corners --------------------------------------------------------------------- */

/* Makes bodies with an inside: a floor, seats, and windows all around. */
static void car(shape *s, int kind) {
    const float length = kind == 2 ? 5 : 2, roof = kind == 1 ? 0.9f : 1.5f;
    const lmp_vec3 low = vec(-0.9f, 0.3f, -length), high = vec(0.9f, 0.9f, length);
    const float thin = kind == 3 ? 0.15f : 0.04f;
    shape_box(s, low, high, false, 1 << 3);
    shape_box(s, vec(low.x + thin, low.y + thin, low.z + thin),
              vec(high.x - thin, high.y, high.z - thin), true, 1 << 3);
    if (kind != 1) {
        block(s, 0, roof, 0, 1.8f, 0.05f, 2 * length);
        for (int post = 0; post < 6; post++)
            block(s, post % 2 ? 0.86f : -0.86f, 0.9f, length * 0.97f * (float)(post / 2 - 1), 0.08f,
                  roof - 0.9f, kind == 3 ? 1.2f : 0.1f);
    }
    for (int seat = 0; seat < (kind == 2 ? 16 : 4); seat++) {
        const float x = seat % 2 ? 0.4f : -0.4f, z = (float)(seat / 2) - length + 1;
        block(s, x, 0.35f, z, 0.5f, 0.3f, 0.5f);
        block(s, x, 0.6f, z - 0.25f, 0.5f, 0.6f, 0.08f);
    }
    for (int wheel = 0; wheel < 4; wheel++)
        block(s, wheel % 2 ? 1 : -1, 0, wheel / 2 ? 1.2f : -1.2f, 0.2f, 0.6f, 0.6f);
}

static void crate(shape *s, int kind) {
    const int open = kind == 1 ? 1 << 3 : 0;
    shape_box(s, vec(-1, 0, -1), vec(1, 1, 1), false, open);
    if (kind > 0)
        shape_box(s, vec(-0.9f, 0.1f, -0.9f), vec(0.9f, kind == 1 ? 1 : 0.9f, 0.9f), true, open);
}

static void cottage(shape *s, int kind) {
    block(s, 0, 0, 0, 6, 3, 8);
    for (int side = -1; side <= 1; side += 2) {
        const float x = 3.4f * (float)side;
        const lmp_vec3 roof[4] = {
            { x, 2.8f, -4.2f }, { x, 2.8f, 4.2f }, { 0, 5, 4.2f }, { 0, 5, -4.2f }
        };
        shape_quad(s, roof, side > 0);
    }
    if (kind > 0) /* with rooms inside */
        shape_box(s, vec(-2.8f, 0.1f, -3.8f), vec(2.8f, 2.9f, kind == 1 ? 3.8f : 0), true, 0);
    if (kind == 2)
        shape_box(s, vec(-2.8f, 0.1f, 0.1f), vec(2.8f, 2.9f, 3.8f), true, 0);
}

static void furniture(shape *s, int kind) {
    if (kind == 0) { /* a table, stairs, a shelf, a tree, two balls */
        block(s, 0, 0.7f, 0, 2, 0.06f, 1);
        for (int leg = 0; leg < 4; leg++)
            block(s, leg % 2 ? 0.9f : -0.9f, 0, leg / 2 ? 0.4f : -0.4f, 0.06f, 0.7f, 0.06f);
    } else if (kind == 1) {
        for (int step = 0; step < 12; step++)
            block(s, 0, 0.2f * (float)step, -0.3f * (float)step, 1, 0.2f, 0.3f);
    } else if (kind == 2) {
        shape_box(s, vec(-1, 0, -0.2f), vec(1, 2, 0.2f), false, 1 << 5);
        shape_box(s, vec(-0.95f, 0.05f, -0.15f), vec(0.95f, 1.95f, 0.2f), true, 1 << 5);
        for (int board = 1; board < 5; board++)
            block(s, 0, 0.4f * (float)board, 0.02f, 1.9f, 0.03f, 0.34f);
    } else if (kind == 3) {
        block(s, 0, 0, 0, 0.3f, 2, 0.3f);
        for (int leaf = 0; leaf < 400; leaf++) {
            const float x = (float)(leaf % 7 - 3) * 0.3f, y = 2 + (float)(leaf / 7 % 8) * 0.25f,
                        z = (float)(leaf / 56 - 3) * 0.3f;
            shape_triangle(s, vec(x, y, z), vec(x + 0.2f, y + 0.1f, z), vec(x, y, z + 0.2f));
        }
    } else {
        REVOLVE(s, vec(-2, 0, 0), 0, 64, { 0, -1 }, { 0.7f, -0.7f }, { 1, 0 }, { 0.7f, 0.7f },
                { 0, 1 });
        REVOLVE(s, vec(2, 0, 0), 0, 64, { 0, -1 }, { 0.7f, -0.7f }, { 1, 0 }, { 0.7f, 0.7f },
                { 0, 1 });
    }
}

/* --- places ----------------------------------------------------------------------------------- */

/* Makes rooms, of which nothing should be seen from outside. */
static void room(shape *s, int kind) {
    const float size[][3] = { { 4, 3, 5 },   { 20, 4, 30 }, { 2.5f, 3, 25 }, { 6, 3, 8 },
                              { 12, 6, 12 }, { 5, 3, 5 },   { 8, 30, 8 },    { 6, 3, 6 } };
    const float x = size[kind][0] / 2, z = size[kind][2] / 2;
    shape_box(s, vec(-x, 0, -z), vec(x, size[kind][1], z), true, kind == 5 ? 1 << 1 : 0);
    for (int i = 0; i < 6 && kind == 3; i++)
        block(s, (float)(i % 3 - 1) * 1.8f, 0, (float)(i / 3) * 3 - 1.5f, 0.8f, 0.9f, 1.4f);
    for (int i = 0; i < 16 && kind == 4; i++)
        block(s, (float)(i % 4) * 2.5f - 3.75f, 0, (float)(i / 4) * 2.5f - 3.75f, 0.5f, 6, 0.5f);
    if (kind == 5) { /* a wall with a window, and the rest of the wall around it */
        const float walls[4][4] = {
            { -z, z, 0, 1 }, { -z, z, 2, 3 }, { -z, -1, 1, 2 }, { 1, z, 1, 2 }
        };
        for (int i = 0; i < 4; i++) {
            const float *w = walls[i];
            const lmp_vec3 quad[4] = {
                { x, w[2], w[0] }, { x, w[3], w[0] }, { x, w[3], w[1] }, { x, w[2], w[1] }
            };
            shape_quad(s, quad, true);
        }
    }
    if (kind == 7) /* and a second room beside the first */
        shape_box(s, vec(x + 0.2f, 0, -z), vec(3 * x, 3, z), true, 0);
}

static void sky(shape *s, int kind) {
    (void)kind;
    REVOLVE(s, here, 0, 64, { 0, 1 }, { 0.7f, 0.7f }, { 1, 0 }, { 1, -0.1f }, { 0, -0.1f });
}

/* Makes a box without one of its sides. */
static void stage(shape *s, int side) {
    shape_box(s, vec(-2, 0, -2), vec(2, 3, 2), true, 1 << side);
    block(s, 0.5f, 0, 0.5f, 0.8f, 1.5f, 0.8f);
}

static void dolls(shape *s, int kind) {
    const int open = kind == 0 ? 1 << 5 | 1 << 3 : kind == 1 ? 1 << 1 | 1 << 5 : 1 << 5;
    for (int i = 0; i < 4; i++)
        shape_box(s, vec((float)(i % 2) * 4 - 4, (float)(i / 2) * 3, -2),
                  vec((float)(i % 2) * 4, (float)(i / 2) * 3 + 3, 2), true, open);
}

/* Makes the fronts of four houses around a yard, and what is behind them; in kind 2, walls that one
 * looks over. */
static void courtyard(shape *s, int kind) {
    const float high = kind == 2 ? 1.2f : kind == 1 ? 14 : 10;
    shape_box(s, vec(-8, 0, -10), vec(8, high, 10), true, 1 << 3);
    for (int i = 0; i < 10; i++)
        block(s, i % 2 ? 6.5f : -6.5f, 0, (float)(i / 2) * 4 - 8, 0.6f, 0.8f * high, 0.6f);
    block(s, 0, 0, 0, 2, 1, 2);
}

static void street(shape *s, int kind) {
    shape_box(s, vec(-15, -0.1f, -30), vec(15, 0, 30), false, 0);
    for (int i = 0; i < 12; i++)
        block(s, i % 2 ? 9 : -9, 0, (float)(i / 2) * 10 - 25, 10, kind == 1 ? 25 : 8,
              kind == 2 ? 6 : 10);
}

static float flat(float x, float z) {
    (void)x, (void)z;
    return 0;
}

static float hills(float x, float z) {
    return 0.1f * (float)sin(9 * (double)x) * (float)cos(7 * (double)z);
}

static float valley(float x, float z) {
    (void)z;
    return 0.6f * fabsf(x);
}

static float crater(float x, float z) {
    const float r = sqrtf(x * x + z * z);
    return r < 0.7f ? 0.8f * r * r : 0.8f * 0.49f * fmaxf(0, 1 - 3 * (r - 0.7f));
}

static void terrain(shape *s, int kind) {
    shape_ground(s, 50, kind == 0 ? flat : kind == 1 ? hills : kind == 2 ? valley : crater);
}

/* --- the test --------------------------------------------------------------------------------- */

static const struct {
    const char *name;
    void (*make)(shape *s, int kind);
    int count;
    const char *inside; /* expected framing of each kind: i for inside, o for outside */
} shapes[] = {
    { "torus", torus, 4, "oooo" },    { "tube", tube, 3, "ooo" },
    { "helmet", helmet, 4, "oooo" },  { "shield", shield, 3, "ooo" },
    { "bowl", bowl, 6, "oooooo" },    { "well", well, 3, "ooo" },
    { "car", car, 4, "oooo" },        { "crate", crate, 3, "ooo" },
    { "cottage", cottage, 3, "ooo" }, { "furniture", furniture, 5, "ooooo" },
    { "room", room, 8, "iiiiiiii" },  { "sky", sky, 1, "i" },
    { "stage", stage, 6, "oooioo" }, /* the fourth lacks only its roof, as a yard does */
    { "dolls", dolls, 3, "ooo" },     { "courtyard", courtyard, 3, "iio" },
    { "street", street, 3, "ooo" },   { "terrain", terrain, 4, "oooo" },
};

static void sixty_shapes_are_seen_from_where_a_person_would_stand(void **state) {
    (void)state;
    shape *s = malloc(sizeof *s);
    int tried = 0;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        for (int kind = 0; kind < shapes[i].count; kind++) {
            shape_clear(s);
            shapes[i].make(s, kind);
            const scene world = shape_scene(s);
            const bool inside = scene_is_inside(&world);
            if (inside != (shapes[i].inside[kind] == 'i'))
                fail_msg("%s %d is seen from %s", shapes[i].name, kind,
                         inside ? "inside" : "outside");
            tried++;
        }
    free(s);
    print_message("tried: %d shapes\n", tried);
}

/* Objects that show their backs are no rooms, unless they have a level floor and much space. */
static void objects_inside_out_are_seen_from_outside(void **state) {
    (void)state;
    static const struct {
        const char *name;
        void (*make)(shape *s, int kind);
        int first, count;
    } objects[] = { { "torus", torus, 0, 4 },   { "tube", tube, 1, 2 },
                    { "helmet", helmet, 0, 4 }, { "shield", shield, 0, 3 },
                    { "bowl", bowl, 0, 4 },     { "well", well, 0, 2 },
                    { "car", car, 0, 4 },       { "pencil", pencil, 0, 2 },
                    { "boards", boards, 0, 1 } };
    shape *s = malloc(sizeof *s);
    scene_material material = scene_material_plain();
    material.flags |= SCENE_DOUBLE_SIDED;
    for (size_t i = 0; i < sizeof objects / sizeof *objects; i++)
        for (int kind = objects[i].first; kind < objects[i].first + objects[i].count; kind++) {
            shape_clear(s);
            objects[i].make(s, kind);
            shape_invert(s);
            scene world = shape_scene(s);
            scene_frame frame = { .wanted = SCENE_FRAMING_AUTO };
            world.frame = &frame;
            world.materials = &material;
            world.material_count = 1;
            if (scene_is_inside(&world))
                fail_msg("%s %d is seen from inside", objects[i].name, kind);
            assert_true(environment_suits_shadows(true, &world));
        }
    free(s);
}

/* A box without one wall is framed from that side, and shows its inside. */
static void a_box_is_looked_into_from_where_it_is_open(void **state) {
    (void)state;
    static const struct {
        int side;
        float way[2];
    } cases[] = { { 0, { -1, 0 } }, { 1, { 1, 0 } }, { 4, { 0, -1 } }, { 5, { 0, 1 } } };
    shape *s = malloc(sizeof *s);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        shape_clear(s);
        stage(s, cases[i].side);
        const scene world = shape_scene(s);
        const scene_camera camera = scene_default_camera(&world, 1.5f);
        const float along = (camera.eye[0] - camera.target[0]) * cases[i].way[0] +
                            (camera.eye[2] - camera.target[2]) * cases[i].way[1];
        const float across = (camera.eye[0] - camera.target[0]) * cases[i].way[1] +
                             (camera.eye[2] - camera.target[2]) * cases[i].way[0];
        assert_true(along > 2 * fabsf(across));
    }
    free(s);
}

/* The sky reaches what is seen of every shape from outside, except of a box without a floor, whose
 * inside is seen through walls that show their backs: shadows do not suit that one. */
static void the_sky_reaches_what_is_seen_from_outside(void **state) {
    (void)state;
    shape *s = malloc(sizeof *s);
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        for (int kind = 0; kind < shapes[i].count; kind++) {
            shape_clear(s);
            shapes[i].make(s, kind);
            scene world = shape_scene(s);
            scene_frame frame = { .wanted = SCENE_FRAMING_AUTO };
            world.frame = &frame;
            const bool floorless = shapes[i].make == stage && kind == 2;
            const bool outside = !scene_is_inside(&world);
            if (outside && (frame.sky < 0.1f) != floorless)
                fail_msg("%s %d: %g of the sky", shapes[i].name, kind, (double)frame.sky);
            assert_int_equal(environment_suits_shadows(true, &world), outside && !floorless);
            assert_true(environment_suits_shadows(false, &world));
            /* Nor is it added to a sun where it reaches nothing. */
            scene_light sun = { .emitter = { .kind = LMP_LIGHT_DIRECTIONAL,
                                             .direction = { 0, 1, 0 },
                                             .irradiance = { 1, 1, 1 } } };
            world.lights = &sun;
            world.light_count = 1;
            assert_string_equal(
                environment_choose(&(environment_options)ENVIRONMENT_DEFAULTS, &world).name,
                outside && !floorless ? "studio" : "none");
        }
    free(s);
}

/* A framing that is chosen overrides the shape's and the file's camera; but for inside, the file's
 * camera is taken if it stands inside. */
static void the_framing_that_is_chosen_is_taken(void **state) {
    (void)state;
    shape *s = malloc(sizeof *s);
    shape_clear(s);
    room(s, 0);
    scene_camera own = {
        .name = "own", .eye = { 0, 1, 1 }, .target = { 0, 1, 0 }, .up = { 0, 1, 0 }
    };
    for (int cameras = 0; cameras < 2; cameras++)
        for (int wanted = SCENE_FRAMING_AUTO; wanted <= SCENE_FRAMING_INSIDE; wanted++) {
            scene world = shape_scene(s);
            scene_frame frame = { .wanted = (scene_framing)wanted };
            world.frame = &frame;
            world.cameras = &own;
            world.camera_count = (size_t)cameras;
            const scene_camera camera = scene_default_camera(&world, 1.5f);
            assert_int_equal(scene_is_inside(&world), wanted != SCENE_FRAMING_OUTSIDE);
            assert_string_equal(camera.name, wanted == SCENE_FRAMING_OUTSIDE ? "framed"
                                             : cameras                       ? "own"
                                                                             : "inside");
        }
    free(s);
}

/* In a yard on a wide plain, all lights are in front of the camera that stands in it, clear of its
 * walls. */
static void random_lights_are_where_the_camera_of_a_large_scene_looks(void **state) {
    (void)state;
    const scene_camera own = {
        .name = "own", .eye = { 0, 2, 8 }, .target = { 0, 2, 0 }, .up = { 0, 1, 0 }, .fov = 0.9f
    };
    shape *s = malloc(sizeof *s);
    shape_clear(s);
    courtyard(s, 0);
    shape_box(s, vec(-400, -0.1f, -400), vec(400, -0.05f, 400), false, 0);
    scene world = shape_scene(s);
    base_error error;
    world.cameras = &own;
    world.camera_count = 1;
    world.lights = calloc(SCENE_LIGHTS_MAX, sizeof *world.lights);
    assert_true(scene_add_random_lights(&world, 30, 3, &error));
    for (size_t i = 0; i < world.light_count; i++) {
        const lmp_light *light = &world.lights[i].emitter;
        assert_true(fabsf(light->position.x) < 8 && fabsf(light->position.z) < 10);
        assert_true(light->position.z < own.eye[2] && light->position.y > 0);
        assert_true(light->radius < 1);
    }
    free(world.lights);
    free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sixty_shapes_are_seen_from_where_a_person_would_stand),
        cmocka_unit_test(objects_inside_out_are_seen_from_outside),
        cmocka_unit_test(a_box_is_looked_into_from_where_it_is_open),
        cmocka_unit_test(the_sky_reaches_what_is_seen_from_outside),
        cmocka_unit_test(the_framing_that_is_chosen_is_taken),
        cmocka_unit_test(random_lights_are_where_the_camera_of_a_large_scene_looks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
