/* SPDX-License-Identifier: MIT */
/* glTF files with compressed buffer views: what meshoptimizer's encoders packed is drawn, and what
 * cannot be unpacked is named. */
#include "tests/program/folder.h"
#include "tests/program/load.h"

#include <meshoptimizer.h>

enum { SIDE = 9, VERTICES = SIDE * SIDE, CORNERS = 6 * (SIDE - 1) * (SIDE - 1) };

/* A curved sheet. */
static float positions[VERTICES][3];
static float normals[VERTICES][4];
static signed char stored_normals[VERTICES][4]; /* normals as the filter stores them */
static unsigned corners[CORNERS];

static void make_sheet(void) {
    for (int i = 0; i < VERTICES; i++) {
        const double x = i % SIDE / 4.0 - 1, y = i / SIDE / 4.0 - 1, z = 2 + x * x / 2;
        const double length = sqrt(x * x + 1);
        const float position[3] = { (float)x, (float)y, (float)z };
        const float normal[4] = { (float)(-x / length), 0, (float)(1 / length), 0 };
        memcpy(positions[i], position, sizeof position);
        memcpy(normals[i], normal, sizeof normal);
    }
    unsigned *to = corners;
    for (unsigned y = 0; y + 1 < SIDE; y++)
        for (unsigned x = 0; x + 1 < SIDE; x++) {
            const unsigned a = y * SIDE + x,
                           quad[6] = { a, a + 1, a + SIDE, a + SIDE, a + 1, a + SIDE + 1 };
            memcpy(to, quad, sizeof quad);
            to += 6;
        }
    meshopt_encodeFilterOct(stored_normals, VERTICES, 4, 8, &normals[0][0]);
}

/* --- the files -------------------------------------------------------------------------------- */

/* Three views of one buffer, one after the other: positions, normals, indices. */
typedef struct packed {
    unsigned char bytes[16384];
    size_t sizes[3];
} packed;

static size_t start_of(const packed *p, int view) {
    size_t at = 0;
    for (int i = 0; i < view; i++)
        at += p->sizes[i];
    return at;
}

static packed pack(bool triangles) {
    packed p = { .sizes = { 0 } };
    unsigned char *at = p.bytes;
    p.sizes[0] = meshopt_encodeVertexBuffer(at, 4096, positions, VERTICES, 12);
    at += p.sizes[0];
    p.sizes[1] = meshopt_encodeVertexBuffer(at, 4096, stored_normals, VERTICES, 4);
    at += p.sizes[1];
    p.sizes[2] = triangles ? meshopt_encodeIndexBuffer(at, 4096, corners, CORNERS)
                           : meshopt_encodeIndexSequence(at, 4096, corners, CORNERS);
    for (int i = 0; i < 3; i++)
        assert_true(p.sizes[i] > 0);
    return p;
}

static const char *const document =
    "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
    "\"extensionsUsed\":[\"KHR_mesh_quantization\",\"%s\"],"
    "\"extensionsRequired\":[\"KHR_mesh_quantization\",\"%s\"],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":2}]}],"
    "\"accessors\":["
    "{\"bufferView\":0,\"componentType\":5126,\"count\":81,\"type\":\"VEC3\"},"
    "{\"bufferView\":1,\"componentType\":5120,\"normalized\":true,\"count\":81,\"type\":\"VEC3\"},"
    "{\"bufferView\":2,\"componentType\":5125,\"count\":384,\"type\":\"SCALAR\"}],"
    "\"bufferViews\":["
    "{\"buffer\":1,\"byteLength\":972,\"byteStride\":12,\"extensions\":{\"%s\":{\"buffer\":0,"
    "\"byteLength\":%zu,\"byteStride\":12,\"count\":81,\"mode\":\"ATTRIBUTES\"}}},"
    "{\"buffer\":1,\"byteOffset\":972,\"byteLength\":324,\"byteStride\":4,\"extensions\":{\"%s\":{"
    "\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,\"byteStride\":4,\"count\":81,"
    "\"mode\":\"ATTRIBUTES\",\"filter\":\"%s\"}}},"
    "{\"buffer\":1,\"byteOffset\":1296,\"byteLength\":1536,\"extensions\":{\"%s\":{\"buffer\":0,"
    "\"byteOffset\":%zu,\"byteLength\":%zu,\"byteStride\":4,\"count\":384,\"mode\":\"%s\"}}}],"
    "\"buffers\":[{\"byteLength\":%zu,\"uri\":\"packed.bin\"},"
    "{\"byteLength\":2832,%s\"extensions\":{\"%s\":{\"fallback\":true}}}]}";

typedef struct variant {
    const char *extension, *filter, *mode, *fallback;
} variant;

static void write_file(const variant *v, const packed *p) {
    char text[4096];
    const char *const name = v->extension;
    const int length = snprintf(text, sizeof text, document, name, name, name, p->sizes[0], name,
                                start_of(p, 1), p->sizes[1], v->filter, name, start_of(p, 2),
                                p->sizes[2], v->mode, start_of(p, 3), v->fallback, name);
    assert_in_range(length, 1, sizeof text - 1);
    folder_write_text("packed.gltf", text);
    folder_write("packed.bin", p->bytes, start_of(p, 3));
}

/* --- what is read of them --------------------------------------------------------------------- */

/* Finds a triangle of the sheet. Indices may come as another rotation of it: its three positions
 * keep their order. */
static void check_triangle(const scene *s, size_t triangle) {
    const float *wanted[3], *found[3];
    for (size_t k = 0; k < 3; k++) {
        wanted[k] = positions[corners[3 * triangle + k]];
        found[k] = s->vertices[s->indices[3 * triangle + k]].position;
    }
    for (size_t turn = 0; turn < 3; turn++) {
        bool same = true;
        for (size_t k = 0; k < 3; k++)
            same = same && memcmp(wanted[k], found[(k + turn) % 3], sizeof *positions) == 0;
        if (same)
            return;
    }
    fail_msg("triangle %zu is another one", triangle);
}

static void check_sheet(const scene *s, double bound) {
    assert_int_equal(s->index_count, CORNERS);
    for (size_t i = 0; i < CORNERS / 3; i++)
        check_triangle(s, i);
    for (size_t i = 0; i < s->vertex_count; i++) {
        const float *p = s->vertices[i].position, *n = s->vertices[i].normal;
        const double length = sqrt((double)p[0] * (double)p[0] + 1);
        CHECK_WITHIN(fabs((double)n[0] + (double)p[0] / length), bound);
        CHECK_WITHIN(fabs((double)n[1]), bound);
        CHECK_WITHIN(fabs((double)n[2] - 1 / length), bound);
    }
}

static void compressed_views_are_what_they_were(void **state) {
    (void)state;
    static const char *const extensions[] = { "EXT_meshopt_compression",
                                              "KHR_meshopt_compression" };
    for (int i = 0; i < 4; i++) {
        const packed p = pack(i / 2);
        write_file(
            &(variant) { extensions[i % 2], "OCTAHEDRAL", i / 2 ? "TRIANGLES" : "INDICES", "" },
            &p);
        scene s = load(in_folder("packed.gltf"));
        check_sheet(&s, 0.012); /* with 8 bits each */
        scene_free(&s);
    }
}

static void refuse(const variant *v, const packed *p, const char *reason) {
    scene s;
    base_error error = { "" };
    write_file(v, p);
    if (scene_load(in_folder("packed.gltf"), &(scene_options) { .no_cache = true }, &s, &error))
        fail_msg("read, and not refused as \"%s\"", reason);
    if (!strstr(error.text, reason))
        fail_msg("\"%s\" is not refused as \"%s\"", error.text, reason);
}

static void what_cannot_be_unpacked_is_named(void **state) {
    (void)state;
    const variant plain = { "KHR_meshopt_compression", "NONE", "TRIANGLES", "" };
    variant other = plain;
    packed p = pack(true);
    other.filter = "COLOR";
    refuse(&other, &p, "bufferView 1 has the color filter, which is not supported");
    other.filter = "QUATERNION";
    refuse(&other, &p, "bufferView 1 is compressed with a stride that its filter does not have");
    other = plain;
    other.mode = "INDICES";
    refuse(&other, &p, "bufferView 2 is compressed in another way than its mode");
    p.bytes[0]++;
    refuse(&plain, &p, "bufferView 0 is compressed by a newer version of meshoptimizer");
    p.bytes[0]--;
    p.sizes[0] -= 40;
    memmove(p.bytes + p.sizes[0], p.bytes + p.sizes[0] + 40, p.sizes[1] + p.sizes[2]);
    refuse(&plain, &p, "bufferView 0 has damaged compressed data");
}

/* Plain bytes for readers without the extension are taken where a stream is too new; otherwise they
 * need not be there. */
static void a_newer_stream_falls_back_to_plain_bytes(void **state) {
    (void)state;
    variant v = { "KHR_meshopt_compression", "COLOR", "TRIANGLES", "\"uri\":\"plain.bin\"," };
    packed p = pack(true);
    refuse(&v, &p, "bufferView 1 has the color filter");
    v.filter = "OCTAHEDRAL";
    write_file(&v, &p);
    scene s = load(in_folder("packed.gltf"));
    scene_free(&s);
    unsigned char plain[2832];
    memcpy(plain, positions, 972);
    for (int i = 0; i < VERTICES; i++)
        for (int k = 0; k < 4; k++)
            plain[972 + 4 * i + k] = (unsigned char)lrintf(127 * normals[i][k]);
    memcpy(plain + 1296, corners, sizeof corners);
    folder_write("plain.bin", plain, sizeof plain);
    v.filter = "COLOR";
    p.bytes[0]++;
    write_file(&v, &p);
    s = load(in_folder("packed.gltf"));
    check_sheet(&s, 0.012);
    scene_free(&s);
}

static int make(void **state) {
    make_sheet();
    return folder_make(state);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(compressed_views_are_what_they_were),
        cmocka_unit_test(what_cannot_be_unpacked_is_named),
        cmocka_unit_test(a_newer_stream_falls_back_to_plain_bytes),
    };
    return cmocka_run_group_tests(tests, make, folder_remove);
}
