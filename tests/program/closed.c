/* SPDX-License-Identifier: MIT */
/* Which glowing surfaces shine outward alone: those that hold the light on their inner side. */
#include "app/scene/sides.h"
#include "tests/oracle/check.h"

#include <math.h>
#include <stdlib.h>

/* A curve of a radius and a height, of a parameter from 0 to 1, moved around the axis. */
typedef struct surface {
    const char *name;
    double (*radius)(double u), (*height)(double u);
    int rings, sides; /* pieces along the curve, and around the axis */
    double part;      /* of the whole way around */
    bool closed;
    bool split; /* the ends of that way do not quite meet */
} surface;

static double sphere_radius(double u) {
    return sin(M_PI * u);
}
static double sphere_height(double u) {
    return cos(M_PI * u);
}
static double dome_radius(double u) {
    return sphere_radius(0.5 * u);
}
static double dome_height(double u) {
    return sphere_height(0.5 * u);
}
/* A hole of a fifth of the radius: a hundredth of the area. */
static double socket_radius(double u) {
    return sphere_radius(u * (1 - asin(0.2) / M_PI));
}
static double socket_height(double u) {
    return sphere_height(u * (1 - asin(0.2) / M_PI));
}
/* A hole as wide as half of the bowl: a third of its area. */
static double bowl_radius(double u) {
    return sphere_radius(2.0 / 3 * u);
}
static double bowl_height(double u) {
    return sphere_height(2.0 / 3 * u);
}
static double one(double u) {
    (void)u;
    return 1;
}
static double short_height(double u) {
    return -4 * u;
}
/* The ends of this tube are a fortieth of its area. */
static double long_height(double u) {
    return -40 * u;
}
static double ring_radius(double u) {
    return 2 + sin(2 * M_PI * u);
}
static double ring_height(double u) {
    return cos(2 * M_PI * u);
}
static double flat(double u) {
    (void)u;
    return 0;
}
static double across(double u) {
    return u;
}

static const surface shapes[] = {
    { "bulb", sphere_radius, sphere_height, 12, 24, 1, true, false },
    { "coarse bulb", sphere_radius, sphere_height, 3, 4, 1, true, false },
    { "bulb with a seam", sphere_radius, sphere_height, 12, 24, 1, true, true },
    { "bulb with a hole", socket_radius, socket_height, 12, 24, 1, true, false },
    { "coarse bulb with a hole", socket_radius, socket_height, 5, 5, 1, true, false },
    { "bulb with a hole and a seam", socket_radius, socket_height, 6, 6, 1, true, true },
    { "ring", ring_radius, ring_height, 12, 24, 1, true, false },
    { "long tube", one, long_height, 4, 24, 1, true, false },
    { "hemisphere", dome_radius, dome_height, 6, 12, 1, false, false },
    { "fine hemisphere", dome_radius, dome_height, 24, 48, 1, false, false },
    { "fine bowl", bowl_radius, bowl_height, 24, 48, 1, false, false },
    { "open tube", one, short_height, 4, 12, 1, false, false },
    { "fine open tube", one, short_height, 24, 48, 1, false, false },
    { "fine open tube with a seam", one, short_height, 24, 48, 1, false, true },
    { "half-pipe", one, short_height, 24, 24, 0.5, false, false },
    { "long half-pipe", one, long_height, 48, 24, 0.5, false, false },
    { "quarter of a ring", ring_radius, ring_height, 24, 24, 0.25, false, false },
    { "disk", across, flat, 1, 24, 1, false, false },
    { "fine sheet", across, flat, 24, 48, 1, false, false },
};
enum { SHAPES = sizeof shapes / sizeof *shapes };

static void add_triangle(scene_builder *b, uint32_t p, uint32_t q, uint32_t r, bool clockwise) {
    uint32_t *const to = builder_append(b, BLOB_INDICES, 3);
    assert_non_null(to);
    to[0] = p;
    to[1] = clockwise ? r : q;
    to[2] = clockwise ? q : r;
}

/* Adds a shape moved along x, counter-clockwise from its convex side unless clockwise. */
static void add_shape(scene_builder *b, const surface *s, double x, bool clockwise) {
    const uint32_t first = (uint32_t)builder_count(b, BLOB_VERTICES),
                   around = (uint32_t)s->sides + 1;
    for (int i = 0; i <= s->rings; i++)
        for (int k = 0; k <= s->sides; k++) {
            scene_vertex *const v = builder_append(b, BLOB_VERTICES, 1);
            assert_non_null(v);
            const double u = (double)i / s->rings;
            const double step = s->part == 1 && !s->split ? k % s->sides : k;
            const double radius = s->radius(u), angle = 2 * M_PI * s->part * step / s->sides;
            v->position[0] = (float)(x + radius * cos(angle));
            v->position[1] = (float)(radius * sin(angle) + (s->split && k == s->sides ? 1e-6 : 0));
            v->position[2] = (float)s->height(u);
        }
    for (uint32_t i = 0; i < (uint32_t)s->rings; i++)
        for (uint32_t k = 0; k < (uint32_t)s->sides; k++) {
            const uint32_t a = first + i * around + k;
            add_triangle(b, a, a + around, a + around + 1, clockwise);
            add_triangle(b, a, a + around + 1, a + 1, clockwise);
        }
}

/* Returns what all of the triangles of the builder's single mesh are, from `first` to `end`. */
static sides_of found(scene_builder *b, size_t first, size_t end) {
    const size_t count = builder_count(b, BLOB_INDICES) / 3;
    sides_of *const of = malloc(count * sizeof *of);
    assert_non_null(of);
    assert_true(sides_find(b, 0, of));
    for (size_t i = first; i < end; i++)
        assert_int_equal(of[i], of[first]);
    const sides_of one_of_them = of[first];
    free(of);
    return one_of_them;
}

static sides_of expected(const surface *s, bool clockwise) {
    return !s->closed ? SIDES_OPEN : clockwise ? SIDES_INWARD : SIDES_OUTWARD;
}

static void a_surface_is_closed_if_it_holds_its_light(void **state) {
    (void)state;
    for (size_t i = 0; i < SHAPES; i++)
        for (int clockwise = 0; clockwise < 2; clockwise++) {
            scene_builder b = { 0 };
            add_shape(&b, &shapes[i], 0, clockwise);
            builder_mesh(&b, shapes[i].name, 0, 0);
            const sides_of of = found(&b, 0, builder_count(&b, BLOB_INDICES) / 3);
            if (of != expected(&shapes[i], clockwise))
                fail_msg("%s, clockwise %d: %d", shapes[i].name, clockwise, (int)of);
            builder_free(&b);
        }
}

/* Each of two surfaces of a mesh is closed or open by itself, whether beside or around the other.
 */
static void surfaces_of_one_mesh_are_told_apart(void **state) {
    (void)state;
    for (size_t i = 0; i < SHAPES; i++)
        for (size_t k = 0; k < SHAPES; k += 3)
            for (int beside = 0; beside < 2; beside++) {
                scene_builder b = { 0 };
                add_shape(&b, &shapes[i], 0.125, false);
                const size_t middle = builder_count(&b, BLOB_INDICES) / 3;
                add_shape(&b, &shapes[k], beside ? 10 : 0, false);
                builder_mesh(&b, "both", 0, 0);
                const size_t end = builder_count(&b, BLOB_INDICES) / 3;
                assert_int_equal(found(&b, 0, middle), expected(&shapes[i], false));
                assert_int_equal(found(&b, middle, end), expected(&shapes[k], false));
                builder_free(&b);
            }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_surface_is_closed_if_it_holds_its_light),
        cmocka_unit_test(surfaces_of_one_mesh_are_told_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
