/* SPDX-License-Identifier: MIT */
/* Scenes that are truncated, damaged or malicious. */
#include "tests/program/refused.h"

/* Asserts that the program refuses the scene of this name in the folder. */
static void assert_refused(const char *name, const char *expected) {
    char path[512];
    snprintf(path, sizeof path, "%s", in_folder(name));
    const char *const arguments[] = { "lampion", "info", path, NULL };
    const int before = count_entries(folder);
    assert_one_line(run_program(arguments), name, expected);
    assert_int_equal(count_entries(folder), before);
}

/* A PNG of one white pixel. */
static const unsigned char pixel_png[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
    0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00,
    0x00, 0x1f, 0x15, 0xc4, 0x89, 0x00, 0x00, 0x00, 0x0b, 0x49, 0x44, 0x41, 0x54, 0x78,
    0x9c, 0x63, 0xf8, 0x0f, 0x04, 0x00, 0x09, 0xfb, 0x03, 0xfd, 0xfb, 0x5e, 0x6b, 0x2b,
    0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82
};

/* --- a valid file to damage ------------------------------------------------------------------- */

#define HEAD                                                                                       \
    "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
#define MESH "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
#define ACCESSOR                                                                                   \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
#define VIEW   "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
#define BUFFER "\"buffers\":[{\"byteLength\":36,\"uri\":\"triangle.bin\"}]}"

static const float triangle[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };

static void a_valid_file_is_read(void **state) {
    (void)state;
    char path[512];
    folder_write_text("valid.gltf", HEAD MESH ACCESSOR VIEW BUFFER);
    snprintf(path, sizeof path, "%s", in_folder("valid.gltf"));
    const char *const arguments[] = { "lampion", "info", path, NULL };
    assert_int_equal(run_program(arguments), 0);
}

static void what_is_no_scene_is_refused(void **state) {
    (void)state;
    folder_write_text("empty.gltf", "");
    folder_write_text("blank.gltf", " \n");
    folder_write_text("text.obj", "nothing to see here\n");
    folder_write_text("letter.ase", "hello world, this is a letter\n");
    assert_refused("letter.ase", "has no triangles");
    folder_write_text("text.glb", "nothing to see here\n");
    assert_refused("text.glb", "is not a GLB file: its first bytes are not \"glTF\"");
    folder_write_text("json.glb", " \n{\"asset\":{\"version\":\"2.0\"}}");
    assert_refused("json.glb", "has no triangles");
    folder_write_text("text.stl", "nothing to see here\n");
    assert_refused("text.stl", "is damaged, or of a version or kind that Assimp cannot read: ");
    folder_write_text("text.gltf", "nothing to see here\n");
    folder_write_text("mark.gltf", "\xef\xbb\xbf{\"asset\":{\"version\":\"2.0\"}}");
    folder_write_text("wrong.txt", "v 0 0 0\n");
    folder_write_text("image.png", "\x89PNG\r\n\x1a\n");
    mkdir(in_folder("directory.gltf"), 0700);
    assert_int_equal(mkfifo(in_folder("fifo.gltf"), 0600), 0);
    assert_refused("missing.gltf", "does not exist");
    assert_refused("empty.gltf", "is empty");
    assert_refused("blank.gltf", "is not valid JSON");
    assert_refused("text.obj", "text.obj: ");
    assert_refused("text.gltf", "is not valid JSON");
    assert_refused("mark.gltf", "has no triangles");
    assert_refused("wrong.txt", "is not a scene");
    assert_refused("image.png", "is not a scene");
    assert_refused("directory.gltf", "is a directory");
    assert_refused("fifo.gltf", "is not a regular file");
    assert_refused("a\nname\x1b[31m", "does not exist");
}

/* A point and a line are not surfaces; the smallest triangle, and one beside them, are. */
static void triangles_without_an_area_are_no_scene(void **state) {
    (void)state;
    char path[512];
    folder_write_text("point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\nf 1 1 1\n");
    folder_write_text("cloud.obj", "v 0 0 0\nv 1 0 2\np 1 2\n");
    assert_refused("cloud.obj", "has no triangles (left out: points and lines (1 element))");
    folder_write_text("line.obj", "v 0 0 0\nv 1 0 2\nv 3 0 6\nf 1 2 3\n");
    folder_write_text("small.obj", "v 0 0 0\nv 1e-30 0 0\nv 0 1e-30 0\nf 1 2 3\n");
    folder_write_text("beside.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 1\nf 1 2 3\n");
    assert_refused("point.obj", "has no triangles but those without an area");
    assert_refused("line.obj", "has no triangles but those without an area");
    static const char *const taken[] = { "small.obj", "beside.obj" };
    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++) {
        snprintf(path, sizeof path, "%s", in_folder(taken[i]));
        const char *const arguments[] = { "lampion", "info", "--no-cache", path, NULL };
        assert_int_equal(run_program(arguments), 0);
    }
}

static void truncated_files_are_refused(void **state) {
    (void)state;
    static const char whole[] = HEAD MESH ACCESSOR VIEW BUFFER;
    for (size_t length = 1; length + 1 < sizeof whole; length += 13) {
        folder_write("truncated.gltf", whole, length);
        assert_refused("truncated.gltf", "is not valid JSON");
    }
    /* the valid file as GLB: header, JSON chunk, BIN chunk */
    static const char json[] = HEAD MESH ACCESSOR VIEW "\"buffers\":[{\"byteLength\":36}]}   ";
    const uint32_t json_size = (uint32_t)(sizeof json - 1) & ~3u, all = 12 + 8 + json_size + 8 + 36;
    const uint32_t head[5] = { 0x46546c67, 2, all, json_size, 0x4e4f534a };
    const uint32_t tail[2] = { 36, 0x004e4942 };
    char glb[2048];
    memcpy(glb, head, sizeof head);
    memcpy(glb + 20, json, json_size);
    memcpy(glb + 20 + json_size, tail, sizeof tail);
    memcpy(glb + 28 + json_size, triangle, sizeof triangle);
    char path[512];
    static const char *const names[] = { "whole.glb", "named.gltf" }; /* its bytes tell the type */
    for (int i = 0; i < 2; i++) {
        folder_write(names[i], glb, all);
        snprintf(path, sizeof path, "%s", in_folder(names[i]));
        const char *const arguments[] = { "lampion", "info", path, NULL };
        assert_int_equal(run_program(arguments), 0);
    }
    for (size_t length = 4; length < all; length += 17) {
        folder_write("truncated.glb", glb, length);
        assert_refused("truncated.glb", length < 20 ? "is not a GLB" : "is truncated");
    }
}

static void random_damage_never_crashes_the_program(void **state) {
    (void)state;
    static const char whole[] = HEAD MESH ACCESSOR VIEW BUFFER;
    char damaged[sizeof whole], path[512];
    snprintf(path, sizeof path, "%s", in_folder("damaged.gltf"));
    const char *const arguments[] = { "lampion", "info", "--no-cache", path, NULL };
    for (int round = 0; round < 40; round++) {
        memcpy(damaged, whole, sizeof whole);
        for (int i = 0; i <= round % 4; i++)
            damaged[(size_t)check_random_between(1.0, sizeof whole - 1.0)] =
                (char)check_random_between(32.0, 127.0);
        folder_write("damaged.gltf", damaged, sizeof whole - 1);
        const int status = run_program(arguments);
        if (status != 0)
            assert_one_line(status, damaged, "damaged.gltf: ");
    }
    for (int round = 0; round < 20; round++) {
        unsigned char noise[512];
        for (size_t i = 0; i < sizeof noise; i++)
            noise[i] = (unsigned char)check_random_between(0.0, 256.0);
        memcpy(noise, round % 2 ? "glTF\2\0\0\0" : "v 1 1 1\n", 8);
        folder_write("noise.obj", noise, sizeof noise);
        assert_refused("noise.obj", "noise.obj: ");
    }
}

/* --- lies and bombs --------------------------------------------------------------------------- */

static void counts_beyond_the_data_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *text, *expected;
    } cases[] = {
        { HEAD MESH "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4000000000,"
                    "\"type\":\"VEC3\"}]," VIEW BUFFER,
          "accessor 0" },
        { HEAD MESH "\"accessors\":[{\"componentType\":5126,\"count\":3000000000,"
                    "\"type\":\"VEC3\"}]," VIEW BUFFER,
          "accessor 0" },
        { HEAD MESH "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":-3,"
                    "\"type\":\"VEC3\"}]," VIEW BUFFER,
          "accessors[0].count" },
        { HEAD MESH "\"accessors\":[{\"bufferView\":7,\"componentType\":5126,\"count\":3,"
                    "\"type\":\"VEC3\"}]," VIEW BUFFER,
          "accessors[0].bufferView" },
        { HEAD MESH "\"accessors\":[{\"bufferView\":0,\"byteOffset\":1e30,\"componentType\":5126,"
                    "\"count\":3,\"type\":\"VEC3\"}]," VIEW BUFFER,
          "accessors[0].byteOffset" },
        { HEAD MESH ACCESSOR "\"bufferViews\":[{\"buffer\":0,\"byteLength\":99999999}]," BUFFER,
          "bufferView 0" },
        { HEAD MESH ACCESSOR "\"bufferViews\":[{\"buffer\":3,\"byteLength\":36}]," BUFFER,
          "bufferViews[0].buffer" },
        { HEAD MESH ACCESSOR VIEW
          "\"buffers\":[{\"byteLength\":99999999,\"uri\":\"triangle.bin\"}]}",
          "buffer 0" },
        { HEAD MESH ACCESSOR VIEW "\"buffers\":[{\"byteLength\":36}]}", "buffer 0" },
        { HEAD MESH ACCESSOR VIEW
          "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:a/b;base64,!!!!\"}]}",
          "buffer 0" },
        { HEAD
          "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":9}}]}]," ACCESSOR VIEW BUFFER,
          "meshes[0].primitives[0].attributes.POSITION" },
        { HEAD "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":5}]}]"
               "," ACCESSOR VIEW BUFFER,
          "meshes[0].primitives[0].material" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        folder_write_text("lie.gltf", cases[i].text);
        assert_refused("lie.gltf", cases[i].expected);
    }
}

/* Asserts that a valid file with these nodes before the others is refused. */
static void assert_nodes_refused(const char *nodes, const char *expected) {
    const size_t room = strlen(nodes) + 1024;
    char *text = malloc(room);
    assert_non_null(text);
    snprintf(text, room, "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],%s,%s",
             nodes, MESH ACCESSOR VIEW BUFFER);
    folder_write_text("nodes.gltf", text);
    free(text);
    assert_refused("nodes.gltf", expected);
}

static void impossible_nodes_are_refused(void **state) {
    (void)state;
    assert_nodes_refused("\"nodes\":[{\"mesh\":0,\"children\":[0]}]", "node 0");
    assert_nodes_refused("\"nodes\":[{\"children\":[1]},{\"mesh\":0,\"children\":[0]}]", "node 0");
    assert_nodes_refused(
        "\"nodes\":[{\"mesh\":0},{\"children\":[2]},{\"mesh\":0,\"children\":[1]}]", "in a loop");
    assert_nodes_refused("\"nodes\":[{\"children\":[1,1]},{\"mesh\":0}]",
                         "nodes[0].children has an entry twice");
    assert_nodes_refused("\"nodes\":[{\"children\":[2]},{\"children\":[2]},{\"mesh\":0}]",
                         "another parent");
    assert_nodes_refused("\"nodes\":[{\"children\":[17]}]", "nodes[0].children[0]");
    assert_nodes_refused("\"nodes\":[{\"mesh\":4}]", "nodes[0].mesh");
    assert_nodes_refused("\"nodes\":[{\"mesh\":0,\"scale\":[1e999,1,1]}]", "real number overflow");
    assert_nodes_refused("\"nodes\":[{\"mesh\":0,\"scale\":[NaN,1,1]}]", "is not valid JSON");
    assert_nodes_refused("\"nodes\":[{\"mesh\":0,\"scale\":[1e300,1e300,1]}]", "finite");
    assert_nodes_refused("\"nodes\":[{\"mesh\":0,\"translation\":[2e17,0,0]}]",
                         "finite position (up to");
    static char nested[200001];
    memset(nested, '[', sizeof nested - 1);
    nested[0] = '{';
    folder_write_text("nested.gltf", nested);
    assert_refused("nested.gltf", "is not valid JSON");
}

static void a_chain_of_many_nodes_is_read(void **state) {
    (void)state;
    enum { DEEP = 20000 };
    char *deep = malloc(32 * DEEP + 1024), path[512];
    assert_non_null(deep);
    size_t used =
        (size_t)sprintf(deep, "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
                              "\"nodes\":[");
    for (int i = 0; i < DEEP; i++)
        used += (size_t)sprintf(deep + used, "{\"children\":[%d]},", i + 1);
    sprintf(deep + used, "{\"mesh\":0}],%s", MESH ACCESSOR VIEW BUFFER);
    folder_write_text("deep.gltf", deep);
    free(deep);
    snprintf(path, sizeof path, "%s", in_folder("deep.gltf"));
    const char *const arguments[] = { "lampion", "info", path, NULL };
    assert_int_equal(run_program(arguments), 0);
}

static void bombs_end_quickly(void **state) {
    (void)state;
    /* One mesh in very many nodes: more triangles than 32 bits number, from a few. */
    enum { COPIES = 80000, TRIANGLES = 20000 };
    float *many = malloc(TRIANGLES * sizeof triangle);
    char *text = malloc(64 * COPIES), *end = text;
    assert_non_null(many);
    assert_non_null(text);
    for (int i = 0; i < TRIANGLES; i++)
        memcpy(many + 9 * i, triangle, sizeof triangle);
    folder_write("many.bin", many, TRIANGLES * sizeof triangle);
    end += sprintf(end, "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0");
    for (int i = 1; i < COPIES; i++)
        end += sprintf(end, ",%d", i);
    end += sprintf(end, "]}],\"nodes\":[{\"mesh\":0}");
    for (int i = 1; i < COPIES; i++)
        end += sprintf(end, ",{\"mesh\":0}");
    sprintf(end,
            "]," MESH "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%d,"
            "\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":%d}],"
            "\"buffers\":[{\"byteLength\":%d,\"uri\":\"many.bin\"}]}",
            3 * TRIANGLES, 36 * TRIANGLES, 36 * TRIANGLES);
    folder_write_text("bomb.gltf", text);
    free(many);
    free(text);
    assert_refused("bomb.gltf", "bomb.gltf: ");
}

/* Asserts that the program reads the scene of this name in the folder, says in one line what is
 * unsupported or missing, and refuses the scene if nothing may be. */
static void assert_unsupported(const char *name, const char *expected) {
    char path[512], line[1200], text[4096], strict[700];
    snprintf(path, sizeof path, "%s", in_folder(name));
    const char *const arguments[] = { "lampion", "info", path, NULL };
    const char *const strictly[] = { "lampion", "info", "--strict", path, NULL };
    snprintf(line, sizeof line, "lampion: %s: left out: %s\n", path, expected);
    snprintf(strict, sizeof strict, "left out: %s (not allowed by --strict)", expected);
    for (int cached = 0; cached < 2; cached++) {
        const int status = run_program(arguments);
        read_text("stderr", text, sizeof text);
        if (status != 0 || strcmp(text, line) != 0)
            fail_msg("%s: status %d, \"%s\" instead of \"%s\"", name, status, text, line);
    }
    assert_one_line(run_program(strictly), name, strict);
}

static void a_scene_goes_without_textures_that_cannot_be(void **state) {
    (void)state;
    static const char scene_text[] = HEAD
        "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
        "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"t.png\"}]," MESH ACCESSOR VIEW BUFFER;
    /* A PNG header of 2 000 000 000 × 4 pixels, then one of 16000 × 16000 without data. */
    static const unsigned char absurd[] = { 0x89, 'P', 'N', 'G', 13,  10,   26,   10,   0, 0, 0,
                                            13,   'I', 'H', 'D', 'R', 0x77, 0x35, 0x94, 0, 0, 0,
                                            0,    4,   8,   6,   0,   0,    0,    0,    0, 0, 0 };
    static const unsigned char large[] = { 0x89, 'P',  'N', 'G', 13,  10, 26, 10,   0,    0, 0,
                                           13,   'I',  'H', 'D', 'R', 0,  0,  0x3e, 0x80, 0, 0,
                                           0x3e, 0x80, 8,   6,   0,   0,  0,  0,    0,    0, 0 };
    folder_write_text("textured.gltf", scene_text);
    assert_unsupported("textured.gltf", "t.png (1 missing file)");
    folder_write("t.png", absurd, sizeof absurd);
    assert_unsupported("textured.gltf", "t.png (1 undecodable image)");
    folder_write("t.png", large, sizeof large);
    assert_unsupported("textured.gltf", "t.png (1 undecodable image)");
    folder_write_text("t.png", "no image");
    assert_unsupported("textured.gltf", "t.png (1 undecodable image)");
    unlink(in_folder("t.png"));
    mkdir(in_folder("t.png"), 0700);
    assert_unsupported("textured.gltf", "t.png (1 unreadable file)");
    rmdir(in_folder("t.png"));
    folder_write_text("embedded.gltf", HEAD
                      "\"materials\":[{\"emissiveTexture\":{\"index\":0}}],"
                      "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":"
                      "\"data:image/png;base64,bm8gcGljdHVyZQ==\"}]," MESH ACCESSOR VIEW BUFFER);
    assert_unsupported("embedded.gltf", "image 0 (1 undecodable image)");
}

/* --- files outside ---------------------------------------------------------------------------- */

static void files_outside_the_folder_are_never_read(void **state) {
    (void)state;
    static const char *const uris[] = { "../secret.bin",
                                        "sub/../../secret.bin",
                                        "/etc/passwd",
                                        "%2e%2e/secret.bin",
                                        "..\\\\secret.bin",
                                        "file:///etc/passwd",
                                        "http://example.com/a.bin",
                                        "link.bin",
                                        "linked/passwd" };
    mkdir(in_folder("inside"), 0700);
    folder_write("secret.bin", triangle, sizeof triangle);
    assert_int_equal(symlink("../secret.bin", in_folder("inside/link.bin")), 0);
    assert_int_equal(symlink("/etc", in_folder("inside/linked")), 0);
    for (size_t i = 0; i < sizeof uris / sizeof *uris; i++) {
        char text[1024];
        snprintf(text, sizeof text, "%s\"buffers\":[{\"byteLength\":36,\"uri\":\"%s\"}]}",
                 HEAD MESH ACCESSOR VIEW, uris[i]);
        folder_write_text("inside/outside.gltf", text);
        assert_refused("inside/outside.gltf", "folder");
    }
    folder_write_text("gone.gltf", HEAD MESH ACCESSOR VIEW
                      "\"buffers\":[{\"byteLength\":36,\"uri\":\"gone.bin\"}]}");
    assert_refused("gone.gltf", "\"gone.bin\", which does not exist");
}

/* What a scene can do without is reported as unread, under the name in the file: a stranger's
 * texture, if it were read, would be decoded and white. */
static void a_scene_goes_without_files_outside_the_folder(void **state) {
    (void)state;
    static const char *const names[] = {
        "../t.png",    "sub/../../t.png", "%2e%2e/t.png",         "..\\t.png",
        "/etc/passwd", "C:\\art\\t.png",  "file:///C:/art/t.png", "http://example.com/t.png"
    };
    char text[1024], expected[256];
    mkdir(in_folder("room"), 0700);
    folder_write("t.png", pixel_png, sizeof pixel_png);
    folder_write_text("room/outside.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                          "usemtl m\nf 1 2 3\n");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(text, sizeof text, "newmtl m\nKd 0.25 0.5 0.75\nmap_Kd %s\n", names[i]);
        folder_write_text("room/m.mtl", text);
        snprintf(expected, sizeof expected, "%s (1 file outside the folder)", names[i]);
        assert_unsupported("room/outside.obj", expected);
    }
    assert_int_equal(symlink("../t.png", in_folder("room/link.png")), 0);
    folder_write_text("room/m.mtl", "newmtl m\nKd 0.25 0.5 0.75\nmap_Kd link.png\n");
    assert_unsupported("room/outside.obj", "link.png (1 unreadable file)");
    folder_write_text("room/outside.obj", "mtllib ../secret.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                          "f 1 2 3\n");
    assert_unsupported("room/outside.obj", "../secret.mtl (1 file outside the folder)");
}

static int make_folder(void **state) {
    if (make_refused_folder(state))
        return -1;
    folder_write("triangle.bin", triangle, sizeof triangle);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_valid_file_is_read),
        cmocka_unit_test(what_is_no_scene_is_refused),
        cmocka_unit_test(triangles_without_an_area_are_no_scene),
        cmocka_unit_test(truncated_files_are_refused),
        cmocka_unit_test(random_damage_never_crashes_the_program),
        cmocka_unit_test(counts_beyond_the_data_are_refused),
        cmocka_unit_test(impossible_nodes_are_refused),
        cmocka_unit_test(a_chain_of_many_nodes_is_read),
        cmocka_unit_test(bombs_end_quickly),
        cmocka_unit_test(a_scene_goes_without_textures_that_cannot_be),
        cmocka_unit_test(files_outside_the_folder_are_never_read),
        cmocka_unit_test(a_scene_goes_without_files_outside_the_folder),
    };
    return cmocka_run_group_tests(tests, make_folder, folder_remove);
}
