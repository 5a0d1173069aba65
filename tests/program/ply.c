/* SPDX-License-Identifier: MIT */
/* PLY: elements of any number, as text and in both byte orders. */
#include "app/scene/builder.h"
#include "app/scene/instance.h"
#include "app/scene/scene.h"
#include "tests/program/folder.h"
#include "tests/program/load.h"

#define POSITIONS "property float x\nproperty float y\nproperty float z\n"
#define ASCII     "ply\nformat ascii 1.0\n"
#define QUAD      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
#define FACES(n)  "element face " n "\nproperty list uchar int vertex_indices\n"

static scene load_text(const char *text) {
    folder_write_text("m.ply", text);
    return load(in_folder("m.ply"));
}

static void polygons_are_fans(void **state) {
    (void)state;
    scene s = load_text(ASCII "element vertex 4\n" POSITIONS FACES("1") "end_header\n" QUAD
                                                                        "4 0 1 2 3\n");
    assert_int_equal(scene_triangle_count(&s), 2);
    CHECK_WITHIN(fabs(scene_area(&s) - 1), 1e-6);
    assert_unit_and_inside(&s);
    scene_free(&s);
}

/* Every second triangle of a strip is reversed, and each strip starts again. */
static void strips_are_triangles(void **state) {
    (void)state;
    scene s = load_text(ASCII "element vertex 4\n" POSITIONS
                              "element tristrips 1\nproperty list int int vertex_indices\n"
                              "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n"
                              "11 0 1 2 3 -1 0 1 1 -1 3 2\n");
    assert_int_equal(scene_triangle_count(&s), 2);
    for (size_t i = 0; i < s.vertex_count; i++)
        CHECK_WITHIN(fabs((double)s.vertices[i].normal[2] - 1), 1e-6);
    CHECK_WITHIN(fabs(scene_area(&s) - 1), 1e-6);
    scene_free(&s);
}

typedef struct bytes {
    unsigned char data[1024];
    size_t size;
    bool big;
} bytes;

static void put(bytes *b, const void *value, size_t size) {
    const unsigned char *const from = value; /* little-endian, like the machines of tests */
    for (size_t i = 0; i < size; i++)
        b->data[b->size++] = from[b->big ? size - 1 - i : i];
}

/* Positions are a float, a double and a short; unknown properties are skipped. The first byte of
 * the data is a line feed. */
static void numbers_of_every_kind_are_read(void **state) {
    (void)state;
    static const float corners[3][3] = { { 0, 0, -3 }, { 2, 0, -3 }, { 0, 2, -3 } };
    for (int big = 0; big < 2; big++)
        for (int windows = 0; windows < 2; windows++) {
            const char *const lines[] = { "ply",
                                          big ? "format binary_big_endian 1.0"
                                              : "format binary_little_endian 1.0",
                                          "element odd 1",
                                          "property uchar a",
                                          "property list uchar ushort b",
                                          "element vertex 3",
                                          "property float x",
                                          "property double y",
                                          "property short z",
                                          "element face 1",
                                          "property uint flags",
                                          "property list uint ushort vertex_index",
                                          "end_header" };
            bytes b = { .big = big };
            for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
                b.size += (size_t)sprintf((char *)b.data + b.size, "%s%s", lines[i],
                                          windows ? "\r\n" : "\n");
            put(&b, &(uint8_t) { '\n' }, 1);
            put(&b, &(uint8_t) { 1 }, 1);
            put(&b, &(uint16_t) { 7 }, 2);
            for (int i = 0; i < 3; i++) {
                put(&b, &corners[i][0], 4);
                put(&b, &(double) { (double)corners[i][1] }, 8);
                put(&b, &(int16_t) { (int16_t)corners[i][2] }, 2);
            }
            put(&b, &(uint32_t) { 9 }, 4);
            put(&b, &(uint32_t) { 3 }, 4);
            for (uint16_t i = 0; i < 3; i++)
                put(&b, &i, 2);
            folder_write("b.ply", b.data, b.size);
            scene s = load(in_folder("b.ply"));
            assert_int_equal(s.index_count, 3);
            for (int i = 0; i < 3; i++)
                for (int k = 0; k < 3; k++)
                    assert_true(s.vertices[s.indices[i]].position[k] == corners[i][k]);
            scene_free(&s);
        }
}

/* The colors are those that a screen shows. */
static void colors_of_vertices_are_drawn(void **state) {
    (void)state;
    static const char *const types[] = { "uchar", "ushort", "float" };
    static const char *const colors[] = { "255 0 188", "65535 0 48316", "1 -1 0.737255" };
    for (int i = 0; i < 3; i++) {
        char text[1024];
        snprintf(text, sizeof text,
                 ASCII "element vertex 3\n" POSITIONS
                       "property %s red\nproperty %s green\nproperty %s blue\n" FACES(
                           "1") "end_header\n0 0 0 %s\n1 0 0 %s\n0 1 0 %s\n3 0 1 2\n",
                 types[i], types[i], types[i], colors[i], colors[i], colors[i]);
        scene s = load_text(text);
        assert_true(s.materials[s.meshes[0].material].flags & SCENE_VERTEX_COLORS);
        assert_int_equal(s.vertices[0].color[0], 65535);
        assert_int_equal(s.vertices[0].color[1], 0);
        CHECK_WITHIN(fabs(s.vertices[0].color[2] / 65535.0 - 0.5029), 1e-4);
        scene_free(&s);
    }
}

/* Coordinates are those of corners, as MeshLab writes them, and those of vertices. */
static void coordinates_of_textures_are_read(void **state) {
    (void)state;
    scene s = load_text(ASCII "element vertex 3\n" POSITIONS "element face 1\n"
                              "property list uchar int vertex_indices\n"
                              "property list uchar float texcoord\nend_header\n"
                              "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0.125 0.25 0.5 0.625 0.75 1\n");
    assert_true(s.vertices[s.indices[1]].uv[0][0] == 0.5f);
    assert_true(s.vertices[s.indices[1]].uv[0][1] == 0.375f);
    scene_free(&s);
    s = load_text(ASCII
                  "comment TextureFile gone.png\nelement vertex 3\n" POSITIONS
                  "property float s\nproperty float t\n" FACES(
                      "1") "end_header\n0 0 0 0.125 0.25\n1 0 0 0.5 0.625\n0 1 0 0 0\n3 0 1 2\n");
    assert_true(s.vertices[s.indices[1]].uv[0][1] == 0.375f);
    assert_int_equal(s.unsupported_count, 1);
    assert_string_equal(s.unsupported[0].noun, "missing file");
    scene_free(&s);
}

/* Exporters write more than they declare, and lose the end. */
static void lines_may_hold_more_and_faces_be_missing(void **state) {
    (void)state;
    scene s =
        load_text("ply\nformat ascii 1.0\nmade by somebody\nelement vertex 4\n" POSITIONS FACES(
            "3") "end_header\n0 0 0 9 9\n1 0 0\n1 1 0 7\n0 1 0\n3 0 1 2 9 1 1 1\n3 0 2 3\n");
    assert_int_equal(scene_triangle_count(&s), 2);
    CHECK_WITHIN(fabs(scene_area(&s) - 1), 1e-6);
    assert_int_equal(s.unsupported_count, 1);
    assert_string_equal(s.unsupported[0].noun, "missing face");
    assert_int_equal(s.unsupported[0].count, 1);
    scene_free(&s);
}

/* The line on stderr says what is wrong with a file that is not a PLY. */
static void what_is_no_ply_is_refused(void **state) {
    (void)state;
    static const struct {
        const char *text, *said;
    } files[] = {
        { "plx\n", "is not a PLY file" },
        { "ply\nformat ascii 1.0\n", "line 3 does not end" },
        { "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\nend_header\n",
          "line 4 names an unknown type" },
        { "ply\nformat text 1.0\nend_header\n", "line 2 names an unknown format" },
        { "ply\nend_header\n", "it names no format" },
        { ASCII "property float x\nend_header\n", "line 3 has a property of no element" },
        { ASCII "element vertex -1\nend_header\n", "line 3 has no number of elements" },
        { ASCII "element vertex 99\n" POSITIONS "end_header\n0 0 0\n",
          "it has more vertices than bytes" },
        { ASCII "element vertex 3\n" POSITIONS "end_header\n0 0 0 1 0 0\n",
          "it ends before its elements do" },
        { ASCII "element vertex 1\n" POSITIONS "end_header\n0 zero 0\n",
          "it has a word where a number belongs" },
        { ASCII "element vertex 4\n" POSITIONS FACES("1") "end_header\n" QUAD "3 0 1 4\n",
          "it has a face with a vertex that does not exist" },
        { ASCII "element vertex 4\n" POSITIONS FACES("1") "end_header\n" QUAD "200 0 1 2\n",
          "it has a list that is longer than the file" },
        { ASCII "element vertex 4\n" POSITIONS "end_header\n" QUAD,
          "has no triangles, only points" },
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        scene s;
        base_error error = { "" };
        folder_write_text("bad.ply", files[i].text);
        assert_false(
            scene_load(in_folder("bad.ply"), &(scene_options) { .no_cache = true }, &s, &error));
        if (!strstr(error.text, files[i].said))
            fail_msg("%s", error.text);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygons_are_fans),
        cmocka_unit_test(strips_are_triangles),
        cmocka_unit_test(numbers_of_every_kind_are_read),
        cmocka_unit_test(colors_of_vertices_are_drawn),
        cmocka_unit_test(coordinates_of_textures_are_read),
        cmocka_unit_test(lines_may_hold_more_and_faces_be_missing),
        cmocka_unit_test(what_is_no_ply_is_refused),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
