/* SPDX-License-Identifier: MIT */
/* Bodies show their outside, whatever the order of their corners, in formats that do not state it.
 */
#include "app/scene/scene.h"
#include "tests/program/folder.h"
#include "tests/program/load.h"

/* Faces of a box by its corners, the first being lowest in x, y and z: counter-clockwise from
 * outside. */
static const int faces[6][4] = { { 1, 2, 4, 3 }, { 5, 7, 8, 6 }, { 1, 5, 6, 2 },
                                 { 3, 4, 8, 7 }, { 1, 3, 7, 5 }, { 2, 6, 8, 4 } };

typedef struct box {
    float low, high;
    bool clockwise;
    int faces;       /* the number of faces, of which the last may be missing */
    int parts;       /* number of materials that the faces take in turn */
    const char *tag; /* text before the box: "o name " or nothing */
    float shift;     /* along x */
    const float *y;  /* its low and high y, or NULL: low and high */
} box;

static void add_box(char *text, size_t size, const box *b, int number) {
    size_t used = strlen(text);
    for (int i = 0; i < 8; i++)
        used += (size_t)snprintf(text + used, size - used, "v %g %g %g\n",
                                 (double)((i & 4 ? b->high : b->low) + b->shift),
                                 (double)(b->y    ? b->y[i >> 1 & 1]
                                          : i & 2 ? b->high
                                                  : b->low),
                                 (double)(i & 1 ? b->high : b->low));
    used += (size_t)snprintf(text + used, size - used, "%s", b->tag);
    for (int i = 0; i < b->faces; i++) {
        const int *f = faces[i], first = 8 * number;
        if (b->parts > 1)
            used += (size_t)snprintf(text + used, size - used, "usemtl part%d\n", i % b->parts);
        used += (size_t)snprintf(text + used, size - used, "f %d %d %d %d\n", first + f[0],
                                 first + f[b->clockwise ? 3 : 1], first + f[2],
                                 first + f[b->clockwise ? 1 : 3]);
    }
}

static scene load_boxes(const box *boxes, int count) {
    char text[8192] = "";
    for (int i = 0; i < count; i++)
        add_box(text, sizeof text, &boxes[i], i);
    folder_write_text("boxes.obj", text);
    return load(in_folder("boxes.obj"));
}

/* Returns 1 where every triangle and normal of a box with a given middle faces away from it, -1
 * where all face it, and 0 otherwise. The box is recognized by the distance of its corners. */
static int outwards(const scene *s, float middle, float half_size) {
    size_t out = 0, in = 0;
    for (size_t i = 0; i < s->index_count; i += 3) {
        const scene_vertex *v[3];
        double corner = 0, along = 0, wound = 0;
        for (int k = 0; k < 3; k++)
            v[k] = &s->vertices[s->indices[i + (size_t)k]];
        for (int k = 0; k < 3; k++) {
            const int d = (k + 1) % 3, e = (k + 2) % 3;
            const double away = (double)(v[0]->position[k] - middle);
            corner = fmax(corner, fabs(away));
            along += away * (double)v[0]->normal[k];
            wound += away * (double)((v[1]->position[d] - v[0]->position[d]) *
                                         (v[2]->position[e] - v[0]->position[e]) -
                                     (v[1]->position[e] - v[0]->position[e]) *
                                         (v[2]->position[d] - v[0]->position[d]));
        }
        if (fabs(corner - (double)half_size) > 1e-3)
            continue;
        out += along > 0 && wound > 0;
        in += along < 0 && wound < 0;
        if (!(along > 0 && wound > 0) && !(along < 0 && wound < 0))
            return 0;
    }
    return out > 0 && in == 0 ? 1 : in > 0 && out == 0 ? -1 : 0;
}

static void a_body_of_several_materials_shows_its_outside(void **state) {
    (void)state;
    for (int parts = 1; parts <= 6; parts++)
        for (int clockwise = 0; clockwise < 2; clockwise++) {
            scene s = load_boxes(&(box) { -2, 2, clockwise, 6, parts, "", 0, NULL }, 1);
            assert_int_equal(s.mesh_count, parts == 1 ? 1 : 6);
            assert_unit_and_inside(&s);
            assert_int_equal(outwards(&s, 0, 2), 1);
            assert_false(scene_is_inside(&s));
            scene_free(&s);
        }
}

/* One body is mirrored, like a part that somebody copied to the other side. */
static void each_body_is_turned_by_itself(void **state) {
    (void)state;
    const box boxes[] = { { -3, -2, false, 6, 1, "", 0, NULL }, { 2, 3, true, 6, 2, "", 0, NULL } };
    scene s = load_boxes(boxes, 2);
    assert_int_equal(outwards(&s, -2.5f, 0.5f), 1);
    assert_int_equal(outwards(&s, 2.5f, 0.5f), 1);
    scene_free(&s);
}

/* Clockwise walls around a body that is not clockwise are those of a room; around a clockwise body,
 * the whole file is clockwise. */
static void what_a_body_holds_tells_whether_it_is_a_room(void **state) {
    (void)state;
    for (int clockwise = 0; clockwise < 2; clockwise++) {
        const box boxes[] = { { -4, 4, true, 6, 1, "o walls\n", 0, NULL },
                              { -1, 1, clockwise, 6, 1, "o chest\n", 0, NULL } };
        scene s = load_boxes(boxes, 2);
        assert_int_equal(outwards(&s, 0, 1), 1);
        assert_int_equal(outwards(&s, 0, 4), clockwise ? 1 : -1);
        scene_free(&s);
    }
}

/* Furniture stands on the floor and against a wall. */
static void what_touches_a_room_from_inside_is_in_it(void **state) {
    (void)state;
    const box boxes[] = { { -4, 4, true, 6, 1, "o walls\n", 0, NULL },
                          { -4, -2, false, 6, 1, "o chest\n", 3, NULL } };
    scene s = load_boxes(boxes, 2);
    assert_true(scene_is_inside(&s));
    scene_free(&s);
    s = load_boxes(boxes, 1);
    assert_false(scene_is_inside(&s));
    scene_free(&s);
}

/* A slab from wall to wall is a part of the body that it divides. */
static void what_is_as_wide_as_a_body_makes_it_no_room(void **state) {
    (void)state;
    static const float slab[] = { 2, 3 };
    const box boxes[] = { { -4, 4, true, 6, 1, "o walls\n", 0, NULL },
                          { -4, 4, false, 6, 1, "o slab\n", 0, slab } };
    scene s = load_boxes(boxes, 2);
    assert_false(scene_is_inside(&s));
    scene_free(&s);
}

static void a_hollow_stays_hollow(void **state) {
    (void)state;
    const box boxes[] = { { -4, 4, false, 6, 1, "", 0, NULL }, { -1, 1, true, 6, 1, "", 0, NULL } };
    scene s = load_boxes(boxes, 2);
    assert_int_equal(outwards(&s, 0, 4), 1);
    assert_int_equal(outwards(&s, 0, 1), -1);
    scene_free(&s);
}

/* A box without a lid follows the bodies beside it; without any, it is kept as it is. */
static void what_is_open_goes_with_the_bodies(void **state) {
    (void)state;
    const box boxes[] = { { -4, -2, true, 5, 1, "", 0, NULL }, { 2, 3, true, 6, 1, "", 0, NULL } };
    scene s = load_boxes(boxes, 2);
    assert_int_equal(outwards(&s, 2.5f, 0.5f), 1);
    assert_int_equal(outwards(&s, -3, 1), 1);
    scene_free(&s);
    s = load_boxes(boxes, 1);
    assert_int_equal(outwards(&s, -3, 1), -1);
    scene_free(&s);
}

static void write_stl(const char *name, bool clockwise, int normal) {
    char text[8192] = "solid s\n";
    size_t used = strlen(text);
    for (int i = 0; i < 12; i++) {
        const int *f = faces[i / 2], second = i % 2 ? 2 : 1;
        const int corners[3] = { f[0], f[clockwise ? second + 1 : second],
                                 f[clockwise ? second : second + 1] };
        used +=
            (size_t)snprintf(text + used, sizeof text - used, "facet normal %d %d %d\nouter loop\n",
                             i / 4 == 0 ? (i / 2 == 0 ? -normal : normal) : 0,
                             i / 4 == 1 ? (i / 2 == 2 ? -normal : normal) : 0,
                             i / 4 == 2 ? (i / 2 == 4 ? -normal : normal) : 0);
        for (int k = 0; k < 3; k++)
            used += (size_t)snprintf(text + used, sizeof text - used, "vertex %d %d %d\n",
                                     (corners[k] - 1) & 4 ? 2 : -2, (corners[k] - 1) & 2 ? 2 : -2,
                                     (corners[k] - 1) & 1 ? 2 : -2);
        used += (size_t)snprintf(text + used, sizeof text - used, "endloop\nendfacet\n");
    }
    snprintf(text + used, sizeof text - used, "endsolid s\n");
    folder_write_text(name, text);
}

/* Normals of an STL follow from its corners if they are right; some are not. */
static void an_stl_is_turned_whatever_its_normals_say(void **state) {
    (void)state;
    for (int clockwise = 0; clockwise < 2; clockwise++)
        for (int normal = -1; normal <= 1; normal++) {
            write_stl("s.stl", clockwise, normal);
            scene s = load(in_folder("s.stl"));
            assert_int_equal(outwards(&s, 0, 2), 1);
            scene_free(&s);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_of_several_materials_shows_its_outside),
        cmocka_unit_test(each_body_is_turned_by_itself),
        cmocka_unit_test(what_a_body_holds_tells_whether_it_is_a_room),
        cmocka_unit_test(what_touches_a_room_from_inside_is_in_it),
        cmocka_unit_test(what_is_as_wide_as_a_body_makes_it_no_room),
        cmocka_unit_test(a_hollow_stays_hollow),
        cmocka_unit_test(what_is_open_goes_with_the_bodies),
        cmocka_unit_test(an_stl_is_turned_whatever_its_normals_say),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
