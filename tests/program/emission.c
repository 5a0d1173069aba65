/* SPDX-License-Identifier: MIT */
/* Emissive meshes as lights: which shapes are found, which way they face, and how large they are.
 */
#include "app/scene/load/patches.h"
#include "app/scene/load/round.h"
#include "app/scene/vector.h"
#include "tests/oracle/check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TRIANGLES_MAX = 2048, MOST = 40 };

typedef struct shape {
    piece_triangle triangles[TRIANGLES_MAX];
    size_t count;
} shape;

static void add(shape *s, lmp_vec3 a, lmp_vec3 b, lmp_vec3 c) {
    assert_true(s->count < TRIANGLES_MAX);
    s->triangles[s->count++] = (piece_triangle) { .corner = { a, b, c } };
}

static void add_quad(shape *s, lmp_vec3 a, lmp_vec3 b, lmp_vec3 c, lmp_vec3 d) {
    add(s, a, b, c);
    add(s, a, c, d);
}

static lmp_vec3 on_circle(int i, int count, float radius, float z) {
    const double angle = 2 * M_PI * (i % count) / count;
    return vec(radius * (float)cos(angle), radius * (float)sin(angle), z);
}

/* Adds the fan of a disk that faces along z. */
static void add_disk(shape *s, int count, float radius) {
    for (int i = 0; i < count; i++)
        add(s, vec(0, 0, 0), on_circle(i, count, radius, 0), on_circle(i + 1, count, radius, 0));
}

static size_t make(const shape *s, lmp_light lights[MOST]) {
    size_t made;
    assert_true(patches_make(s->triangles, s->count, MOST, lights, &made));
    return made;
}

/* Returns the area of a light without its second side. */
static double area_of(const lmp_light *light) {
    lmp_light front = *light;
    front.two_sided = false;
    return (double)lmp_light_intensity_from_radiance(&front, 1);
}

/* Returns the normal of a flat light, by its definition. */
static lmp_vec3 normal_of(const lmp_light *light) {
    const lmp_vec3 up = { 0, 0, 1 };
    if (light->kind == LMP_LIGHT_DISK)
        return light->direction;
    if (light->kind == LMP_LIGHT_RECTANGLE)
        return vec_normalize(vec_cross(light->half[0], light->half[1]), up);
    lmp_vec3 sum = { 0, 0, 0 };
    for (int i = 0; i < light->corner_count; i++)
        sum =
            vec_add(sum, vec_cross(light->corner[i], light->corner[(i + 1) % light->corner_count]));
    return vec_normalize(sum, up);
}

/* Checks a single light of a flat shape that faces along z. */
static void check_single(const shape *s, lmp_light_kind kind, double area) {
    lmp_light lights[MOST];
    assert_int_equal(make(s, lights), 1);
    assert_int_equal(lights[0].kind, kind);
    CHECK_WITHIN(fabs(area_of(&lights[0]) - area), 1e-5 * area);
    CHECK_WITHIN(1 - (double)normal_of(&lights[0]).z, 1e-6);
}

static shape made;

static void flat_shapes_are_one_light(void **state) {
    (void)state;
    made.count = 0;
    add_quad(&made, vec(0, 0, 1), vec(3, 0, 1), vec(3, 2, 1), vec(0, 2, 1));
    check_single(&made, LMP_LIGHT_RECTANGLE, 6);
    /* a grid of 6 x 4 squares, whose outline has corners on straight sides */
    made.count = 0;
    for (int i = 0; i < 24; i++) {
        const float x = (float)(i % 6), y = (float)(i / 6);
        add_quad(&made, vec(x, y, 0), vec(x + 1, y, 0), vec(x + 1, y + 1, 0), vec(x, y + 1, 0));
    }
    check_single(&made, LMP_LIGHT_RECTANGLE, 24);
    /* an L of three squares */
    made.count = 0;
    add_quad(&made, vec(0, 0, 0), vec(1, 0, 0), vec(1, 1, 0), vec(0, 1, 0));
    add_quad(&made, vec(1, 0, 0), vec(2, 0, 0), vec(2, 1, 0), vec(1, 1, 0));
    add_quad(&made, vec(0, 1, 0), vec(1, 1, 0), vec(1, 2, 0), vec(0, 2, 0));
    check_single(&made, LMP_LIGHT_POLYGON, 3);
    made.count = 0;
    add_disk(&made, 6, 2);
    check_single(&made, LMP_LIGHT_POLYGON, 6 * sqrt(3));
    made.count = 0;
    add_disk(&made, 48, 2);
    check_single(&made, LMP_LIGHT_DISK, 48 * 2 * sin(2 * M_PI / 48));
}

/* A square ring has an outline of two loops, so its triangles are lights; together they are the
 * ring. */
static void a_ring_is_its_triangles(void **state) {
    (void)state;
    lmp_light lights[MOST];
    double area = 0;
    made.count = 0;
    for (int i = 0; i < 4; i++)
        add_quad(&made, on_circle(i, 4, 1, 0), on_circle(i, 4, 2, 0), on_circle(i + 1, 4, 2, 0),
                 on_circle(i + 1, 4, 1, 0));
    const size_t count = make(&made, lights);
    assert_int_equal(count, 8);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(lights[i].kind, LMP_LIGHT_POLYGON);
        area += area_of(&lights[i]);
    }
    CHECK_WITHIN(fabs(area - 6), 1e-5);
}

static void add_box(shape *s, lmp_vec3 half) {
    for (int axis = 0; axis < 3; axis++)
        for (int sign = -1; sign <= 1; sign += 2) {
            const lmp_vec3 n = vec(axis == 0 ? (float)sign : 0, axis == 1 ? (float)sign : 0,
                                   axis == 2 ? (float)sign : 0);
            const lmp_vec3 u = vec_across(n), v = vec_cross(n, u);
            lmp_vec3 corner[4];
            for (int i = 0; i < 4; i++) {
                const lmp_vec3 c = vec_add(n, vec_add(vec_scale(u, i == 0 || i == 3 ? -1 : 1),
                                                      vec_scale(v, i < 2 ? -1 : 1)));
                corner[i] = vec(c.x * half.x, c.y * half.y, c.z * half.z);
            }
            add_quad(s, corner[0], corner[1], corner[2], corner[3]);
        }
}

/* Each face shines away from the middle, with its own area. */
static void a_box_is_six_rectangles_that_shine_outward(void **state) {
    (void)state;
    lmp_light lights[MOST], tube;
    double area = 0;
    made.count = 0;
    add_box(&made, vec(10, 0.05f, 0.05f));
    assert_int_equal(make(&made, lights), 6);
    for (int i = 0; i < 6; i++) {
        assert_int_equal(lights[i].kind, LMP_LIGHT_RECTANGLE);
        CHECK_WITHIN(0, (double)vec_dot(normal_of(&lights[i]), lights[i].position));
        area += area_of(&lights[i]);
    }
    CHECK_WITHIN(fabs(area - 8 * (10 * 0.05 * 2 + 0.05 * 0.05)), 1e-4);
    assert_false(round_make_tube(made.triangles, made.count, &tube));
}

/* Adds a quad, or a triangle if its last two corners are one. */
static void add_face(shape *s, lmp_vec3 a, lmp_vec3 b, lmp_vec3 c, lmp_vec3 d, bool pointed) {
    if (pointed)
        add(s, a, b, c);
    else
        add_quad(s, a, b, c, d);
}

/* Adds the side of a cylinder around z, and flat or round ends of `rings` rings. */
static void add_cylinder(shape *s, int count, float radius, float half, int rings) {
    for (int i = 0; i < count; i++) {
        add_quad(s, on_circle(i, count, radius, -half), on_circle(i + 1, count, radius, -half),
                 on_circle(i + 1, count, radius, half), on_circle(i, count, radius, half));
        for (int ring = 0; ring < rings; ring++) {
            const double low = M_PI / 2 * ring / rings, high = M_PI / 2 * (ring + 1) / rings;
            const bool last = ring + 1 == rings;
            const float r0 = radius * (float)cos(low), r1 = last ? 0 : radius * (float)cos(high);
            const float flat = rings > 1 ? radius : 0;
            const float z0 = half + flat * (float)sin(low), z1 = half + flat * (float)sin(high);
            add_face(s, on_circle(i, count, r0, z0), on_circle(i + 1, count, r0, z0),
                     on_circle(i + 1, count, r1, z1), on_circle(i, count, r1, z1), last);
            add_face(s, on_circle(i + 1, count, r0, -z0), on_circle(i, count, r0, -z0),
                     on_circle(i, count, r1, -z1), on_circle(i + 1, count, r1, -z1), last);
        }
    }
}

static void long_round_bodies_are_tubes(void **state) {
    (void)state;
    lmp_light tube, lights[MOST];
    made.count = 0;
    add_cylinder(&made, 32, 0.05f, 2, 1);
    assert_true(round_make_tube(made.triangles, made.count, &tube));
    CHECK_WITHIN(fabs((double)tube.radius - 0.05), 1e-6);
    CHECK_WITHIN(fabs(fabs((double)tube.half[0].z) - 2), 1e-5);
    CHECK_WITHIN((double)vec_length(tube.position), 1e-5);
    made.count = 0; /* round ends may follow each other closely */
    add_cylinder(&made, 32, 0.5f, 1, 8);
    assert_true(round_make_tube(made.triangles, made.count, &tube));
    CHECK_WITHIN(fabs(fabs((double)tube.half[0].z) - 1), 1e-2);
    made.count = 0; /* a can */
    add_cylinder(&made, 32, 0.5f, 1, 1);
    assert_false(round_make_tube(made.triangles, made.count, &tube));
    made.count = 0; /* six sides are not round */
    add_cylinder(&made, 6, 0.05f, 2, 1);
    assert_false(round_make_tube(made.triangles, made.count, &tube));
    assert_int_equal(make(&made, lights), 8);
}

/* Faces that shine from both sides are not one with their neighbors that do not. */
static void sides_stay_apart(void **state) {
    (void)state;
    lmp_light lights[MOST];
    made.count = 0;
    add_quad(&made, vec(0, 0, 0), vec(1, 0, 0), vec(1, 1, 0), vec(0, 1, 0));
    add_quad(&made, vec(1, 0, 0), vec(2, 0, 0), vec(2, 1, 0), vec(1, 1, 0));
    made.triangles[2].both = made.triangles[3].both = true;
    assert_int_equal(make(&made, lights), 2);
    assert_int_equal(lights[0].two_sided + lights[1].two_sided, 1);
}

/* Each piece is a run whose triangles keep their order; touching in one corner is enough. */
static void pieces_are_what_hangs_together(void **state) {
    (void)state;
    piece *pieces;
    size_t count;
    made.count = 0;
    for (int i = 0; i < 3; i++) { /* the corners of three triangles, in turn */
        add(&made, vec(0, 0, 0), vec(1, (float)i, 0), vec(1, (float)i + 1, 0));
        add(&made, vec(9, 0, 0), vec(10, (float)i, 0), vec(10, (float)i + 1, 0));
    }
    add(&made, vec(0, 0, 5), vec(1, 0, 5), vec(0, 1, 5));
    for (size_t i = 0; i < made.count; i++)
        made.triangles[i].radiance[0] = (float)i;
    assert_true(pieces_sort(made.triangles, made.count, &pieces, &count));
    assert_int_equal(count, 3);
    const float expected[7] = { 0, 2, 4, 1, 3, 5, 6 };
    for (int i = 0; i < 7; i++)
        assert_true(made.triangles[i].radiance[0] == expected[i]);
    assert_int_equal(pieces[0].count, 3);
    assert_int_equal(pieces[1].count, 3);
    assert_int_equal(pieces[2].count, 1);
    assert_ptr_equal(pieces[1].triangles, made.triangles + 3);
    assert_ptr_equal(pieces[2].triangles, made.triangles + 6);
    free(pieces);
    assert_true(pieces_sort(made.triangles, 0, &pieces, &count));
    assert_int_equal(count, 0);
    free(pieces);
}

/* A patch has the mean radiance of its triangles, by their areas. */
static void a_patch_has_the_mean_radiance(void **state) {
    (void)state;
    lmp_light lights[MOST];
    made.count = 0;
    add_quad(&made, vec(0, 0, 0), vec(3, 0, 0), vec(3, 1, 0), vec(0, 1, 0));
    add_quad(&made, vec(3, 0, 0), vec(4, 0, 0), vec(4, 1, 0), vec(3, 1, 0));
    for (int i = 0; i < 4; i++)
        for (int c = 0; c < 3; c++)
            made.triangles[i].radiance[c] = (float)((i < 2 ? 1 : 5) * (c + 1));
    assert_int_equal(make(&made, lights), 1);
    CHECK_WITHIN(fabs((double)lights[0].radiance.r - 2), 1e-6);
    CHECK_WITHIN(fabs((double)lights[0].radiance.g - 4), 1e-6);
    CHECK_WITHIN(fabs((double)lights[0].radiance.b - 6), 1e-6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_shapes_are_one_light),
        cmocka_unit_test(a_ring_is_its_triangles),
        cmocka_unit_test(a_box_is_six_rectangles_that_shine_outward),
        cmocka_unit_test(long_round_bodies_are_tubes),
        cmocka_unit_test(sides_stay_apart),
        cmocka_unit_test(pieces_are_what_hangs_together),
        cmocka_unit_test(a_patch_has_the_mean_radiance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
