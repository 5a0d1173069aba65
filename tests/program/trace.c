/* SPDX-License-Identifier: MIT */
/* Rays through triangles: the same hits on every instruction set, without cracks. */
#include "app/scene/trace/trace.h"
#include "app/scene/trace/triangle.h"

#include "tests/oracle/check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifdef __x86_64__
#define HAS(set) __builtin_cpu_supports(set)
#else
#define HAS(set) false
#endif

/* --- one triangle ----------------------------------------------------------------------------- */

static bool test_ray(const float *const corners[3], const float origin[3], const float direction[3],
                     triangle_hits *hits) {
    const float *const from[3] = { &origin[0], &origin[1], &origin[2] };
    const float *const along[3] = { &direction[0], &direction[1], &direction[2] };
    const float end = INFINITY;
    triangle_rays ray;
    triangle_rays_set(from, along, 1, &ray);
    return triangle_test(&ray, 0, 1, corners, &end, hits) != 0;
}

static unsigned count_hits(const float *const corners[3], const float origin[3],
                           const float direction[3]) {
    triangle_hits hits;
    return test_ray(corners, origin, direction, &hits) && hits.distance[0] > 0;
}

static void a_hit_is_where_the_ray_meets_the_plane(void **state) {
    (void)state;
    for (int i = 0; i < check_count(1000, 100000); i++) {
        float at[3][3], direction[3];
        const float origin[3] = { 0.1f, -0.2f, 0.3f };
        const double weights[3] = { 0.2, 0.5, 0.3 };
        for (int c = 0; c < 3; c++) {
            double inside = 0;
            for (int k = 0; k < 3; k++) {
                at[k][c] = (float)check_random_between(-4, 4);
                inside += weights[k] * (double)at[k][c];
            }
            direction[c] = (float)(inside - (double)origin[c]) * 0.25f;
        }
        const float *const corners[3] = { at[0], at[1], at[2] };
        triangle_hits hits;
        double edges[2][3], normal[3], facing = 0, size = 0;
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 2; k++)
                edges[k][c] = (double)at[k + 1][c] - (double)at[0][c];
        for (int c = 0; c < 3; c++) {
            normal[c] = edges[0][(c + 1) % 3] * edges[1][(c + 2) % 3] -
                        edges[0][(c + 2) % 3] * edges[1][(c + 1) % 3];
            facing += normal[c] * (double)direction[c];
            size += normal[c] * normal[c];
        }
        if (!(fabs(facing) > 0.05 * sqrt(size)) || !(size > 1))
            continue; /* rounding decides whether a triangle is seen edge-on */
        assert_true(test_ray(corners, origin, direction, &hits));
        CHECK_WITHIN(fabs((double)hits.distance[0] - 4), 1e-4);
        CHECK_WITHIN(fabs((double)hits.u[0] - weights[1]), 1e-4);
        CHECK_WITHIN(fabs((double)hits.v[0] - weights[2]), 1e-4);
        assert_int_equal(hits.front[0], facing < 0);
    }
}

/* Rays aimed at an edge, as well as float32 can, nearly all pass it on one side: where products
 * round to the same number, the exact side decides. */
static void a_ray_beside_an_edge_hits_one_of_its_triangles(void **state) {
    (void)state;
    const float nowhere[3] = { 0, 0, 0 }, left[3] = { -3, 0, 5 }, right[3] = { 3, 0, 5 };
    static const double low[3] = { -1, 2, 4 }, high[3] = { 1, 3, 6 };
    const int count = check_count(2000, 100000);
    int both = 0;
    for (int i = 0; i < count; i++) {
        float a[3], b[3], direction[3];
        const double part = check_random_between(0.1, 0.9);
        for (int k = 0; k < 3; k++) {
            a[k] = (float)check_random_between(low[k], high[k]);
            b[k] = (float)check_random_between(low[k], high[k]) * (k == 1 ? -1 : 1);
            direction[k] = (float)(part * (double)a[k] + (1 - part) * (double)b[k]);
        }
        const float *const first[3] = { a, b, left }, *const second[3] = { b, a, right };
        const unsigned hits =
            count_hits(first, nowhere, direction) + count_hits(second, nowhere, direction);
        assert_in_range(hits, 1, 2);
        both += hits == 2;
    }
    printf("%d of %d rays hit both triangles of an edge\n", both, count);
    assert_true(both * 100 <= count);
}

/* Rays side by side hit what each hits by itself, unless it ends before. */
static void rays_side_by_side_end_where_each_ends(void **state) {
    (void)state;
    const float a[3] = { -1, -1, 2 }, b[3] = { 1, -1, 2 }, c[3] = { 0, 1, 3 };
    const float *const corners[3] = { a, b, c };
    float origin[3][TRIANGLE_LANES] = { { 0 } }, direction[3][TRIANGLE_LANES];
    float ends[TRIANGLE_LANES];
    const float *const from[3] = { origin[0], origin[1], origin[2] };
    const float *const along[3] = { direction[0], direction[1], direction[2] };
    const uint32_t counts[] = { 1, 4, 8, TRIANGLE_LANES };
    for (int round = 0; round < 200; round++) {
        const uint32_t count = counts[round % 4];
        uint32_t expected = 0;
        triangle_rays rays;
        triangle_hits hits;
        for (uint32_t i = 0; i < count; i++) {
            for (int k = 0; k < 3; k++)
                direction[k][i] = (float)check_random_between(k < 2 ? -0.5 : 0.9, k < 2 ? 0.5 : 1);
            ends[i] = (float)check_random_between(1.5, 3.5);
            const float start[3] = { 0 },
                        to[3] = { direction[0][i], direction[1][i], direction[2][i] };
            const bool met = test_ray(corners, start, to, &hits) && hits.distance[0] <= ends[i];
            expected |= (uint32_t)met << i;
        }
        triangle_rays_set(from, along, count, &rays);
        assert_int_equal(triangle_test(&rays, 0, count, corners, ends, &hits), expected);
    }
}

/* In a closed tetrahedron around the origin every ray from within leaves through some face,
 * including those aimed at an edge or a corner as well as float32 can. */
static void no_ray_slips_between_triangles(void **state) {
    (void)state;
    static const int faces[4][3] = { { 0, 1, 2 }, { 0, 3, 1 }, { 0, 2, 3 }, { 1, 3, 2 } };
    for (int i = 0; i < check_count(20000, 2000000); i++) {
        float at[4][3], direction[3];
        const float origin[3] = { (float)check_random_between(-0.05, 0.05),
                                  (float)check_random_between(-0.05, 0.05),
                                  (float)check_random_between(-0.05, 0.05) };
        static const float corner[4][3] = {
            { 1, 1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { -1, -1, 1 }
        };
        for (int k = 0; k < 4; k++)
            for (int c = 0; c < 3; c++)
                at[k][c] = corner[k][c] + (float)check_random_between(-0.3, 0.3);
        const float along = i % 4 ? (float)check_random() : 0;
        for (int c = 0; c < 3; c++)
            direction[c] = at[0][c] + along * (at[1][c] - at[0][c]) - origin[c];
        unsigned hits = 0;
        for (int f = 0; f < 4; f++) {
            const float *const corners[3] = { at[faces[f][0]], at[faces[f][1]], at[faces[f][2]] };
            hits += count_hits(corners, origin, direction);
        }
        assert_true(hits > 0);
    }
}

/* --- a scene ---------------------------------------------------------------------------------- */

enum { ROWS = 96, COLUMNS = TRACE_LANES * 8, RAYS = ROWS * COLUMNS };

static void aim(int row, int first, trace_rays *rays) {
    memset(rays, 0, sizeof *rays);
    rays->together = row % 2 == 1;
    for (int i = 0; i < TRACE_LANES; i++) {
        rays->origin[1][i] = 2;
        rays->origin[2][i] = 9;
        rays->direction[0][i] = (float)(first + i) / COLUMNS * 2 - 1;
        rays->direction[1][i] = (float)row / ROWS - 0.4f;
        rays->direction[2][i] = -1;
        rays->length[i] = INFINITY;
    }
}

/* Traces all rays of a kind, in packets or one by one. */
static void find(const scene *world, trace_kind kind, bool packets, trace_hit *hits) {
    trace_bvh *bvh = trace_create(world);
    assert_non_null(bvh);
    for (int y = 0; y < ROWS; y++)
        for (int x = 0; x < COLUMNS; x += TRACE_LANES) {
            trace_hit *to = hits + y * COLUMNS + x;
            trace_rays rays;
            aim(y, x, &rays);
            if (packets)
                trace_nearest_n(bvh, kind, &rays, to);
            for (int i = 0; !packets && i < TRACE_LANES; i++) {
                const float from[3] = { rays.origin[0][i], rays.origin[1][i], rays.origin[2][i] };
                const float along[3] = { rays.direction[0][i], rays.direction[1][i],
                                         rays.direction[2][i] };
                to[i] = trace_nearest(bvh, kind, from, along);
            }
        }
    trace_destroy(bvh);
}

static void compare(const trace_hit *a, const trace_hit *b) {
    for (int i = 0; i < RAYS; i++) {
        assert_memory_equal(&a[i].distance, &b[i].distance, sizeof a->distance);
        assert_int_equal(a[i].instance, b[i].instance);
        if (a[i].instance == TRACE_NOTHING)
            continue;
        assert_int_equal(a[i].triangle, b[i].triangle);
        assert_memory_equal(&a[i].u, &b[i].u, sizeof a->u);
        assert_memory_equal(&a[i].v, &b[i].v, sizeof a->v);
    }
}

static scene load(const char *name) {
    scene s;
    base_error error;
    if (!scene_load(name, &(scene_options) { .no_cache = true }, &s, &error))
        fail_msg("%s", error.text);
    return s;
}

static void hits_do_not_depend_on_embree_or_packets(void **state) {
    (void)state;
    const struct {
        const char *text;
        bool able;
    } configurations[] = {
        { "isa=sse2", HAS("sse2") },      { "isa=sse4.2", HAS("sse4.2") },
        { "isa=avx", HAS("avx") },        { "isa=avx2", HAS("avx2") },
        { "isa=avx512", HAS("avx512f") }, { "object_accel=bvh4.object", true },
    };
    scene world = load("builtin:atrium");
    trace_hit *expected = calloc(RAYS, sizeof *expected), *hits = calloc(RAYS, sizeof *hits);
    int found = 0;
    assert_true(expected && hits);
    for (int kind = 0; kind <= TRACE_LIGHT; kind++) {
        unsetenv("LAMPION_EMBREE");
        find(&world, (trace_kind)kind, true, expected);
        for (int i = 0; i < RAYS; i++)
            found += expected[i].instance != TRACE_NOTHING;
        find(&world, (trace_kind)kind, false, hits);
        compare(expected, hits);
        for (size_t i = 0; i < sizeof configurations / sizeof *configurations; i++) {
            if (!configurations[i].able)
                continue;
            setenv("LAMPION_EMBREE", configurations[i].text, 1);
            find(&world, (trace_kind)kind, true, hits);
            compare(expected, hits);
        }
    }
    unsetenv("LAMPION_EMBREE");
    assert_true(found > RAYS);
    free(expected);
    free(hits);
    scene_free(&world);
}

/* Makes every third material a mask that cuts all of it out. */
static void cut_out(scene *world, scene_material *materials) {
    memcpy(materials, world->materials, world->material_count * sizeof *materials);
    for (size_t i = 0; i < world->material_count; i += 3) {
        materials[i].flags |= SCENE_ALPHA_MASK;
        materials[i].base_color[3] = 0;
        materials[i].alpha_cutoff = 0.5f;
    }
    world->materials = materials;
}

/* A ray is occluded if, and only if, its nearest hit lies within its length, alone and side by
 * side. */
static void the_nearest_hit_occludes(void **state) {
    (void)state;
    scene world = load("builtin:atrium");
    const scene_material *own = world.materials;
    scene_material *materials = malloc(world.material_count * sizeof *materials);
    trace_hit *hits = calloc(RAYS, sizeof *hits);
    int occluded = 0;
    assert_true(hits && materials);
    cut_out(&world, materials);
    find(&world, TRACE_LIGHT, true, hits);
    trace_bvh *bvh = trace_create(&world);
    assert_non_null(bvh);
    for (int first = 0; first < RAYS; first += TRACE_LANES) {
        trace_rays rays;
        bool found[TRACE_LANES];
        aim(first / COLUMNS, first % COLUMNS, &rays);
        for (int i = 0; i < TRACE_LANES; i++) {
            const float distance = hits[first + i].distance;
            const float lengths[4] = { distance, nextafterf(distance, 0), 2 * distance, -1 };
            rays.length[i] = lengths[(first / TRACE_LANES + i) % 4];
        }
        trace_occluded_n(bvh, &rays, found);
        for (int i = 0; i < TRACE_LANES; i++) {
            const float from[3] = { rays.origin[0][i], rays.origin[1][i], rays.origin[2][i] };
            const float along[3] = { rays.direction[0][i], rays.direction[1][i],
                                     rays.direction[2][i] };
            const bool within = hits[first + i].instance != TRACE_NOTHING &&
                                hits[first + i].distance <= rays.length[i];
            assert_int_equal(found[i], within);
            if (rays.length[i] >= 0)
                assert_int_equal(trace_occluded(bvh, from, along, rays.length[i]), within);
            occluded += within;
        }
    }
    assert_true(occluded > RAYS / 4);
    trace_destroy(bvh);
    free(hits);
    world.materials = own;
    free(materials);
    scene_free(&world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_hit_is_where_the_ray_meets_the_plane),
        cmocka_unit_test(a_ray_beside_an_edge_hits_one_of_its_triangles),
        cmocka_unit_test(rays_side_by_side_end_where_each_ends),
        cmocka_unit_test(no_ray_slips_between_triangles),
        cmocka_unit_test(hits_do_not_depend_on_embree_or_packets),
        cmocka_unit_test(the_nearest_hit_occludes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
