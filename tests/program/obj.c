/* SPDX-License-Identifier: MIT */
/* OBJ and MTL: what the format allows is read, what it forbids is refused with its line. */
#include "app/scene/load/obj.h"
#include "app/scene/instance.h"
#include "app/scene/scene.h"

#include "tests/program/folder.h"

#include <math.h>

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

typedef struct expectation {
    const char *text;
    size_t triangles;
    const char *said; /* the refusal, or with triangles what is unsupported; NULL for nothing */
} expectation;

/* Reads a text in this process. */
static bool reads(const char *text, scene_builder *builder, base_error *error) {
    source_set sources = { .subject = "input", .folder = folder };
    *builder = (scene_builder) { 0 };
    *error = (base_error) { .text = "" };
    const bool ok = obj_add(text, strlen(text), &sources, builder, error);
    sources_free(&sources);
    return ok;
}

static void expect(const expectation *v) {
    scene_builder builder;
    base_error error;
    char said[256] = "";
    const bool ok = reads(v->text, &builder, &error);
    if (builder_count(&builder, BLOB_UNSUPPORTED) > 0)
        scene_unsupported_text(builder_items(&builder, BLOB_UNSUPPORTED), said, sizeof said);
    const char *found = ok ? said : error.text;
    if (ok != (v->triangles > 0) ||
        (ok && builder_count(&builder, BLOB_INDICES) != 3 * v->triangles) ||
        (v->said ? !strstr(found, v->said) : found[0]))
        fail_msg("\"%s\": \"%s\" instead of \"%s\"", v->text, found, v->said ? v->said : "");
    builder_free(&builder);
}

static void the_grammar_is_read(void **state) {
    (void)state;
    static const expectation cases[] = {
        { TRIANGLE "f 1 2 3\n", 1, NULL },
        { TRIANGLE "f 1 2 3", 1, NULL },
        { "v\t0  0\t0 \r\n v 1e0 +0. .0E-3\r\nv 0 1 0 1.0\r\n\tf\t1\t2 3 # face\r\n", 1, NULL },
        { TRIANGLE "f 1 2 \\\n3\n", 1, NULL },
        { TRIANGLE "f -3 -2 -1\n", 1, NULL },
        { TRIANGLE "vt 0.5\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 1//1 2//1 3//1\nf 1/1 2/1 3/1\n", 3,
          NULL },
        { TRIANGLE "v 1 1 0\nf 1 2 4 3\n", 2, NULL },
        { TRIANGLE "fo 1 2 3\n", 1, NULL },
        { TRIANGLE "s off\ns 1\ng a b\ng\no x\nlod 3\nf 1 2 3\n", 1, NULL },
        { TRIANGLE "f 1 2 3\np 1\nl 1 2\n", 1, "points and lines (2 elements)" },
        { TRIANGLE "f 1 2 3\nvp 1 2\ncstype bspline\nsurf 0 1 0 1 1\nend\n", 1,
          "1 free-form curve" },
        { TRIANGLE "f 1 2 3\nfoo bar\nzzz\n", 1, "2 unknown statements" },
        { "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n", 1, "3 vertex colors" },
        { TRIANGLE "usemtl none\nf 1 2 3\n", 1, "none (1 missing material)" },
        { TRIANGLE "mtllib gone.mtl\nf 1 2 3\n", 1, "gone.mtl (1 missing file)" },
        { TRIANGLE "f 1 2 4\n", 0, "line 4 refers to a vertex that does not exist" },
        { TRIANGLE "f 1 2 0\n", 0, "line 4 refers" },
        { TRIANGLE "f 1 2 -4\n", 0, "line 4 refers" },
        { TRIANGLE "f 1 2 65536\n", 0, "line 4 refers" },
        { TRIANGLE "f 1 2 4294967297\n", 0, "line 4 refers" },
        { TRIANGLE "f 1 2 99999999999999999999\n", 0, "line 4 refers" },
        { TRIANGLE "f 1/1 2/1 3/1\n", 1, "missing texture coordinates (3 corners)" },
        { TRIANGLE "vt 0 0\nf 1/1/1 2/1/9 3/1/-2\n", 1, "missing normal (3 corners)" },
        { TRIANGLE "f 1 2 x\n", 0, "line 4 refers" },
        { TRIANGLE "f 1 2 3x\n", 0, "line 4 refers" },
        { TRIANGLE "f 1 2 3/1/1/1\n", 0, "line 4 refers" },
        { TRIANGLE "f 1 2 /1\n", 0, "line 4 refers" },
        { TRIANGLE "f 1 2\nf 1 2 3\nf\n", 1, "fewer than 3 vertices (2 faces)" },
        { "v 0 0\n", 0, "line 1 has too few numbers" },
        { "v 0 0 nan\n", 0, "line 1 has no finite number" },
        { "v 0 0 1e999\n", 0, "line 1 has no finite number" },
        { "v 0 0 0x10\n", 0, "line 1 has no finite number" },
        { "v 0 0 1,5\n", 0, "line 1 has no finite number" },
        { "vn 0 0 1 1\n", 0, "line 1 has no finite number" },
        { "mtllib\n", 0, "line 1 names no file" },
        { TRIANGLE "mtllib ../up.mtl\nf 1 2 3\n", 1, "../up.mtl (1 file outside the folder)" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect(&cases[i]);
}

static void a_library_s_statements_are_read(void **state) {
    (void)state;
    static const expectation cases[] = {
        { "newmtl a\nKd 1 0.5 0\nKs 0.5\nNs 10\n\nKe 0 0 1\nillum 2\n", 1, NULL },
        { "newmtl a\n\tKd\t1e0 .5 0\r\n# no\nTr 0.5\n", 1, NULL },
        { "newmtl a\nKa 1 1 1\nNi 1.5\nsharpness 60\n", 1, NULL },
        { "newmtl a\nPr 0.5\nPm 1\n", 1, NULL },
        { "newmtl a\nmap_Ns n.png\n", 1, "map_Ns (1 material)" },
        { "newmtl a\nTf 1 1 1\nd 0.5\n", 1, NULL },
        { "newmtl a\nTf 0.5 1 1\n", 1, NULL },
        { "newmtl a\nTf 0.5 1 1\nd 0.5\n", 1, "Tf (1 material)" },
        { "newmtl a\nTf 0.5 1 1\nTf 0.5 1 1\nd 0.5\ntf 1 0 0\n", 1, "Tf (1 material)" },
        { "newmtl a\nTf 0.5 x\n", 1, "MTL line 2, Tf (1 unreadable statement)" },
        { "newmtl a\nmap_Kd -clamp on gone.png\n", 1, "gone.png (1 missing file)" },
        { "newmtl a\nmap_Kd -s 2 2 -o 0.5 gone.png\n", 1, "-s (1 map)" },
        { "newmtl a\nKd red\n", 1, "MTL line 2, Kd (1 unreadable statement)" },
        { "newmtl a\n\nKd 1 2 x\n", 1, "MTL line 3, Kd (1 unreadable statement)" },
        { "newmtl a\nKd spectral a.rfl 1\n", 1, "MTL line 2, Kd (1 unreadable statement)" },
        { "newmtl a\nNs\n", 1, "MTL line 2, Ns (1 unreadable statement)" },
        { "newmtl a\nmap_Kd\n", 1, "MTL line 2, map_Kd (1 unreadable statement)" },
        { "newmtl a\nmap_Kd ../gone.png\n", 1, "../gone.png (1 file outside the folder)" },
        { "newmtl a\nmap_Kd x/../../gone.png\n", 1, "x/../../gone.png (1 file outside" },
        { "newmtl a\nmap_Kd x/../gone.png\n", 1, "x/../gone.png (1 missing file)" },
        { "newmtl a\nmap_Kd C:\\art\\a.png\n", 1, "C:\\art\\a.png (1 file outside the folder)" },
        { "newmtl a\nmap_Kd file:///C:/art/a.png\n", 1, "file:///C:/art/a.png (1 file outside" },
        { "newmtl a\nmap_Kd .\n", 1, ". (1 unreadable file)" },
        { "newmtl a\nmap_Kd a.mtl\n", 1, "a.mtl (1 undecodable image)" },
        { "newmtl a\nmap_Kd a.mtl\nmap_Ke a.mtl\n", 1, "a.mtl (2 undecodable images)" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        expectation with = cases[i];
        folder_write_text("a.mtl", with.text);
        with.text = "mtllib a.mtl\nusemtl a\n" TRIANGLE "f 1 2 3\n";
        expect(&with);
    }
}

static void names_of_files_may_differ_in_case(void **state) {
    (void)state;
    scene_builder builder;
    base_error error;
    folder_write_text("Two Words.MTL", "newmtl a\nKd 0.25 0.5 0.75\n");
    assert_true(reads("mtllib two words.mtl\nusemtl a\n" TRIANGLE "f 1 2 3\n", &builder, &error));
    const scene_material *materials = builder_items(&builder, BLOB_MATERIALS);
    const scene_mesh *meshes = builder_items(&builder, BLOB_MESHES);
    assert_int_equal(builder_count(&builder, BLOB_UNSUPPORTED), 0);
    CHECK_WITHIN(fabs((double)materials[meshes[0].material].base_color[2] - 0.75), 1e-7);
    builder_free(&builder);
}

/* Every group is a mesh of its own, and many groups cost nothing by themselves. */
static void many_groups_are_many_meshes(void **state) {
    (void)state;
    enum { GROUPS = 40000 };
    char *text = malloc(64 * GROUPS), *end = text;
    assert_non_null(text);
    end += sprintf(end, TRIANGLE);
    for (int i = 0; i < GROUPS; i++)
        end += sprintf(end, "g part%d\nf 1 2 3\n", i);
    scene_builder builder;
    base_error error;
    assert_true(reads(text, &builder, &error));
    assert_int_equal(builder_count(&builder, BLOB_MESHES), GROUPS);
    builder_free(&builder);
    free(text);
}

/* The program reads what Assimp knows, in the same sandbox, and reports in one line what it leaves
 * out. */
static void other_formats_are_read(void **state) {
    (void)state;
    static const char ply[] = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                              "property float y\nproperty float z\nelement face 1\n"
                              "property list uchar int vertex_index\nend_header\n"
                              "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    static const char stl[] = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                              "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n";
    static const char off[] = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    static const struct {
        const char *name, *text;
    } files[] = { { "m.ply", ply }, { "m.stl", stl }, { "m.OFF", off } };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        scene s;
        base_error error = { "" };
        folder_write_text(files[i].name, files[i].text);
        if (!scene_load(in_folder(files[i].name), &(scene_options) { .no_cache = true }, &s,
                        &error))
            fail_msg("%s", error.text);
        assert_int_equal(s.index_count, 3);
        CHECK_WITHIN(fabs(scene_area(&s) - 0.5), 1e-6);
        scene_free(&s);
    }
}

static void what_other_formats_lose_is_named(void **state) {
    (void)state;
    folder_write_text(
        "m.dae",
        "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
        "version=\"1.4.1\"><asset><up_axis>Y_UP</up_axis></asset><library_lights><light id=\"l\">"
        "<technique_common><point><color>1 1 1</color></point></technique_common></light>"
        "</library_lights><library_geometries><geometry id=\"g\"><mesh><source id=\"p\">"
        "<float_array id=\"a\" count=\"9\">0 0 0 1 0 0 0 1 0</float_array><technique_common>"
        "<accessor source=\"#a\" count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/>"
        "<param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor>"
        "</technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "
        "source=\"#p\"/></vertices><triangles count=\"1\"><input semantic=\"VERTEX\" "
        "source=\"#v\" offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry>"
        "</library_geometries><library_visual_scenes><visual_scene "
        "id=\"s\"><node><instance_geometry "
        "url=\"#g\"/></node><node><instance_light url=\"#l\"/></node></visual_scene>"
        "</library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>");
    scene s;
    base_error error = { "" };
    if (!scene_load(in_folder("m.dae"), &(scene_options) { .no_cache = true }, &s, &error))
        fail_msg("%s", error.text);
    assert_int_equal(s.unsupported_count, 1);
    assert_string_equal(s.unsupported[0].noun, "light");
    scene_free(&s);
}

static void a_strict_reading_leaves_nothing_out(void **state) {
    (void)state;
    scene s;
    base_error error = { "" };
    scene_options options = { .no_cache = true };
    folder_write_text("lines.obj", TRIANGLE "f 1 2 3\nl 1 2\n");
    assert_true(scene_load(in_folder("lines.obj"), &options, &s, &error));
    assert_int_equal(s.unsupported_count, 1);
    scene_free(&s);
    options.strict = true;
    assert_false(scene_load(in_folder("lines.obj"), &options, &s, &error));
    assert_non_null(strstr(error.text, "left out: points and lines (1 element)"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_grammar_is_read),
        cmocka_unit_test(a_library_s_statements_are_read),
        cmocka_unit_test(names_of_files_may_differ_in_case),
        cmocka_unit_test(many_groups_are_many_meshes),
        cmocka_unit_test(other_formats_are_read),
        cmocka_unit_test(what_other_formats_lose_is_named),
        cmocka_unit_test(a_strict_reading_leaves_nothing_out),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
