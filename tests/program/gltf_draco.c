/* SPDX-License-Identifier: MIT */
/* glTF files whose primitives Draco compressed. */
#include "app/scene/gltf/draco.h"
#include "tests/program/folder.h"
#include "tests/program/load.h"

#include <unistd.h>

enum { SIDE = 9, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };

/* A sheet of 9 x 9 vertices, x and y from -1 to 1, z = 2 + x^2 / 2, its normals, and colors by the
 * number of the vertex, as Draco 1.5.5's edgebreaker packs it at its slowest: positions of 12 bits,
 * normals of 10. */
static const unsigned char sheet[] = {
    0x44, 0x52, 0x41, 0x43, 0x4f, 0x02, 0x02, 0x01, 0x01, 0x00, 0x00, 0x00, 0x51, 0x80, 0x01, 0x02,
    0x80, 0x01, 0x07, 0x00, 0x24, 0xef, 0xd3, 0xea, 0x53, 0xad, 0xea, 0x53, 0xd5, 0xaa, 0xea, 0x53,
    0x55, 0xad, 0xaa, 0xea, 0x53, 0x55, 0xd5, 0xaa, 0xaa, 0xea, 0x53, 0x55, 0x55, 0xad, 0xaa, 0xaa,
    0xea, 0x53, 0x55, 0x55, 0xd5, 0xaa, 0xaa, 0xaa, 0x1a, 0xff, 0x01, 0x11, 0xff, 0x02, 0x5a, 0x50,
    0xff, 0x02, 0x5a, 0x50, 0x03, 0xff, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x01, 0x00,
    0x09, 0x03, 0x00, 0x00, 0x02, 0x01, 0x01, 0x09, 0x03, 0x00, 0x01, 0x03, 0x01, 0x02, 0x02, 0x04,
    0x01, 0x02, 0x01, 0x04, 0x01, 0x01, 0x00, 0x0d, 0x03, 0xed, 0x34, 0xcc, 0x13, 0xcc, 0x1d, 0x07,
    0x95, 0x01, 0x03, 0xcc, 0x0c, 0x92, 0x0a, 0x0f, 0x7b, 0x28, 0x1c, 0x51, 0x84, 0xbf, 0xd6, 0xef,
    0x86, 0xff, 0xff, 0xff, 0x00, 0xf0, 0xbf, 0xff, 0x80, 0x00, 0xd0, 0x3f, 0x00, 0x00, 0x00, 0x00,
    0x44, 0x80, 0x00, 0x00, 0x40, 0x01, 0x00, 0x00, 0x00, 0x20, 0x00, 0x00, 0x00, 0x01, 0x00, 0x02,
    0x00, 0x00, 0x14, 0x00, 0x00, 0x00, 0x00, 0x00, 0x04, 0x00, 0x00, 0x20, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x01, 0x00, 0x00, 0x08, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x02,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x1d, 0xff, 0x02, 0xfb, 0x41, 0x62, 0xac,
    0x0d, 0x2c, 0xd7, 0x4a, 0x95, 0xf6, 0xb7, 0x9e, 0x9f, 0x30, 0xc3, 0x62, 0x3a, 0x59, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0xff, 0x0f, 0x00, 0x00, 0x00, 0x00, 0x80, 0xbf, 0x00, 0x00, 0x80, 0xbf,
    0x00, 0x00, 0x00, 0x40, 0x00, 0x00, 0x00, 0x40, 0x0c, 0x06, 0x03, 0x01, 0x01, 0x06, 0xfa, 0x07,
    0x81, 0x32, 0xcc, 0x17, 0xcc, 0x03, 0xcc, 0x0b, 0xcc, 0x07, 0x91, 0x03, 0x91, 0x03, 0xff, 0xff,
    0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x5f, 0xcc, 0x17,
    0xcc, 0x0b, 0xcc, 0x07, 0xcc, 0x1e, 0x3b, 0xc0, 0x1c, 0xf0, 0x8c, 0x41, 0x0b, 0x36, 0x06, 0x2a,
    0xff, 0x4a, 0x7b, 0x12, 0x80, 0x36, 0x54, 0x6a, 0x8c, 0x66, 0xe5, 0xb3, 0x4d, 0x53, 0xb8, 0x5f,
    0x73, 0xbb, 0x79, 0x83, 0xff, 0x03, 0x00, 0x00, 0xff, 0x01, 0x00, 0x00, 0xff, 0x02, 0x28, 0x46,
    0x0a, 0x04, 0x01, 0x01, 0x01, 0x06, 0xf1, 0x01, 0x61, 0x3e, 0x34, 0x2f, 0x34, 0x34, 0x07, 0x34,
    0x73, 0x34, 0x0f, 0x34, 0x6b, 0x34, 0xff, 0xff, 0x77, 0x34, 0x0c, 0xf8, 0xea, 0xc0, 0x0c, 0xb2,
    0xd1, 0xa2, 0xa6, 0xf0, 0xfe, 0x0f, 0x8e, 0x24, 0xff, 0x02, 0x80, 0x42, 0x4e, 0xff, 0x02, 0xe4,
    0x45, 0x03, 0xff, 0x01, 0x33, 0x08, 0xff, 0x02, 0x88, 0x40, 0x00, 0x00, 0x00, 0x00, 0xff, 0x00,
    0x00, 0x00
};

static void write_file(const char *more, const unsigned char *bytes, size_t size) {
    char text[4096];
    const int length = snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"extensionsUsed\":[\"KHR_draco_mesh_compression\"],"
        "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"COLOR_0\":2},"
        "\"indices\":3,\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":0,"
        "\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"COLOR_0\":2}}}%s}]}],"
        "\"accessors\":[{\"componentType\":5126,\"count\":81,\"type\":\"VEC3\"},"
        "{\"componentType\":5126,\"count\":81,\"type\":\"VEC3\"},"
        "{\"componentType\":5121,\"normalized\":true,\"count\":81,\"type\":\"VEC4\"},"
        "{\"componentType\":5123,\"count\":384,\"type\":\"SCALAR\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu}],"
        "\"buffers\":[{\"byteLength\":%zu,\"uri\":\"sheet.drc\"}]}",
        more, size, size);
    assert_in_range(length, 1, sizeof text - 1);
    folder_write_text("sheet.gltf", text);
    folder_write("sheet.drc", bytes, size);
}

static void check_vertex(const scene_vertex *v) {
    const double x = (double)v->position[0], y = (double)v->position[1];
    const double column = round(4 * (x + 1)), row = round(4 * (y + 1)), length = sqrt(x * x + 1);
    CHECK_WITHIN(fabs(4 * (x + 1) - column), 4e-3);
    CHECK_WITHIN(fabs(4 * (y + 1) - row), 4e-3);
    CHECK_WITHIN(fabs((double)v->position[2] - 2 - x * x / 2), 2e-3);
    CHECK_WITHIN(fabs((double)v->normal[0] + x / length), 6e-3);
    CHECK_WITHIN(fabs((double)v->normal[2] - 1 / length), 6e-3);
    const int number = (int)(SIDE * row + column);
    assert_int_equal(v->color[0], 257 * (3 * number % 256));
    assert_int_equal(v->color[1], 257 * (255 - number));
    assert_int_equal(v->color[2], 257 * 7);
}

static void a_compressed_mesh_is_what_it_was(void **state) {
    (void)state;
    write_file("", sheet, sizeof sheet);
    scene s = load(in_folder("sheet.gltf"));
    assert_int_equal(s.index_count, 3 * TRIANGLES);
    double area = 0;
    for (size_t i = 0; i < s.index_count; i += 3) {
        const float *a = s.vertices[s.indices[i]].position;
        const float *b = s.vertices[s.indices[i + 1]].position;
        const float *c = s.vertices[s.indices[i + 2]].position;
        const double own = ((double)b[0] - (double)a[0]) * ((double)c[1] - (double)a[1]) -
                           ((double)b[1] - (double)a[1]) * ((double)c[0] - (double)a[0]);
        assert_true(own > 0); /* seen from +z, all of them */
        area += own / 2;
    }
    CHECK_WITHIN(fabs(area - 4), 5e-3);
    for (size_t i = 0; i < s.vertex_count; i++)
        check_vertex(&s.vertices[i]);
    scene_free(&s);
}

static void refuse(const char *reason) {
    scene s;
    base_error error = { "" };
    if (scene_load(in_folder("sheet.gltf"), &(scene_options) { .no_cache = true }, &s, &error))
        fail_msg("read, and not refused as \"%s\"", reason);
    if (!strstr(error.text, reason))
        fail_msg("\"%s\" is not refused as \"%s\"", error.text, reason);
}

static void what_cannot_be_decoded_is_named(void **state) {
    (void)state;
    unsigned char damaged[sizeof sheet];
    memcpy(damaged, sheet, sizeof sheet);
    write_file("", sheet, sizeof sheet - 100);
    refuse("mesh 0 is compressed by Draco, and cannot be decoded");
    damaged[6] = 9; /* its version */
    write_file("", damaged, sizeof sheet);
    refuse("mesh 0 is compressed by Draco, and cannot be decoded");
    write_file(",\"mode\":5", sheet, sizeof sheet);
    refuse("mesh 0 is compressed by Draco and is not an indexed list of triangles");
}

/* Bytes that claim a billion faces must not allocate memory for them. */
static void few_bytes_are_not_many_faces(void **state) {
    (void)state;
    const unsigned char bytes[64] = "DRACO\2\2\1\0\0\0\377\377\377\377\3\377\377\377\377\3";
    assert_null(draco_mesh_decode(bytes, sizeof bytes));
}

/* --- a scene of others, plain and compressed -------------------------------------------------- */

enum { CELLS = 1 << 18 };

/* The vertices of a scene, by the cells of a grid that contain them. */
typedef struct cells {
    const scene *world;
    float size;
    int32_t *first, *next; /* first vertex of a cell, and next after a vertex; -1 for none */
} cells;

static uint32_t cell_of(const cells *c, const float p[3], int dx, int dy, int dz) {
    const uint32_t x = (uint32_t)((int32_t)floorf(p[0] / c->size) + dx);
    const uint32_t y = (uint32_t)((int32_t)floorf(p[1] / c->size) + dy);
    const uint32_t z = (uint32_t)((int32_t)floorf(p[2] / c->size) + dz);
    return (x * 73856093u ^ y * 19349663u ^ z * 83492791u) % CELLS;
}

static cells sort_into_cells(const scene *world, float size) {
    cells c = { world, size, malloc(CELLS * sizeof *c.first),
                malloc(world->vertex_count * sizeof *c.next) };
    assert_true(c.first && c.next);
    for (int i = 0; i < CELLS; i++)
        c.first[i] = -1;
    for (size_t i = 0; i < world->vertex_count; i++) {
        const uint32_t cell = cell_of(&c, world->vertices[i].position, 0, 0, 0);
        c.next[i] = c.first[cell];
        c.first[cell] = (int32_t)i;
    }
    return c;
}

static float nearest2(const cells *c, const float p[3]) {
    float least = INFINITY;
    for (int k = 0; k < 27; k++) {
        const uint32_t cell = cell_of(c, p, k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        for (int32_t i = c->first[cell]; i >= 0; i = c->next[i]) {
            const float *q = c->world->vertices[i].position;
            const float x = q[0] - p[0], y = q[1] - p[1], z = q[2] - p[2];
            least = fminf(least, x * x + y * y + z * z);
        }
    }
    return least;
}

/* Every vertex of one scene has a vertex of the other within half a step of 14 bits of the largest
 * mesh. */
static void check_near(const scene *a, const scene *b) {
    float step = 0;
    for (size_t i = 0; i < b->mesh_count; i++)
        for (int k = 0; k < 3; k++)
            step = fmaxf(step, (b->meshes[i].maximum[k] - b->meshes[i].minimum[k]) / 16383);
    cells c = sort_into_cells(b, step);
    const float most = 0.5f * step * 1.7321f * 1.01f;
    float worst = 0;
    for (size_t i = 0; i < a->vertex_count; i++)
        worst = fmaxf(worst, nearest2(&c, a->vertices[i].position));
    print_message("off by %.3g of a step of %.3g\n", (double)(sqrtf(worst) / step), (double)step);
    CHECK_WITHIN(sqrtf(worst), most);
    free(c.first);
    free(c.next);
}

static bool find_data(const char *name, char path[1024]) {
    static const char *const below[] = { "", "/data" };
    const char *data = getenv("LAMPION_DATA");
    for (int i = 0; data && i < 2; i++) {
        snprintf(path, 1024, "%s%s/sponza/%s", data, below[i], name);
        if (access(path, R_OK) == 0)
            return true;
    }
    print_message("skipped: LAMPION_DATA has no sponza/%s\n", name);
    return false;
}

static void a_compressed_scene_is_the_plain_one(void **state) {
    (void)state;
    char plain[1024], compressed[1024];
    if (!find_data("sponza.gltf", plain) || !find_data("sponza_draco_webp.glb", compressed))
        return;
    scene a = load(plain), b = load(compressed);
    assert_int_equal(a.index_count, 3 * 262267);
    assert_int_equal(b.index_count, a.index_count);
    check_near(&a, &b);
    check_near(&b, &a);
    scene_free(&a);
    scene_free(&b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_compressed_mesh_is_what_it_was),
        cmocka_unit_test(what_cannot_be_decoded_is_named),
        cmocka_unit_test(few_bytes_are_not_many_faces),
        cmocka_unit_test(a_compressed_scene_is_the_plain_one),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
