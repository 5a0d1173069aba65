/* SPDX-License-Identifier: MIT */
/* What of a scene the camera before it frames: a model in wide surroundings, or all there is. */
#include "app/scene/environment.h"

#include "tests/oracle/check.h"
#include "tests/program/shapes.h"

#include <stdlib.h>

static void block(shape *s, float x, float y, float z, float wide, float high, float deep) {
    shape_box(s, vec(x - wide / 2, y, z - deep / 2), vec(x + wide / 2, y + high, z + deep / 2),
              false, 0);
}

static void dome(shape *s, float r) {
    const float profile[][2] = {
        { 0, r }, { 0.7f * r, 0.7f * r }, { r, 0 }, { 0.7f * r, -0.7f * r }, { 0, -r }
    };
    shape_revolve(s, vec(0, 0, 0), profile, sizeof profile / sizeof *profile, 0, 64);
}

/* A scene of two meshes: the first corners of a shape, and the rest. */
typedef struct pair {
    scene_mesh meshes[2];
    scene_instance instances[2];
} pair;

static scene scene_of_two(shape *s, uint32_t first, pair *p) {
    scene world = shape_scene(s);
    p->meshes[0] = p->meshes[1] = s->mesh;
    p->meshes[0].index_count = p->meshes[1].first_index = first;
    p->meshes[1].index_count -= first;
    for (uint32_t m = 0; m < 2; m++) {
        p->instances[m] = scene_instance_identity(m);
        for (int k = 0; k < 3; k++) {
            p->meshes[m].minimum[k] = INFINITY;
            p->meshes[m].maximum[k] = -INFINITY;
        }
        for (uint32_t i = 0; i < p->meshes[m].index_count; i++) {
            const float *at = s->vertices[s->indices[p->meshes[m].first_index + i]].position;
            for (int k = 0; k < 3; k++) {
                p->meshes[m].minimum[k] = fminf(p->meshes[m].minimum[k], at[k]);
                p->meshes[m].maximum[k] = fmaxf(p->meshes[m].maximum[k], at[k]);
            }
        }
    }
    world.meshes = p->meshes;
    world.instances = p->instances;
    world.mesh_count = world.instance_count = 2;
    return world;
}

/* On ground that reaches to the horizon, on a plane ten times its size, or under a dome, the model
 * is framed, and the dome keeps no light of the studio out; on ground a few times its size, or on
 * a board, all is. */
static void a_model_is_framed_in_wide_surroundings(void **state) {
    (void)state;
    static const struct {
        float size, thick;
        bool dome, model;
    } cases[] = { { 1000, 0.05f, false, true },
                  { 8, 0.05f, false, false },
                  { 12, 0.05f, false, true },
                  { 12, 0.5f, false, false },
                  { 1000, 0, true, true } };
    shape *s = malloc(sizeof *s);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const float r = cases[i].size;
        pair p;
        shape_clear(s);
        block(s, 0, 0, 0, 2, 1, 2);
        const uint32_t first = s->count;
        if (cases[i].dome)
            dome(s, r);
        else
            shape_box(s, vec(-r, -0.05f - cases[i].thick, -r), vec(r, -0.05f, r), false, 0);
        scene world = scene_of_two(s, first, &p);
        scene_frame frame = { .wanted = SCENE_FRAMING_AUTO };
        world.frame = &frame;
        const lmp_vec3 low = vec_load(p.meshes[0].minimum), high = vec_load(p.meshes[0].maximum);
        const float size = vec_length(vec_sub(high, low));
        const scene_camera camera = scene_default_camera(&world, 1.5f);
        const lmp_vec3 eye = vec_load(camera.eye), target = vec_load(camera.target);
        assert_string_equal(camera.name, "framed");
        assert_int_equal(vec_length(vec_sub(eye, target)) < 3 * size, cases[i].model);
        if (cases[i].model)
            assert_true(vec_length(vec_sub(target, vec_scale(vec_add(low, high), 0.5f))) < size);
        assert_int_equal(environment_suits_shadows(true, &world), !cases[i].dome);
    }
    free(s);
}

/* A detail of a model is none: a lamp on a mast, of as little size as a crate on wide ground, does
 * not keep the mast out of the image. */
static void a_detail_of_a_model_is_not_framed(void **state) {
    (void)state;
    shape *s = malloc(sizeof *s);
    pair p;
    shape_clear(s);
    block(s, 0, 100, 0, 1, 1, 1);
    const uint32_t first = s->count;
    block(s, 0, 0, 0, 0.9f, 100, 0.9f);
    const scene world = scene_of_two(s, first, &p);
    const scene_camera camera = scene_default_camera(&world, 1.5f);
    assert_true(vec_length(vec_sub(vec_load(camera.eye), vec_load(camera.target))) > 50);
    free(s);
}

/* Makes a wide plate as one surface, or as squares that share no vertex. */
static void ground(shape *s, float r, int squares) {
    const float step = 2 * r / (float)squares;
    for (int i = 0; i < squares * squares; i++) {
        const int column = i % squares, row = i / squares;
        const float x[2] = { (float)column * step - r, (float)(column + 1) * step - r },
                    z[2] = { (float)row * step - r, (float)(row + 1) * step - r };
        const lmp_vec3 quad[4] = {
            { x[0], 0, z[0] }, { x[0], 0, z[1] }, { x[1], 0, z[1] }, { x[1], 0, z[0] }
        };
        shape_quad(s, quad, false);
    }
}

/* So is a model that is a mesh with the level ground that it stands on, whether that is one quad or
 * as fine as the model; not a detail of a building or an object, nor a stray triangle. */
static void a_model_is_framed_that_is_one_mesh_with_its_ground(void **state) {
    (void)state;
    shape *s = malloc(sizeof *s);
    for (int squares = 1; squares <= 60; squares += 59) {
        shape_clear(s);
        ground(s, 100, squares);
        block(s, 20, 0.1f, 10, 1, 2, 1);
        const scene world = shape_scene(s);
        const scene_camera camera = scene_default_camera(&world, 1.5f);
        const lmp_vec3 eye = vec_load(camera.eye), target = vec_load(camera.target);
        assert_true(vec_length(vec_sub(eye, target)) < 8);
        assert_true(vec_length(vec_sub(target, vec(20, 1.1f, 10))) < 0.5f);
    }
    for (int detail = 0; detail < 2; detail++) {
        shape_clear(s);
        if (detail == 0)
            block(s, 0, 0, 0, 100, 60, 100); /* with a knob */
        else
            ground(s, 100, 1); /* with a splinter */
        if (detail == 0)
            block(s, 50.1f, 10, 0, 0.1f, 0.1f, 0.1f);
        else
            shape_triangle(s, vec(0, 1, 0), vec(1, 1, 0), vec(0, 2, 0));
        const scene world = shape_scene(s);
        const scene_camera camera = scene_default_camera(&world, 1.5f);
        assert_true(vec_length(vec_sub(vec_load(camera.eye), vec_load(camera.target))) > 50);
    }
    free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_model_is_framed_in_wide_surroundings),
        cmocka_unit_test(a_detail_of_a_model_is_not_framed),
        cmocka_unit_test(a_model_is_framed_that_is_one_mesh_with_its_ground),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
