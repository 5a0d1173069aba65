/* SPDX-License-Identifier: MIT */
/* One invalid detail costs that detail, not the scene: what is drawn without it, and what is
 * reported. */
#include "app/scene/instance.h"
#include "app/scene/scene.h"
#include "tests/program/folder.h"
#include "tests/program/gltf_document.h"
#include "tests/program/load.h"

#include <unistd.h>

/* Formats all that is unsupported, as the line on stderr has it. */
static void said_of(const scene_unsupported *items, size_t count, char *text, size_t size) {
    text[0] = 0;
    for (size_t i = 0; i < count; i++) {
        char one[256];
        scene_unsupported_text(&items[i], one, sizeof one);
        snprintf(text + strlen(text), size - strlen(text), "%s%s", i ? ", " : "", one);
    }
}

/* --- glTF: changes to a valid document -------------------------------------------------------- */

/* What is reported of the document as it is. */
#define USUAL       "missing texture coordinates (1 primitive)"
#define USUAL_AFTER "range (1 light)"

typedef struct forgiven {
    const char *from, *to;
    const char *said; /* beside the usual; NULL means nothing */
} forgiven;

static const forgiven gltf_changes[] = {
    { "{\"asset\"", "{\"asset\"", NULL },
    /* changes that only repeat something, or concern nobody */
    { "[\"KHR_texture_transform\"]", "[\"KHR_materials_sheen\"]", NULL },
    { "\"KHR_lights_punctual\",\"KHR", "\"KHR_texture_transform\",\"KHR", NULL },
    { "\"max\":[1,1,0]", "\"max\":[1,1]", NULL },
    { "\"mesh\":0,\"skin\":0", "\"mesh\":0", NULL },
    { "{\"camera\":0,", "{\"weights\":[1],\"camera\":0,", NULL },
    { "\"camera\":0,\"matrix\"", "\"camera\":0,\"scale\":[1,1,1],\"matrix\"", NULL },
    { "0,0,9,1]", "0,0,9,1.0000001]", NULL },
    { "\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"",
      "\"componentType\":5126,\"normalized\":true,\"count\":4,\"type\":\"VEC3\"", NULL },
    { "\"JOINTS_0\":7", "\"JOINTS_0\":7,\"OWN\":0", "OWN (1 attribute)" },
    { "\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"",
      "\"componentType\":5120,\"count\":4,\"type\":\"VEC3\"",
      "undeclared KHR_mesh_quantization (1 attribute)" },
    { "\"target\":34962", "\"target\":1", "unknown target (1 buffer view)" },
    /* materials drawn without what an extension adds, although the file requires it */
    { "[\"KHR_texture_transform\"]",
      "[\"KHR_materials_anisotropy\",\"KHR_materials_iridescence\","
      "\"KHR_materials_dispersion\",\"KHR_materials_variants\"]",
      NULL },
    { "\"doubleSided\":true", "\"extensions\":{\"KHR_materials_anisotropy\":{}}",
      "anisotropy (1 material)" },
    { "\"doubleSided\":true", "\"extensions\":{\"KHR_materials_dispersion\":{}}",
      "dispersion (1 material)" },
    /* variants to choose by --variant, so nothing is left out */
    { "\"mode\":4", "\"extensions\":{\"KHR_materials_variants\":{\"mappings\":[]}}", NULL },
    { "\"mode\":4", "\"extensions\":{\"KHR_materials_variants\":{}}", NULL },
    { "{\"source\":0,", "{\"extensions\":{\"KHR_texture_basisu\":{\"source\":0}},\"source\":0,",
      "KHR_texture_basisu (1 texture)" },
    /* numbers that are rounded, and out of range */
    { "\"metallicFactor\":0.5", "\"metallicFactor\":1.0000001", NULL },
    { "\"metallicFactor\":0.5", "\"metallicFactor\":1.5",
      "metallicFactor out of range (1 material)" },
    { "[1,1,1,1]", "[1.0000001,1,1,1]", NULL },
    { "[1,1,1,1]", "[1,1,1,2]", "baseColorFactor out of range (1 material)" },
    { "\"emissiveFactor\":[0,0,0]", "\"emissiveFactor\":[5,0,0]", NULL },
    { "\"alphaMode\":\"MASK\"", "\"alphaMode\":\"mask\"", "unknown alphaMode (1 material)" },
    { "\"wrapS\":10497", "\"wrapS\":10496", "unknown wrapS (1 sampler)" },
    { "\"minFilter\":9987", "\"minFilter\":0", "unknown minFilter (1 sampler)" },
    { "\"rotation\":[0,0,0,1]", "\"rotation\":[0,0,0,0.99]", NULL },
    { "\"rotation\":[0,0,0,1]", "\"rotation\":[0,0,0,1.0000001]", NULL },
    { "\"rotation\":[0,0,0,1]", "\"rotation\":[0,0,0,2]", "length of a rotation (1 node)" },
    { "\"rotation\":[0,0,0,1]", "\"rotation\":[0,0,0,0]", "length of a rotation (1 node)" },
    { "\"intensity\":4", "\"intensity\":-4", "intensity out of range (1 light)" },
    { "\"color\":[1,0.5,0]", "\"color\":[1,-1,0]", "color out of range (1 light)" },
    { "\"outerConeAngle\":0.5", "\"outerConeAngle\":1.5707963705062866", NULL },
    { "\"outerConeAngle\":0.5", "\"outerConeAngle\":1.6", "outerConeAngle out of range (1 light)" },
    { "\"innerConeAngle\":0.1", "\"innerConeAngle\":0.5", NULL },
    { "\"zfar\":10", "\"zfar\":0.05", NULL },
    /* images */
    { "\"bufferView\":9,", "\"bufferView\":6,", "image 0 (1 undecodable image)" },
    { "\"bufferView\":9,", "\"uri\":\"data:image/png;base64,!!!!\",",
      "image 0 (1 undecodable image)" },
    { "\"bufferView\":9,",
      "\"uri\":\"data:image/gif;base64,R0lGODdhAQABAIAAAP///////ywAAAAAAQABAAACAkQBADs=\",",
      "image 0 (1 undecodable image)" },
    { "\"bufferView\":9,", "", "image 0 (1 image without data)" },
    { "\"bufferView\":9,\"mimeType\":\"image/png\"", "\"bufferView\":9", NULL },
    { "\"bufferView\":9,", "\"uri\":\"gone.png\",", "gone.png (1 missing file)" },
    { "\"bufferView\":9,", "\"uri\":\"../up.png\",", "../up.png (1 file outside the folder)" },
    { "\"bufferView\":9,", "\"uri\":\"file:///C:/a.png\",",
      "file:///C:/a.png (1 file outside the folder)" },
    { "\"bufferView\":9,",
      "\"uri\":\"C:\\\\Users\\\\somebody\\\\Documents\\\\a project of long "
      "ago\\\\Textures\\\\a.png\",",
      "...sers\\somebody\\Documents\\a project of long ago\\Textures\\a.png (1 file outside the "
      "folder)" },
};

static void a_gltf_is_read_but_for_the_detail(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof gltf_changes / sizeof *gltf_changes; i++) {
        const forgiven *c = &gltf_changes[i];
        char *text = changed(c->from, c->to), said[1024];
        scene_builder builder;
        base_error error;
        if (!reads(text, &builder, &error))
            fail_msg("%s: %s", c->to, error.text);
        said_of(builder_items(&builder, BLOB_UNSUPPORTED),
                builder_count(&builder, BLOB_UNSUPPORTED), said, sizeof said);
        const size_t count = builder_count(&builder, BLOB_UNSUPPORTED);
        if (!strstr(said, USUAL) || !strstr(said, USUAL_AFTER) || count != 2 + (c->said != NULL) ||
            (c->said && !strstr(said, c->said)))
            fail_msg("%s: says \"%s\" instead of \"%s\"", c->to, said, c->said ? c->said : "");
        builder_free(&builder);
        free(text);
    }
}

static const scene_material *material_of(const scene *world) {
    return &world->materials[world->meshes[0].material];
}

#define TRIANGLE                                                                                   \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"            \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","       \
    "\"min\":[0,0,0],\"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"        \
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"              \
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}"
#define HEAD                                                                                       \
    "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"

/* Without its image a base color is drawn by its factor alone; once the image exists, the scene is
 * another. */
static void an_image_that_appears_is_drawn(void **state) {
    (void)state;
    const scene_options by_cache = { 0 };
    scene world;
    base_error error;
    folder_write_text("late.gltf",
                      HEAD "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":"
                           "[0.25,0.5,0.75,1],\"baseColorTexture\":{\"index\":0}}}],"
                           "\"textures\":[{\"source\":0}],"
                           "\"images\":[{\"uri\":\"sub/../late.png\"}]," TRIANGLE);
    for (int i = 0; i < 4; i++) {
        if (i == 2)
            folder_write("late.png", pixel_png, sizeof pixel_png);
        if (!scene_load(in_folder("late.gltf"), &by_cache, &world, &error))
            fail_msg("%s", error.text);
        assert_int_equal(world.cached, i % 2);
        assert_int_equal(world.unsupported_count, i < 2 ? 2 : 1); /* the image, and coordinates */
        assert_int_equal(material_of(&world)->base_color_map.texture, i < 2 ? -1 : 0);
        CHECK_WITHIN(fabs((double)material_of(&world)->base_color[2] - 0.75), 1e-7);
        scene_free(&world);
    }
}

/* Ignored are any bytes after a GLB's end, NULs where its JSON is padded, and a byte-order mark. */
static void what_surrounds_a_document_is_passed_over(void **state) {
    (void)state;
    size_t size;
    scene_builder builder;
    base_error error;
    unsigned char *glb = pack_glb(document, &size);
    unsigned char *longer = malloc(size + 1);
    assert_non_null(longer);
    memcpy(longer, glb, size);
    longer[size] = '\n';
    if (!reads_bytes(longer, size + 1, &builder, &error))
        fail_msg("%s", error.text);
    builder_free(&builder);
    uint32_t json;
    memcpy(&json, glb + 12, sizeof json);
    for (size_t i = 20 + json - 1; glb[i] == ' '; i--)
        glb[i] = 0;
    if (!reads_bytes(glb, size, &builder, &error))
        fail_msg("%s", error.text);
    builder_free(&builder);
    free(glb);
    free(longer);
    folder_write_text("mark.gltf", "\xef\xbb\xbf" HEAD "\"materials\":[{}]," TRIANGLE);
    scene world = load(in_folder("mark.gltf"));
    assert_int_equal(world.index_count, 3);
    scene_free(&world);
}

/* The same triangle is given by characters and escapes (RFC 2397). */
static void data_need_no_base64(void **state) {
    (void)state;
    char text[2048], bytes_of[3 * 36 + 1];
    static const float corners[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    for (size_t i = 0; i < sizeof corners; i++)
        sprintf(bytes_of + 3 * i, "%%%02x", ((const unsigned char *)corners)[i]);
    snprintf(text, sizeof text,
             HEAD "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
                  "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
                  "\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
                  "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:a/b,%s\"}]}",
             bytes_of);
    folder_write_text("plain.gltf", text);
    scene world = load(in_folder("plain.gltf"));
    CHECK_WITHIN(fabs(scene_area(&world) - 0.5), 1e-7);
    scene_free(&world);
}

/* A root of the scene whose parent is not in it takes its own transform; in a tree that is shown it
 * would occur twice. */
static void a_root_may_be_the_child_of_what_is_not_shown(void **state) {
    (void)state;
    static const char format[] =
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[%s]}],\"materials\":[{}],"
        "\"nodes\":[{\"translation\":[5,0,0],\"children\":[1]},"
        "{\"mesh\":0,\"translation\":[0,2,0],\"children\":[2]},{\"translation\":[1,0,0]}],%s";
    char text[2048];
    scene world;
    base_error error;
    snprintf(text, sizeof text, format, "1", TRIANGLE);
    folder_write_text("root.gltf", text);
    world = load(in_folder("root.gltf"));
    assert_true(world.minimum[0] == 0 && world.minimum[1] == 2);
    scene_free(&world);
    static const char *const twice[] = { "0,1", "1,0", "0,2" };
    for (size_t i = 0; i < sizeof twice / sizeof *twice; i++) {
        snprintf(text, sizeof text, format, twice[i], TRIANGLE);
        folder_write_text("root.gltf", text);
        assert_false(scene_load(in_folder("root.gltf"), &(scene_options) { .no_cache = true },
                                &world, &error));
        assert_non_null(strstr(error.text, "is a root of the scene and the child of another node"));
    }
}

/* --- other formats ---------------------------------------------------------------------------- */

#define MD5                                                                                        \
    "MD5Version 10\ncommandline \"\"\n\nnumJoints 1\nnumMeshes 1\n\njoints {\n"                    \
    "\t\"origin\" -1 ( 0 0 0 ) ( 0 0 0 )\n}\n\nmesh {\n\tshader \"stone\"\n\tnumverts 3\n"         \
    "\tvert 0 ( 0 0 ) 0 1\n\tvert 1 ( 1 0 ) 1 1\n\tvert 2 ( 0 1 ) 2 1\n\tnumtris 1\n"              \
    "\ttri 0 0 1 2\n\tnumweights 3\n\tweight 0 0 1 ( 0 0 0 )\n\tweight 1 0 1 ( 1 0 0 )\n"          \
    "\tweight 2 0 1 ( 0 1 0 )\n}\n"

/* Assimp looks for an animation beside every such mesh. */
static void a_file_that_is_only_looked_for_may_be_missing(void **state) {
    (void)state;
    base_error error;
    scene world;
    folder_write_text("man.md5mesh", MD5);
    if (!scene_load(in_folder("man.md5mesh"), &(scene_options) { .no_cache = true }, &world,
                    &error))
        fail_msg("%s", error.text);
    assert_int_equal(world.index_count, 3);
    for (size_t i = 0; i < world.unsupported_count; i++)
        assert_null(strstr(world.unsupported[i].what, "md5anim"));
    scene_free(&world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_gltf_is_read_but_for_the_detail),
        cmocka_unit_test(an_image_that_appears_is_drawn),
        cmocka_unit_test(what_surrounds_a_document_is_passed_over),
        cmocka_unit_test(data_need_no_base64),
        cmocka_unit_test(a_root_may_be_the_child_of_what_is_not_shown),
        cmocka_unit_test(a_file_that_is_only_looked_for_may_be_missing),
    };
    fill_bytes();
    if (folder_make(NULL) != 0 || setenv("XDG_CACHE_HOME", in_folder("cache"), 1) != 0)
        return 1;
    return cmocka_run_group_tests(tests, NULL, folder_remove);
}
