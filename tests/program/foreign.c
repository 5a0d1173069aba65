/* SPDX-License-Identifier: MIT */
/* What programs write into the formats that Assimp reads, and what they mean by it. */
#include "app/scene/instance.h"
#include "app/scene/scene.h"
#include "tests/program/folder.h"
#include "tests/program/load.h"

/* Two triangles of two materials, whose effects a test chooses. */
#define COLLADA_HEAD                                                                               \
    "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "      \
    "version=\"1.4.1\"><asset><up_axis>Y_UP</up_axis></asset>"
#define EFFECT(id, contents)                                                                       \
    "<effect id=\"e" id "\"><profile_COMMON><technique sid=\"c\"><phong>" contents                 \
    "</phong></technique></profile_COMMON></effect>"
#define MATERIAL(id) "<material id=\"m" id "\"><instance_effect url=\"#e" id "\"/></material>"
#define TRIANGLES(id)                                                                              \
    "<triangles count=\"1\" material=\"s" id                                                       \
    "\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2</p></triangles>"
#define BIND(id) "<instance_material symbol=\"s" id "\" target=\"#m" id "\"/>"
#define COLLADA(first, second)                                                                     \
    COLLADA_HEAD "<library_effects>" EFFECT("0", first)                                            \
        EFFECT("1", second) "</library_effects><library_materials>" MATERIAL("0") MATERIAL(        \
            "1") "</library_materials><library_geometries><geometry id=\"g\"><mesh><source "       \
                 "id=\"p\">"                                                                       \
                 "<float_array id=\"a\" count=\"9\">0 0 0 1 0 0 0 1 "                              \
                 "0</float_array><technique_common>"                                               \
                 "<accessor source=\"#a\" count=\"3\" stride=\"3\"><param name=\"X\" "             \
                 "type=\"float\"/>"                                                                \
                 "<param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor>" \
                 "</technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "    \
                 "source=\"#p\"/></vertices>" TRIANGLES("0") TRIANGLES(                            \
                     "1") "</mesh></geometry>"                                                     \
                          "</library_geometries><library_visual_scenes><visual_scene "             \
                          "id=\"s\"><node>"                                                        \
                          "<instance_geometry url=\"#g\"><bind_material><technique_common>" BIND(  \
                              "0")                                                                 \
                              BIND("1") "</technique_common></bind_material></"                    \
                                        "instance_geometry></node></visual_scene>"                 \
                                        "</library_visual_scenes><scene><instance_visual_scene "   \
                                        "url=\"#s\"/></scene></COLLADA>"

#define TRANSPARENT(number)                                                                        \
    "<transparent><color>0 0 0 1</color></transparent><transparency><float>" number                \
    "</float></transparency>"
#define DIFFUSE(color) "<diffuse><color>" color "</color></diffuse>"

static scene load_text(const char *name, const char *text) {
    folder_write_text(name, text);
    return load(in_folder(name));
}

static const scene_material *material_of(const scene *s, size_t mesh) {
    return &s->materials[s->meshes[mesh].material];
}

static void assert_opacities(const char *text, float first, float second) {
    scene s = load_text("o.dae", text);
    assert_int_equal(s.mesh_count, 2);
    assert_true(material_of(&s, 0)->base_color[3] == first);
    assert_true(material_of(&s, 1)->base_color[3] == second);
    assert_int_equal(s.unsupported_count, 0);
    scene_free(&s);
}

/* The format says that 1 is opaque; a file that writes 0 for opaque means the opposite everywhere.
 */
static void a_collada_counts_opacity_as_its_exporter_does(void **state) {
    (void)state;
    assert_opacities(COLLADA(TRANSPARENT("1"), TRANSPARENT("0.25")), 1, 0.25f);
    assert_opacities(COLLADA(TRANSPARENT("0"), TRANSPARENT("0.25")), 1, 0.75f);
    assert_opacities(COLLADA(TRANSPARENT("0"), TRANSPARENT("0")), 1, 1);
    assert_opacities(COLLADA(TRANSPARENT("0"), TRANSPARENT("1")), 1, 1);
}

static void blanks_before_a_number_do_not_count(void **state) {
    (void)state;
    scene s = load_text("b.dae", COLLADA(DIFFUSE(" \n\t 0.25 0.5 0.75 1 "), DIFFUSE("1 1 1 1")));
    CHECK_WITHIN(fabs((double)material_of(&s, 0)->base_color[1] - 0.5), 1e-6);
    scene_free(&s);
}

/* In fixed pipelines emission is a part of the color, and lights nothing. */
static void emission_of_fixed_pipelines_is_no_lamp(void **state) {
    (void)state;
    static const char glowing[] =
        COLLADA("<emission><color>0.25 0.5 1 1</color></emission>", DIFFUSE("1 1 1 1"));
    static const char shining[] =
        COLLADA("<emission><color>3 3 3 1</color></emission>", DIFFUSE("1 1 1 1"));
    scene s = load_text("e.dae", glowing);
    CHECK_WITHIN(fabs((double)material_of(&s, 0)->emission[1] - 0.5), 1e-6);
    assert_int_equal(s.light_count, 0);
    scene_free(&s);
    s = load_text("e.dae", shining);
    assert_int_equal(s.light_count, 1);
    scene_free(&s);
}

/* A PNG of one red pixel, in base64. */
#define RED_PIXEL                                                                                  \
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAA"             \
    "AElFTkSuQmCC"

/* A triangle of an FBX whose black material has a texture that lies in the file, under a path of
 * the author's computer. */
static const char fbx_with_image[] =
    "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\nFBXHeaderVersion: 1003\n"
    "FBXVersion: 7400\n}\nObjects:  {\nGeometry: 10, \"Geometry::\", \"Mesh\" {\n"
    "Vertices: *9 {\na: 0,0,0,1,0,0,0,1,0\n}\nPolygonVertexIndex: *3 {\na: 0,1,-3\n}\n"
    "LayerElementUV: 0 {\nName: \"m\"\nMappingInformationType: \"ByPolygonVertex\"\n"
    "ReferenceInformationType: \"Direct\"\nUV: *6 {\na: 0,0,1,0,0,1\n}\n}\n"
    "LayerElementMaterial: 0 {\nName: \"\"\nMappingInformationType: \"AllSame\"\n"
    "ReferenceInformationType: \"IndexToDirect\"\nMaterials: *1 {\na: 0\n}\n}\n"
    "Layer: 0 {\nLayerElement:  {\nType: \"LayerElementMaterial\"\nTypedIndex: 0\n}\n"
    "LayerElement:  {\nType: \"LayerElementUV\"\nTypedIndex: 0\n}\n}\n}\n"
    "Model: 11, \"Model::m\", \"Mesh\" {\nVersion: 232\n}\n"
    "Material: 12, \"Material::m\", \"\" {\nVersion: 102\nShadingModel: \"phong\"\n"
    "Properties70:  {\nP: \"DiffuseColor\", \"Color\", \"\", \"A\",0,0,0\n}\n}\n"
    "Video: 13, \"Video::t\", \"Clip\" {\nType: \"Clip\"\nUseMipMap: 0\n"
    "Filename: \"C:\\art\\t.png\"\nRelativeFilename: \"..\\t.png\"\nContent: , \"" RED_PIXEL "\"\n"
    "}\nTexture: 14, \"Texture::t\", \"\" {\nType: \"TextureVideoClip\"\nVersion: 202\n"
    "TextureName: \"Texture::t\"\nMedia: \"Video::t\"\nFileName: \"C:\\art\\t.png\"\n"
    "RelativeFilename: \"..\\t.png\"\n}\n}\nConnections:  {\nC: \"OO\",11,0\n"
    "C: \"OO\",10,11\nC: \"OO\",12,11\nC: \"OP\",14,12, \"DiffuseColor\"\n"
    "C: \"OO\",13,14\n}\n";

static void an_fbx_shows_the_images_that_lie_in_it(void **state) {
    (void)state;
    scene s = load_text("image.fbx", fbx_with_image);
    const scene_material *const material = material_of(&s, 0);
    assert_int_equal(s.texture_count, 1);
    assert_int_equal(material->base_color_map.texture, 0);
    assert_int_equal(s.unsupported_count, 0);
    for (int k = 0; k < 3; k++) /* the texture takes the place of black */
        assert_true(material->base_color[k] == 1);
    scene_free(&s);
}

/* A file whose vertices are all white is not reported. */
static void colors_of_vertices_are_told_of(void **state) {
    (void)state;
    for (int colored = 0; colored < 2; colored++) {
        char text[512];
        snprintf(text, sizeof text,
                 "<?xml version=\"1.0\"?><amf><object id=\"1\"><mesh><vertices>"
                 "<vertex><coordinates><x>0</x><y>0</y><z>0</z></coordinates>%s</vertex>"
                 "<vertex><coordinates><x>1</x><y>0</y><z>0</z></coordinates></vertex>"
                 "<vertex><coordinates><x>0</x><y>1</y><z>0</z></coordinates></vertex></vertices>"
                 "<volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume>"
                 "</mesh></object></amf>",
                 colored ? "<color><r>1</r><g>0</g><b>0</b></color>" : "");
        scene s = load_text("c.amf", text);
        assert_int_equal(s.unsupported_count, colored);
        if (colored)
            assert_string_equal(s.unsupported[0].what, "vertex colors");
        scene_free(&s);
    }
}

/* Each object of a RAW file is shown, although Assimp forgets the node of the last one. */
static void a_raw_file_shows_all_its_objects(void **state) {
    (void)state;
    scene s = load_text("r.raw", "One\n1 1 1 0 0 0 0 1 0 1 0 0\nTwo\n1 1 1 2 0 0 2 1 0 3 0 0\n");
    assert_int_equal(scene_triangle_count(&s), 2);
    scene_free(&s);
}

/* Converts to UTF-16, little-endian or big-endian, with a byte-order mark. */
static size_t to_utf16(const char *text, bool big, unsigned char *out) {
    size_t used = 0;
    out[used++] = big ? 0xfe : 0xff;
    out[used++] = big ? 0xff : 0xfe;
    for (; *text; text++) {
        out[used + (big ? 1 : 0)] = (unsigned char)*text;
        out[used + (big ? 0 : 1)] = 0;
        used += 2;
    }
    return used;
}

static void files_may_be_utf16(void **state) {
    (void)state;
    static const char obj[] = "o \nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    static const char off[] = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    static const char dae[] = COLLADA(DIFFUSE("1 1 1 1"), DIFFUSE("1 1 1 1"));
    static const struct {
        const char *name, *text;
        size_t triangles;
    } files[] = { { "u.obj", obj, 1 }, { "u.off", off, 1 }, { "u.dae", dae, 2 } };
    static unsigned char bytes[2 * sizeof dae + 2];
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        for (int big = 0; big < 2; big++) {
            folder_write(files[i].name, bytes, to_utf16(files[i].text, big, bytes));
            scene s = load(in_folder(files[i].name));
            assert_int_equal(scene_triangle_count(&s), files[i].triangles);
            scene_free(&s);
        }
}

/* Assimp would read past the array, other bytes in every run. */
static void an_accessor_past_its_array_is_refused(void **state) {
    (void)state;
    static const char good[] = COLLADA(DIFFUSE("1 1 1 1"), DIFFUSE("1 1 1 1"));
    static const char *const changes[][2] = { { "count=\"9\"", "count=\"6\"" },
                                              { "count=\"3\" stride", "count=\"4\" stride" },
                                              { "stride=\"3\"", "stride='4'" },
                                              { "stride=\"3\"", "stride=\"3\" offset = \"1\"" },
                                              { "stride=\"3\"", "stride=\"many\"" } };
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        char text[sizeof good + 64];
        scene s;
        base_error error = { "" };
        const char *const at = strstr(good, changes[i][0]);
        assert_non_null(at);
        snprintf(text, sizeof text, "%.*s%s%s", (int)(at - good), good, changes[i][1],
                 at + strlen(changes[i][0]));
        folder_write_text("a.dae", text);
        assert_false(
            scene_load(in_folder("a.dae"), &(scene_options) { .no_cache = true }, &s, &error));
        assert_non_null(strstr(error.text, "an accessor reaches past its array, \"a\""));
    }
}

/* A triangle from 0 to 1 along x and to 3 along z, in formats of Assimp. FBX says which axis is up.
 */
#define STL                                                                                        \
    "solid s\nfacet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 3\n"         \
    "endloop\nendfacet\nendsolid s\n"
#define AMF                                                                                        \
    "<?xml version=\"1.0\"?><amf><object id=\"1\"><mesh><vertices>"                                \
    "<vertex><coordinates><x>0</x><y>0</y><z>0</z></coordinates></vertex>"                         \
    "<vertex><coordinates><x>1</x><y>0</y><z>0</z></coordinates></vertex>"                         \
    "<vertex><coordinates><x>0</x><y>0</y><z>3</z></coordinates></vertex></vertices>"              \
    "<volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume></mesh></object></amf>"
#define COB                                                                                        \
    "Caligari V00.01ALH             \nPolH V0.08 Id 1 Parent 0 Size 00000500\nName t,1\n"          \
    "center 0 0 0\nx axis 1 0 0\ny axis 0 1 0\nz axis 0 0 1\nTransform\n1 0 0 0\n0 1 0 0\n"        \
    "0 0 1 0\n0 0 0 1\nWorld Vertices 3\n0 0 0\n1 0 0\n0 0 3\nTexture Vertices 1\n0 0\n"           \
    "Faces 1\nFace verts 3 flags 0 mat 0\n<0,0> <1,0> <2,0>\nDrawFlags 0\n"                        \
    "END V1.00 Id 0 Parent 0 Size        0\n"
#define FBX(axis)                                                                                  \
    "; FBX 7.3.0 project file\nFBXHeaderExtension: {\n FBXVersion: 7300\n}\nGlobalSettings: {\n"   \
    " Properties70: {\n  P: \"UpAxis\", \"int\", \"Integer\", \"\"," axis "\n }\n}\nObjects: {\n"  \
    " Geometry: 1, \"Geometry::g\", \"Mesh\" {\n  Vertices: *9 {\n   a: 0,0,0,1,0,0,0,0,3\n  }\n"  \
    "  PolygonVertexIndex: *3 {\n   a: 0,1,-3\n  }\n }\n Model: 2, \"Model::m\", \"Mesh\" {\n }\n" \
    "}\nConnections: {\n C: \"OO\",2,0\n C: \"OO\",1,2\n}\n"

static const unsigned char max_3ds[] = {
    0x4d, 0x4d, 86, 0, 0, 0, 0x3d, 0x3d, 80, 0, 0, 0, 0x00, 0x40, 74,   0,    0,    0,    't', 0,
    0x00, 0x41, 66, 0, 0, 0, 0x10, 0x41, 44, 0, 0, 0, 3,    0, /* three vertices */
    0,    0,    0,  0, 0, 0, 0,    0,    0,  0, 0, 0, 0,    0,    0x80, 0x3f, 0,    0,    0,   0,
    0,    0,    0,  0, 0, 0, 0,    0,    0,  0, 0, 0, 0,    0,    0x40, 0x40, 0x20, 0x41, 16,  0,
    0,    0,    1,  0, 0, 0, 1,    0,    2,  0, 7, 0, /* and a face */
};

/* The axis along which the triangle is 3 long. */
static int long_axis(const char *name, int up) {
    scene s;
    base_error error;
    if (!scene_load(in_folder(name), &(scene_options) { .no_cache = true, .up = up }, &s, &error))
        fail_msg("%s", error.text);
    const int axis = s.maximum[1] - s.minimum[1] > s.maximum[2] - s.minimum[2] ? 1 : 2;
    CHECK_WITHIN(fabsf(s.maximum[axis] - s.minimum[axis] - 3), 1e-6);
    scene_free(&s);
    return axis;
}

/* Once, whether Assimp rotates the format or leaves that to us. */
static void a_format_whose_z_is_up_stands(void **state) {
    (void)state;
    static const struct {
        const char *name, *text;
        bool stands, by_assimp;
    } files[] = {
        { "z.stl", STL, true, false },
        { "z.AMF", AMF, true, false },
        { "z.cob", COB, true, false },
        { "z.fbx", FBX("2"), true, false },
        { "y.fbx", FBX("1"), false, false },
        { "z.3ds", NULL, true, true },
        { "y.obj", "v 0 0 0\nv 1 0 0\nv 0 0 3\nf 1 2 3\n", false, false },
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        const char *const name = files[i].name;
        if (files[i].text)
            folder_write_text(name, files[i].text);
        else
            folder_write(name, max_3ds, sizeof max_3ds);
        const int y = files[i].by_assimp ? 1 : 2;
        if (long_axis(name, SCENE_UP_AUTO) != (files[i].stands ? 1 : 2))
            fail_msg("%s lies", name);
        assert_int_equal(long_axis(name, SCENE_UP_Y), y);
        assert_int_equal(long_axis(name, SCENE_UP_Z), 3 - y);
    }
}

/* COLLADA says which axis is up, and Assimp heeds it. */
static void a_collada_stands_by_its_up_axis(void **state) {
    (void)state;
    static const char *const axes[] = { "Y_UP", "Z_UP" };
    static const char lying[] = COLLADA(DIFFUSE("1 1 1 1"), DIFFUSE("1 1 1 1"));
    for (int z = 0; z < 2; z++) {
        char text[sizeof lying];
        strcpy(text, lying);
        memcpy(strstr(text, "Y_UP"), axes[z], 4);
        scene s = load_text("up.dae", text);
        assert_true((s.maximum[1] == 1) == !z && (s.minimum[2] == -1) == z);
        scene_free(&s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_collada_counts_opacity_as_its_exporter_does),
        cmocka_unit_test(blanks_before_a_number_do_not_count),
        cmocka_unit_test(emission_of_fixed_pipelines_is_no_lamp),
        cmocka_unit_test(an_fbx_shows_the_images_that_lie_in_it),
        cmocka_unit_test(colors_of_vertices_are_told_of),
        cmocka_unit_test(a_format_whose_z_is_up_stands),
        cmocka_unit_test(a_collada_stands_by_its_up_axis),
        cmocka_unit_test(a_raw_file_shows_all_its_objects),
        cmocka_unit_test(files_may_be_utf16),
        cmocka_unit_test(an_accessor_past_its_array_is_refused),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
