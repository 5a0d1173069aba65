/* SPDX-License-Identifier: MIT */
/* Positions of lights and cameras: in a building, and around what is not one. */
#include "app/scene/space.h"

#include "tests/program/folder.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define HALF 2.0f

/* Writes a cube of side 4 with normals inwards (a room), outwards (a block), or without normals,
 * when it is counter-clockwise as seen from inside or outside. */
static scene write_cube(bool inwards, bool normals) {
    static const int faces[6][4] = { { 1, 2, 4, 3 }, { 5, 7, 8, 6 }, { 1, 5, 6, 2 },
                                     { 3, 4, 8, 7 }, { 1, 3, 7, 5 }, { 2, 6, 8, 4 } };
    static const int outwards[6][3] = { { -1, 0, 0 }, { 1, 0, 0 },  { 0, -1, 0 },
                                        { 0, 1, 0 },  { 0, 0, -1 }, { 0, 0, 1 } };
    char text[1024];
    const int sign = inwards ? -1 : 1;
    size_t used = 0;
    scene s;
    base_error error;
    for (int i = 0; i < 8; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "v %d %d %d\n", i & 4 ? 2 : -2,
                                 i & 2 ? 2 : -2, i & 1 ? 2 : -2);
    for (int i = 0; i < 6; i++) {
        const int *f = faces[i];
        const int second = f[inwards ? 3 : 1], last = f[inwards ? 1 : 3];
        if (normals)
            used += (size_t)snprintf(
                text + used, sizeof text - used, "vn %d %d %d\nf %d//%d %d//%d %d//%d %d//%d\n",
                sign * outwards[i][0], sign * outwards[i][1], sign * outwards[i][2], f[0], i + 1,
                second, i + 1, f[2], i + 1, last, i + 1);
        else
            used += (size_t)snprintf(text + used, sizeof text - used, "f %d %d %d %d\n", f[0],
                                     second, f[2], last);
    }
    folder_write_text("cube.obj", text);
    if (!scene_load(in_folder("cube.obj"), &(scene_options) { .no_cache = true }, &s, &error))
        fail_msg("%s", error.text);
    return s;
}

static scene load_cube(bool inwards) {
    return write_cube(inwards, true);
}

/* Returns the largest coordinate, which is below 2 inside the cube. */
static float outside(lmp_vec3 p) {
    return fmaxf(fabsf(p.x), fmaxf(fabsf(p.y), fabsf(p.z)));
}

static float from_center(const float p[3]) {
    return outside((lmp_vec3) { p[0], p[1], p[2] });
}

static void a_room_is_a_building_and_a_block_is_none(void **state) {
    (void)state;
    const lmp_vec3 off = { 1, 0.5f, 0 };
    scene s = load_cube(true);
    const space_room room = space_room_at(&s, off);
    assert_true(scene_is_inside(&s));
    assert_true(room.ahead[0] == 1 && room.back[0] == 3 && room.back[1] == 2.5f);
    scene_free(&s);
    s = load_cube(false);
    assert_false(scene_is_inside(&s));
    scene_free(&s);
}

static void the_camera_stands_inside_a_room_and_outside_a_block(void **state) {
    (void)state;
    for (int inwards = 0; inwards < 2; inwards++) {
        scene s = load_cube(inwards);
        const scene_camera camera = scene_default_camera(&s, 1.5f);
        assert_int_equal(from_center(camera.eye) < 0.9f * HALF, inwards);
        assert_true(from_center(camera.target) < HALF);
        scene_free(&s);
    }
}

/* An OBJ without normals does not say which side is outside: what is closed is a block, in any
 * winding. */
static void a_closed_mesh_without_sides_is_a_block(void **state) {
    (void)state;
    for (int clockwise = 0; clockwise < 2; clockwise++) {
        scene s = write_cube(clockwise, false);
        const scene_camera camera = scene_default_camera(&s, 1.5f);
        assert_true(from_center(camera.eye) > HALF);
        for (size_t i = 0; i < s.index_count; i++) {
            const scene_vertex *v = &s.vertices[s.indices[i]];
            float along = 0;
            for (int k = 0; k < 3; k++)
                along += v->position[k] * v->normal[k];
            assert_true(along > 0);
        }
        scene_free(&s);
    }
}

/* With a face missing, the rest is wound as a room, but one looks into it from there. */
static void an_open_mesh_is_what_it_is_wound_as(void **state) {
    (void)state;
    static const char box[] =
        "v -2 -2 -2\nv -2 -2 2\nv -2 2 -2\nv -2 2 2\nv 2 -2 -2\nv 2 -2 2\nv 2 2 -2\nv 2 2 2\n"
        "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\n";
    scene s;
    base_error error;
    folder_write_text("box.obj", box);
    assert_true(
        scene_load(in_folder("box.obj"), &(scene_options) { .no_cache = true }, &s, &error));
    const space_room room = space_room_at(&s, (lmp_vec3) { 0, 0, 0 });
    for (int k = 0; k < 3; k++)
        assert_true(room.back[k] == HALF && room.ahead[k] == (k == 2 ? INFINITY : HALF));
    assert_false(scene_is_inside(&s));
    scene_free(&s);
}

/* There are walls around the hole of a ring, but nobody stands in it. */
static void a_ring_is_no_building(void **state) {
    (void)state;
    static const char ring[] =
        "v -2 -2 -2\nv -2 -2 2\nv -2 2 -2\nv -2 2 2\nv 2 -2 -2\nv 2 -2 2\nv 2 2 -2\nv 2 2 2\n"
        "f 1 3 4 2\nf 5 6 8 7\nf 1 5 7 3\nf 2 4 8 6\n";
    scene s;
    base_error error;
    folder_write_text("ring.obj", ring);
    assert_true(
        scene_load(in_folder("ring.obj"), &(scene_options) { .no_cache = true }, &s, &error));
    const space_room room = space_room_at(&s, (lmp_vec3) { 0, 0, 0 });
    assert_false(scene_is_inside(&s));
    assert_true(isfinite(room.ahead[0]) && isfinite(room.back[0]) && isfinite(room.ahead[2]) &&
                isfinite(room.back[2]));
    assert_true(from_center(scene_default_camera(&s, 1.5f).eye) > HALF);
    scene_free(&s);
}

/* Each scene has 200 lights: those of the room are clear of its walls, those of the block are
 * outside it, and none is below its floor. */
static void random_lights_are_never_in_anything(void **state) {
    (void)state;
    for (int inwards = 0; inwards < 2; inwards++) {
        scene s = load_cube(inwards);
        base_error error;
        int above = 0;
        assert_true(scene_add_random_lights(&s, 200, 5, &error));
        for (size_t i = 0; i < s.light_count; i++) {
            const lmp_light *light = &s.lights[i].emitter;
            const float distance = outside(light->position);
            assert_true(inwards ? distance + light->radius <= HALF
                                : distance - light->radius >= HALF);
            assert_true(light->position.y >= -HALF);
            above += light->position.y > HALF;
        }
        assert_int_equal(above > 0, !inwards);
        scene_free(&s);
    }
}

/* Of 1000 lights seen from the camera that shows the scene, none covers more than a few degrees. */
static void random_lights_do_not_fill_the_view(void **state) {
    (void)state;
    for (int inwards = 0; inwards < 2; inwards++) {
        scene s = load_cube(inwards);
        base_error error;
        assert_true(scene_add_random_lights(&s, 1000, 7, &error));
        const scene_camera camera = scene_default_camera(&s, 1.5f);
        for (size_t i = 0; i < s.light_count; i++) {
            const lmp_light *light = &s.lights[i].emitter;
            const lmp_vec3 p = light->position;
            const double x = (double)(p.x - camera.eye[0]), y = (double)(p.y - camera.eye[1]);
            const double z = (double)(p.z - camera.eye[2]);
            assert_true((double)light->radius < 0.0701 * sqrt(x * x + y * y + z * z));
        }
        scene_free(&s);
    }
}

/* Distances from a triangle in y = 0: to its plane, its side, its corner. */
static void balls_are_measured_to_planes_sides_and_corners(void **state) {
    (void)state;
    static const struct {
        lmp_vec3 center;
        float nearest;
    } cases[] = {
        { { 0.25f, 0.5f, 0.25f }, 0.5f },
        { { 0.5f, 0, -3 }, 3 },
        { { -3, 0, -4 }, 5 },
        { { 1, 0.5f, 1 }, 0.8660254f },
    };
    scene s;
    base_error error;
    folder_write_text("flat.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nf 1 2 3\n");
    assert_true(
        scene_load(in_folder("flat.obj"), &(scene_options) { .no_cache = true }, &s, &error));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        space_ball balls[2] = {
            { .center = cases[i].center, .radius = 0.999f * cases[i].nearest, .number = 0 },
            { .center = cases[i].center, .radius = 1.001f * cases[i].nearest, .number = 1 },
        };
        space_fit(&s, balls, 2);
        for (int k = 0; k < 2; k++)
            assert_int_equal(balls[k].fits, balls[k].number == 0);
    }
    space_ball under = { .center = { 0.25f, -3, 0.25f }, .radius = 0.1f };
    space_fit(&s, &under, 1);
    assert_false(under.fits);
    scene_free(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_room_is_a_building_and_a_block_is_none),
        cmocka_unit_test(the_camera_stands_inside_a_room_and_outside_a_block),
        cmocka_unit_test(a_closed_mesh_without_sides_is_a_block),
        cmocka_unit_test(an_open_mesh_is_what_it_is_wound_as),
        cmocka_unit_test(a_ring_is_no_building),
        cmocka_unit_test(random_lights_are_never_in_anything),
        cmocka_unit_test(random_lights_do_not_fill_the_view),
        cmocka_unit_test(balls_are_measured_to_planes_sides_and_corners),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
