/* SPDX-License-Identifier: MIT */
/* Instances: a scene looks, measures and stops rays as one in which every mesh stands in the world.
 */
#include "app/scene/instance.h"
#include "app/scene/space.h"
#include "app/scene/trace/trace.h"
#include "app/scene/vector.h"
#include "tests/oracle/throng.h"

#include <stdlib.h>
#include <string.h>

enum { COUNT = 40 };

typedef struct pair {
    scene placed, flat;
} pair;

static pair open_pair(void) {
    pair p;
    check_seed(7);
    p.placed = throng_open(COUNT, false);
    check_seed(7);
    p.flat = throng_open(COUNT, true);
    return p;
}

static void close_pair(pair *p) {
    scene_free(&p->placed);
    scene_free(&p->flat);
}

static void triangles_have_the_bits_of_those_in_the_world(void **state) {
    (void)state;
    pair p = open_pair();
    assert_true(p.placed.mesh_count < 20 && p.flat.mesh_count >= COUNT);
    assert_int_equal(p.placed.instance_count, p.flat.instance_count);
    assert_int_equal(scene_triangle_count(&p.placed), p.flat.index_count / 3);
    for (size_t i = 0; i < p.placed.instance_count; i++) {
        float low[3], high[3];
        scene_instance_box(&p.placed, i, low, high);
        assert_int_equal(scene_instance_triangles(&p.placed, i),
                         scene_instance_triangles(&p.flat, i));
        for (uint32_t t = 0; t < scene_instance_triangles(&p.placed, i); t++) {
            scene_vertex a[3], b[3];
            float positions[3][3];
            scene_triangle(&p.placed, i, t, a);
            scene_triangle(&p.flat, i, t, b);
            assert_memory_equal(a, b, sizeof a);
            scene_triangle_positions(&p.placed, i, t, positions);
            for (int c = 0; c < 3; c++) {
                assert_memory_equal(positions[c], a[c].position, sizeof positions[c]);
                for (int k = 0; k < 3; k++)
                    assert_true(positions[c][k] >= low[k] && positions[c][k] <= high[k]);
            }
        }
    }
    close_pair(&p);
}

/* Normals stay perpendicular to their triangles, on the front side, and tangents perpendicular to
 * normals. */
static void normals_follow_any_matrix(void **state) {
    (void)state;
    pair p = open_pair();
    for (size_t i = 0; i < p.placed.instance_count; i++)
        for (uint32_t t = 0; t < scene_instance_triangles(&p.placed, i); t++) {
            scene_vertex v[3];
            scene_triangle(&p.placed, i, t, v);
            const lmp_vec3 a = vec_load(v[0].position);
            const lmp_vec3 face =
                vec_cross(vec_sub(vec_load(v[1].position), a), vec_sub(vec_load(v[2].position), a));
            for (int k = 0; k < 3; k++) {
                const lmp_vec3 n = vec_load(v[k].normal), along = vec_load(v[k].tangent);
                CHECK_WITHIN(fabsf(vec_length(n) - 1), 1e-5);
                CHECK_WITHIN(fabsf(vec_length(along) - 1), 1e-5);
                assert_true(vec_dot(face, n) > 0 || vec_length(face) < 1e-6f);
            }
        }
    close_pair(&p);
}

static void bounds_area_and_camera_are_those_of_all_triangles(void **state) {
    (void)state;
    pair p = open_pair();
    assert_memory_equal(p.placed.minimum, p.flat.minimum, sizeof p.flat.minimum);
    assert_memory_equal(p.placed.maximum, p.flat.maximum, sizeof p.flat.maximum);
    CHECK_WITHIN(fabs(scene_area(&p.placed) / scene_area(&p.flat) - 1), 1e-6);
    const scene_camera a = scene_default_camera(&p.placed, 1.5f);
    const scene_camera b = scene_default_camera(&p.flat, 1.5f);
    assert_memory_equal(&a, &b, sizeof a);
    close_pair(&p);
}

static void balls_fit_between_instances_as_between_triangles(void **state) {
    (void)state;
    enum { BALLS = 200 };
    pair p = open_pair();
    space_ball in_placed[BALLS], in_flat[BALLS];
    int fitting = 0;
    for (size_t i = 0; i < BALLS; i++) {
        in_placed[i] =
            (space_ball) { .radius = (float)check_random_between(0.01, 0.5), .number = i };
        in_placed[i].center =
            vec((float)check_random_between(-5, 5), (float)check_random_between(-5, 5),
                (float)check_random_between(-5, 5));
    }
    memcpy(in_flat, in_placed, sizeof in_flat);
    space_fit(&p.placed, in_placed, BALLS);
    space_fit(&p.flat, in_flat, BALLS);
    for (int i = 0; i < BALLS; i++) {
        assert_int_equal(in_placed[i].number, in_flat[i].number);
        assert_int_equal(in_placed[i].fits, in_flat[i].fits);
        fitting += in_flat[i].fits;
    }
    assert_in_range(fitting, 1, BALLS - 1);
    close_pair(&p);
}

/* --- rays ------------------------------------------------------------------------------------- */

enum { RAYS = 2048 };

static void find(const scene *world, trace_kind kind, trace_hit *hits) {
    trace_bvh *bvh = trace_create(world);
    assert_non_null(bvh);
    check_seed(3);
    for (int first = 0; first < RAYS; first += TRACE_LANES) {
        trace_rays rays = { .together = false };
        for (int i = 0; i < TRACE_LANES; i++) {
            rays.length[i] = INFINITY;
            for (int k = 0; k < 3; k++) {
                rays.origin[k][i] = (float)check_random_between(-9, 9);
                rays.direction[k][i] = (float)check_random_between(-3, 3) - rays.origin[k][i];
            }
        }
        trace_nearest_n(bvh, kind, &rays, hits + first);
    }
    trace_destroy(bvh);
}

static void rays_hit_instances_as_they_hit_triangles(void **state) {
    (void)state;
    static const char *const configurations[] = { "isa=sse2", "isa=avx2" };
    pair p = open_pair();
    trace_hit *expected = calloc(RAYS, sizeof *expected), *hits = calloc(RAYS, sizeof *hits);
    assert_true(expected && hits);
    for (int kind = 0; kind <= TRACE_LIGHT; kind++) {
        int found = 0, moved = 0;
        find(&p.flat, (trace_kind)kind, expected);
        for (size_t c = 0; c < sizeof configurations / sizeof *configurations; c++) {
            if (strstr(configurations[c], "avx2") && !__builtin_cpu_supports("avx2"))
                continue;
            setenv("LAMPION_EMBREE", configurations[c], 1);
            find(&p.placed, (trace_kind)kind, hits);
            for (int i = 0; i < RAYS; i++) {
                assert_int_equal(hits[i].instance, expected[i].instance);
                if (hits[i].instance == TRACE_NOTHING)
                    continue;
                assert_memory_equal(&hits[i], &expected[i], sizeof *hits);
                found++;
                moved += !scene_instance_is_identity(&p.placed.instances[hits[i].instance]);
            }
        }
        unsetenv("LAMPION_EMBREE");
        assert_true(found > RAYS / 2 && moved > found / 4);
    }
    free(expected);
    free(hits);
    close_pair(&p);
}

/* --- matrices --------------------------------------------------------------------------------- */

static void matrices_that_normals_cannot_follow_are_refused(void **state) {
    (void)state;
    static const double wrong[][3] = {
        { 0, 1, 1 }, { 1, 1e-9, 1 }, { 1, 1, 1e-6 }, { 1e10, 1e10, 1e10 }, { 1, 1, (double)NAN }
    };
    scene_instance instance;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const double m[16] = {
            [0] = wrong[i][0], [5] = wrong[i][1], [10] = wrong[i][2], [15] = 1.0
        };
        assert_false(scene_instance_set(&instance, m));
    }
    const double sheared[16] = { [0] = 1, [4] = 1, [5] = 1e-7, [10] = 1, [15] = 1 };
    assert_false(scene_instance_set(&instance, sheared));
    const double mirrored[16] = { [0] = -1, [5] = 2, [10] = 2, [12] = 5, [15] = 1 };
    assert_true(scene_instance_set(&instance, mirrored));
    assert_true(scene_instance_mirrors(&instance));
    assert_true(instance.world_from_mesh[0][3] == 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_have_the_bits_of_those_in_the_world),
        cmocka_unit_test(normals_follow_any_matrix),
        cmocka_unit_test(bounds_area_and_camera_are_those_of_all_triangles),
        cmocka_unit_test(balls_fit_between_instances_as_between_triangles),
        cmocka_unit_test(rays_hit_instances_as_they_hit_triangles),
        cmocka_unit_test(matrices_that_normals_cannot_follow_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
